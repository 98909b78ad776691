#include "devlearn/learner_agent.hpp"

#include <utility>

#include "devlearn/error.hpp"
#include "learner_snapshot.hpp"

namespace devlearn {

LearnerAgent::LearnerAgent(std::shared_ptr<Learner> learner) : learner_(std::move(learner)) {
  if (!learner_) throw InvalidValue("LearnerAgent.learner", "null", "a learner");
}

LearnerAgent::LearnerAgent(const AgentState& state, const std::string& source)
    : learner_(std::make_shared<Learner>(learner_of({state.texts, state.arrays}, source))) {}

Choice LearnerAgent::choose(const Observation& observation) {
  return learner_->choose(observation.situation, observation.allowed);
}

Development LearnerAgent::observe(const Outcome& outcome) { return learner_->learn(outcome.smf); }

void LearnerAgent::cancel() { learner_->cancel(); }

std::optional<AgentState> LearnerAgent::state() const {
  safetensors::Contents contents;
  describe(std::make_shared<const LearnerState>(learner_->state()), contents);
  return AgentState{kKind, std::move(contents.metadata), std::move(contents.arrays)};
}

}  // namespace devlearn
