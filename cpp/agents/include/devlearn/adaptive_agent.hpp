#pragma once

#include <memory>
#include <optional>
#include <string>

#include "devlearn/adaptive.hpp"
#include "devlearn/agent.hpp"

namespace devlearn {

/// The adaptive learner as an agent; it shares the learner with whoever else holds it.
class AdaptiveAgent final : public Agent {
 public:
  /// In a state, and in files.
  static constexpr const char* kKind = "adaptive";

  /// learner: not null.
  explicit AdaptiveAgent(std::shared_ptr<AdaptiveLearner> learner);
  /// One that goes on from a state of its kind. Throws FileError, naming `source`.
  AdaptiveAgent(const AgentState& state, const std::string& source);

  void begin_round() override;
  Choice choose(const Observation& observation) override;
  Development observe(const Outcome& outcome) override;
  void cancel() override;
  void end_round(bool arrived) override;
  std::optional<AgentState> state() const override;
  /// The learner, never null.
  const std::shared_ptr<AdaptiveLearner>& learner() const noexcept { return learner_; }

 private:
  std::shared_ptr<AdaptiveLearner> learner_;
};

}  // namespace devlearn
