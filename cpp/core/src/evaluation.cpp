#include "devlearn/evaluation.hpp"

#include <limits>

#include "devlearn/detail/require.hpp"
#include "devlearn/math.hpp"

namespace devlearn {
namespace {

void require_distances(double goal_distance, double obstacle_distance) {
  require_in("goal_distance", goal_distance, 0.0, 1e6, "m");
  require_in("obstacle_distance", obstacle_distance, 0.0, std::numeric_limits<double>::infinity(),
             "m");
}

// Eq. 6
double sef_at(const StateEvaluation& a, double goal_distance, double obstacle_distance) noexcept {
  // 0 times an infinite distance is no push at all, not NaN.
  const double decay = a.a5 == 0.0 ? 0.0 : a.a5 * obstacle_distance;
  return (a.a1 - a.a2 * (goal_distance * goal_distance)) - a.a3 * exponential(a.a4 - decay);
}

}  // namespace

double StateEvaluation::operator()(double goal_distance, double obstacle_distance) const {
  require_distances(goal_distance, obstacle_distance);
  return sef_at(*this, goal_distance, obstacle_distance);
}

void StateEvaluation::evaluate(const double* goal_distances, const double* obstacle_distances,
                               std::size_t count, double* sef) const {
  require_each(count,
               [&](std::size_t i) { require_distances(goal_distances[i], obstacle_distances[i]); });
  for (std::size_t i = 0; i < count; ++i) {
    sef[i] = sef_at(*this, goal_distances[i], obstacle_distances[i]);
  }
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
