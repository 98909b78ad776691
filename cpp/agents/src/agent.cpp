#include "devlearn/agent.hpp"

#include <utility>

#include "devlearn/error.hpp"

namespace devlearn {

LearnerAgent::LearnerAgent(std::shared_ptr<Learner> learner) : learner_(std::move(learner)) {
  if (!learner_) throw InvalidValue("LearnerAgent.learner", "null", "a learner");
}

Choice LearnerAgent::choose(const Observation& observation) {
  return learner_->choose(observation.situation);
}

Development LearnerAgent::observe(const Outcome& outcome) { return learner_->learn(outcome.smf); }

void LearnerAgent::cancel() { learner_->cancel(); }

std::int64_t LearnerAgent::explored_count() const { return learner_->explored_count(); }

std::int64_t LearnerAgent::effective_count() const { return learner_->effective_count(); }

Choice RandomAgent::choose(const Observation& observation) {
  const auto motions = static_cast<std::uint32_t>(observation.motion_count);
  return {static_cast<int>(random_.index(motions)), Kind::kUnstated};
}

Development RandomAgent::observe(const Outcome&) { return {}; }

}  // namespace devlearn
