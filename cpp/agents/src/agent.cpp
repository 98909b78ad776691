#include "devlearn/agent.hpp"

#include "devlearn/adaptive_agent.hpp"
#include "devlearn/appraisal.hpp"
#include "devlearn/dyna_q.hpp"
#include "devlearn/error.hpp"
#include "devlearn/expected_sarsa.hpp"
#include "devlearn/iac.hpp"
#include "devlearn/learner_agent.hpp"
#include "devlearn/lrta_star.hpp"
#include "devlearn/operant_conditioning.hpp"
#include "devlearn/prioritized_sweeping.hpp"
#include "devlearn/q_learning.hpp"
#include "devlearn/r_max.hpp"
#include "devlearn/random_agent.hpp"
#include "devlearn/salient_events.hpp"
#include "devlearn/sarsa_lambda.hpp"

namespace devlearn {

const std::string& AgentState::text(const std::string& name) const {
  const auto found = texts.find(name);
  if (found == texts.end()) throw InvalidValue(name, "nothing", "a text");
  return found->second;
}

namespace {

// That one of these kinds whose state it is, or null.
template <typename... Kinds>
std::shared_ptr<Agent> one_of(const AgentState& state, const std::string& source) {
  std::shared_ptr<Agent> agent;
  static_cast<void>(
      ((state.kind == Kinds::kKind && (agent = std::make_shared<Kinds>(state, source))) || ...));
  return agent;
}

}  // namespace

std::shared_ptr<Agent> make_agent(const AgentState& state, const std::string& source) {
  return one_of<LearnerAgent, AdaptiveAgent, RandomAgent, QLearning, ExpectedSarsa, SarsaLambda,
                DynaQ, PrioritizedSweeping, LrtaStar, RMax, Iac, OperantConditioning, SalientEvents,
                Appraisal>(state, source);
}

}  // namespace devlearn
