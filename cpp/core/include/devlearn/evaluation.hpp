#pragma once

#include <cstddef>

#include "devlearn/detail/fields.hpp"

namespace devlearn {

/// Step 2 of the method, the state evaluation function (Eq. 6): how good it is to be here.
///
///   SEF = (a1 - a2 d_g^2) - a3 exp(a4 - a5 d_o)
///
/// It grows towards the target and falls steeply close to an obstacle.
struct StateEvaluation {
  double a1 = 20.0;
  double a2 = 0.3;
  double a3 = 0.2;
  double a4 = 5.0;
  double a5 = 12.0;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using E = StateEvaluation;
    return described(
        "StateEvaluation",
        field("a1", &E::a1, "a_1", closed(-1e6, 1e6), "SEF at the target, far from obstacles"),
        field("a2", &E::a2, "a_2", closed(0.0, 1e6, "1/m^2"), "pull of the target"),
        field("a3", &E::a3, "a_3", closed(0.0, 1e6), "push of obstacles"),
        field("a4", &E::a4, "a_4", closed(-100.0, 100.0),
              "log of the push at an obstacle's surface"),
        field("a5", &E::a5, "a_5", closed(0.0, 1e6, "1/m"), "how fast the push decays"));
  }

  /// The paper's shape for another arena [m, its greater side, in [0.01, 1e6]] and another radius
  /// of the robot [m, in [1e-5, arena / 2]]: SEF is the paper's at the same share of the arena from
  /// the target and the same number of radii from an obstacle. The paper's 5 m and 0.1 m give the
  /// defaults; else a2 = 0.3 (5 m / arena)^2 and a5 = 12 (0.1 m / radius). Throws InvalidValue.
  static StateEvaluation scaled(double arena, double radius);

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
