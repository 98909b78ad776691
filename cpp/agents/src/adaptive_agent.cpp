#include "devlearn/adaptive_agent.hpp"

#include <utility>

#include "devlearn/error.hpp"
#include "learner_snapshot.hpp"

namespace devlearn {

AdaptiveAgent::AdaptiveAgent(std::shared_ptr<AdaptiveLearner> learner)
    : learner_(std::move(learner)) {
  if (!learner_) throw InvalidValue("AdaptiveAgent.learner", "null", "a learner");
}

AdaptiveAgent::AdaptiveAgent(const AgentState& state, const std::string& source)
    : learner_(std::make_shared<AdaptiveLearner>(
          adaptive_learner_of({state.texts, state.arrays}, source))) {}

void AdaptiveAgent::begin_round() { learner_->begin_round(); }

Choice AdaptiveAgent::choose(const Observation& observation) {
  return learner_->choose(observation.situation, observation.estimate, observation.allowed);
}

Development AdaptiveAgent::observe(const Outcome& outcome) {
  return learner_->learn(outcome.cost, outcome.situation, outcome.estimate, outcome.collided);
}

void AdaptiveAgent::cancel() { learner_->cancel(); }

void AdaptiveAgent::end_round(bool arrived) {
  // Whoever shares the learner may have ended it.
  if (learner_->in_round()) learner_->end_round(arrived);
}

std::optional<AgentState> AdaptiveAgent::state() const {
  safetensors::Contents contents;
  describe(std::make_shared<const AdaptiveState>(learner_->state()), contents);
  return AgentState{kKind, std::move(contents.metadata), std::move(contents.arrays)};
}

}  // namespace devlearn
