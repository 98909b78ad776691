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

StateEvaluation StateEvaluation::scaled(double arena, double radius) {
  constexpr double kArena = 5.0;   // the paper's [m]
  constexpr double kRadius = 0.1;  // the paper's robot [m]
  require_in("StateEvaluation.scaled.arena", arena, 0.01, 1e6, "m");
  require_in("StateEvaluation.scaled.radius", radius, 1e-5, arena / 2.0, "m");
  StateEvaluation scaled;
  scaled.a2 *= (kArena / arena) * (kArena / arena);
  scaled.a5 *= kRadius / radius;
  return scaled;
}

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

void StateEvaluation::validate() const { detail::require_fields(*this); }

bool operator==(const StateEvaluation& a, const StateEvaluation& b) noexcept {
  return detail::same_fields(a, b);
}

}  // namespace devlearn
