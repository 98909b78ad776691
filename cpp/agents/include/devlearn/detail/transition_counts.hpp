#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "devlearn/detail/value_table.hpp"
#include "devlearn/random.hpp"

namespace devlearn::detail {

/// How often each pair of a ValueTable led where: the model of a world in which one motion may lead
/// to different situations.
class TransitionCounts {
 public:
  TransitionCounts() = default;
  /// Those of a state, for this table. Throws FileError, naming `source`.
  TransitionCounts(const ValueTable& table, const AgentState& state, const std::string& source);
  /// Adds them to a state.
  void describe(AgentState& state) const;

  /// Makes room for all of a table's pairs.
  void fit(const ValueTable& table) {
    next_.resize(table.pairs());
    visits_.resize(table.pairs());
    leading_.resize(table.rows());
  }
  /// One more; below 2^31 of a pair. Whether it is the first to this row.
  bool learn(std::size_t pair, Row next);

  /// How often a pair was tried.
  std::uint32_t visits(std::size_t pair) const noexcept { return visits_[pair]; }
  /// One of the rows that a pair led to, by how often it did; it must have been tried.
  Row draw(std::size_t pair, Random& random) const;
  /// Pairs that led to a row, in order.
  const std::vector<std::size_t>& leading(Row row) const noexcept { return leading_[row]; }

 private:
  void lead(std::size_t pair, Row next);

  std::vector<std::map<Row, std::uint32_t>> next_;  // of each pair
  std::vector<std::uint32_t> visits_;               // their sum
  std::vector<std::vector<std::size_t>> leading_;   // of each row, in order
};

}  // namespace devlearn::detail
