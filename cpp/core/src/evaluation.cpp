#include "devlearn/evaluation.hpp"

#include <limits>

#include "devlearn/detail/require.hpp"
#include "devlearn/math.hpp"

namespace devlearn {

double StateEvaluation::operator()(double goal_distance, double obstacle_distance) const {
  require_in("goal_distance", goal_distance, 0.0, 1e6, "m");
  require_in("obstacle_distance", obstacle_distance, 0.0, std::numeric_limits<double>::infinity(),
             "m");
  // 0 times an infinite distance is no push at all, not NaN.
  const double decay = a5 == 0.0 ? 0.0 : a5 * obstacle_distance;
  return (a1 - a2 * (goal_distance * goal_distance)) - a3 * exponential(a4 - decay);
}

void StateEvaluation::validate() const {
  require_in("StateEvaluation.a1", a1, -1e6, 1e6);
  require_in("StateEvaluation.a2", a2, 0.0, 1e6, "1/m^2");
  require_in("StateEvaluation.a3", a3, 0.0, 1e6);
  require_in("StateEvaluation.a4", a4, -100.0, 100.0);
  require_in("StateEvaluation.a5", a5, 0.0, 1e6, "1/m");
}

bool operator==(const StateEvaluation& a, const StateEvaluation& b) noexcept {
  return a.a1 == b.a1 && a.a2 == b.a2 && a.a3 == b.a3 && a.a4 == b.a4 && a.a5 == b.a5;
}

}  // namespace devlearn
