#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "devlearn/agent.hpp"
#include "devlearn/random.hpp"

namespace devlearn {

/// Uniformly random motions, of those allowed: what learning is measured against. It states the
/// kind kUnstated.
class RandomAgent final : public Agent {
 public:
  /// In a state, and in files.
  static constexpr const char* kKind = "random";

  /// seed: of the stream "agent".
  explicit RandomAgent(std::uint64_t seed) : random_(seed, "agent") {}
  /// One that goes on from a generator.
  explicit RandomAgent(const Random& random) : random_(random) {}
  /// One that goes on from a state of its kind. Throws FileError, naming `source`.
  RandomAgent(const AgentState& state, const std::string& source);

  Choice choose(const Observation& observation) override;
  Development observe(const Outcome& outcome) override;
  std::optional<AgentState> state() const override;
  /// What it draws from.
  const Random& random() const noexcept { return random_; }

 private:
  Random random_;
};

}  // namespace devlearn
