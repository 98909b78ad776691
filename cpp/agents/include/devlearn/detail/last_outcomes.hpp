#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "devlearn/detail/value_table.hpp"

namespace devlearn::detail {

/// What came of each pair of a ValueTable when it was last tried: the model of a deterministic
/// world.
class LastOutcomes {
 public:
  LastOutcomes() = default;
  /// Those of a state, for this table. Throws FileError, naming `source`.
  LastOutcomes(const ValueTable& table, const AgentState& state, const std::string& source);
  /// Adds them to a state.
  void describe(const ValueTable& table, AgentState& state) const;

  /// Makes room for all of a table's pairs.
  void fit(const ValueTable& table) {
    reward_.resize(table.pairs());
    next_.resize(table.pairs(), kUntried);
  }
  void learn(std::size_t pair, double reward, Row next) noexcept {
    reward_[pair] = reward;
    next_[pair] = next;
  }

  std::size_t pairs() const noexcept { return next_.size(); }
  bool tried(std::size_t pair) const noexcept { return next_[pair] != kUntried; }
  double reward(std::size_t pair) const noexcept { return reward_[pair]; }
  Row next(std::size_t pair) const noexcept { return next_[pair]; }

 private:
  static constexpr Row kUntried = kNoRow - 1;  // beyond any row that a table has

  std::vector<double> reward_;
  std::vector<Row> next_;
};

}  // namespace devlearn::detail
