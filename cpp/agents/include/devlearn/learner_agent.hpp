#pragma once

#include <memory>
#include <optional>
#include <string>

#include "devlearn/agent.hpp"
#include "devlearn/learner.hpp"

namespace devlearn {

/// The paper's learner as an agent; it shares the learner with whoever else holds it.
class LearnerAgent final : public Agent {
 public:
  /// In a state, and in files.
  static constexpr const char* kKind = "learner";

  /// learner: not null.
  explicit LearnerAgent(std::shared_ptr<Learner> learner);
  /// One that goes on from a state of its kind. Throws FileError, naming `source`.
  LearnerAgent(const AgentState& state, const std::string& source);

  Choice choose(const Observation& observation) override;
  Development observe(const Outcome& outcome) override;
  void cancel() override;
  std::optional<AgentState> state() const override;
  /// The learner, never null.
  const std::shared_ptr<Learner>& learner() const noexcept { return learner_; }

 private:
  std::shared_ptr<Learner> learner_;
};

}  // namespace devlearn
