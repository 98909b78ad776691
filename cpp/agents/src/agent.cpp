#include "devlearn/agent.hpp"

#include "devlearn/error.hpp"
#include "devlearn/learner_agent.hpp"
#include "devlearn/random_agent.hpp"

namespace devlearn {

const std::string& AgentState::text(const std::string& name) const {
  const auto found = texts.find(name);
  if (found == texts.end()) throw InvalidValue(name, "nothing", "a text");
  return found->second;
}

std::shared_ptr<Agent> make_agent(const AgentState& state, const std::string& source) {
  if (state.kind == LearnerAgent::kKind) return std::make_shared<LearnerAgent>(state, source);
  if (state.kind == RandomAgent::kKind) return std::make_shared<RandomAgent>(state, source);
  return nullptr;
}

}  // namespace devlearn
