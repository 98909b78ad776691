#pragma once

#include <cstddef>
#include <vector>

namespace devlearn {

/// What each motion sets the motors to: a matrix, a row a motion.
struct Motors {
  std::vector<double> values;  ///< row by row, each in [-1e9, 1e9]
  int columns = 1;             ///< numbers of a motion, in 1 ... 1000

  /// How many motions it has; columns must not be 0.
  std::size_t rows() const noexcept { return values.size() / static_cast<std::size_t>(columns); }
  /// The first number of a motion.
  const double* row(int motion) const noexcept {
    return values.data() + static_cast<std::ptrdiff_t>(motion) * columns;
  }
};

}  // namespace devlearn
