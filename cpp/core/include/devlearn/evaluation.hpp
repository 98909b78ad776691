#pragma once

#include <cstddef>

namespace devlearn {

/// Step 2 of the method, the state evaluation function (Eq. 6): how good it is to be here.
///
///   SEF = (a1 - a2 d_g^2) - a3 exp(a4 - a5 d_o)
///
/// It grows towards the target and falls steeply close to an obstacle.
struct StateEvaluation {
  double a1 = 20.0;  ///< SEF at the target, far from obstacles; in [-1e6, 1e6]
  double a2 = 0.3;   ///< pull of the target [1/m^2]; in [0, 1e6]
  double a3 = 0.2;   ///< push of obstacles; in [0, 1e6]
  double a4 = 5.0;   ///< log of the push at an obstacle's surface; in [-100, 100]
  double a5 = 12.0;  ///< how fast the push decays [1/m]; in [0, 1e6]

  /// goal_distance: d_g in [0, 1e6] m. obstacle_distance: d_o >= 0 m; infinite where there is no
  /// obstacle. Throws InvalidValue.
  double operator()(double goal_distance, double obstacle_distance) const;

  /// The same of many pairs, written into sef. Where it throws, nothing was written.
  /// devlearn/eigen.hpp has this for arrays.
  void evaluate(const double* goal_distances, const double* obstacle_distances, std::size_t count,
                double* sef) const;

  /// Throws InvalidValue unless every parameter lies in its range.
  void validate() const;
};

bool operator==(const StateEvaluation& a, const StateEvaluation& b) noexcept;
inline bool operator!=(const StateEvaluation& a, const StateEvaluation& b) noexcept {
  return !(a == b);
}

}  // namespace devlearn
