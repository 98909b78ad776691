#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "devlearn/detail/value_table.hpp"

namespace devlearn::detail {

/// Where an option ends from a situation, and how probably, discounted by the steps to it.
struct Ending {
  Row row;  ///< kNoRow: with an arrival
  double probability;
};

/// An option's model by intra-option learning (Sutton, Precup & Singh 1999, section 6):
/// P(x | s) = E[gamma^k; it ends in x after k steps], and R(s), the discounted reward till then.
/// Of each P(. | s) the largest are kept, as many as are asked for, and of these what is not below
/// 1e-6; the others count as 0.
class OptionModel {
 public:
  void fit(std::size_t rows) {
    reward_.resize(rows);
    endings_.resize(rows);
  }

  double reward(Row row) const noexcept { return reward_[row]; }
  /// P(. | s), by rows.
  const std::vector<Ending>& endings(Row row) const noexcept { return endings_[row]; }
  /// P(x | s)
  double probability(Row row, Row end) const noexcept;
  /// sum_x P(x | s)
  double probability(Row row) const noexcept;
  /// sum_x P(x | s) worth(x)
  template <typename Worth>
  double mean(Row row, const Worth& worth) const {
    double sum = 0.0;
    for (const Ending& ending : endings_[row]) sum += ending.probability * worth(ending.row);
    return sum;
  }

  /// The greedy motion led from `row` to `next`, where the option ended, or goes on:
  ///
  ///     P(x | s) <- P(x | s) + alpha (gamma (ended ? [x = s'] : P(x | s')) - P(x | s))
  ///     R(s)     <- R(s)     + alpha (r + (ended ? 0 : gamma R(s')) - R(s))
  void learn(Row row, double reward, Row next, bool ended, double alpha, double gamma,
             std::size_t most);

  void set(Row row, double reward, std::vector<Ending> endings) {
    reward_[row] = reward;
    endings_[row] = std::move(endings);
  }

 private:
  std::vector<double> reward_;                // R, by row
  std::vector<std::vector<Ending>> endings_;  // P, by row
};

}  // namespace devlearn::detail
