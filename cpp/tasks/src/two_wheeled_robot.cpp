#include "devlearn/two_wheeled_robot.hpp"

#include <algorithm>

#include "devlearn/math.hpp"

namespace devlearn {
namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

TwoWheeledState sum(const TwoWheeledState& state, const TwoWheeledState& rates,
                    double time) noexcept {
  return {state.angle + time * rates.angle, state.rate + time * rates.rate,
          state.wheel + time * rates.wheel, state.wheel_rate + time * rates.wheel_rate};
}

}  // namespace

TwoWheeledRobot::TwoWheeledRobot(const TwoWheeledDef& def) : def_((def.validate(), def)) {
  const double radius = def.wheel_radius, length = def.body_height / 2.0;
  arm_ = def.body_mass * length;
  motors_ = 2.0 * def.gear_ratio * def.gear_ratio * def.motor_inertia;
  const double wheels = 2.0 * (def.wheel_mass * radius * radius / 2.0);
  e11_ = (2.0 * def.wheel_mass + def.body_mass) * radius * radius + wheels + motors_;
  e22_ = arm_ * length + arm_ * length / 3.0 + motors_;
}

double TwoWheeledRobot::given(double torque, const TwoWheeledState& state) const noexcept {
  const double per_volt = def_.gear_ratio * def_.torque_constant / def_.resistance;
  const double induced = def_.back_emf * (state.wheel_rate - state.rate);
  return std::clamp(torque, std::min(per_volt * (-def_.battery - induced), 0.0),
                    std::max(per_volt * (def_.battery - induced), 0.0));
}

TwoWheeledState TwoWheeledRobot::derivative(const TwoWheeledState& state,
                                            double torque) const noexcept {
  const Direction up = direction(state.angle * kDegrees);  // cosine and sine
  const double e12 = arm_ * def_.wheel_radius * up.x - motors_;
  const double between =
      2.0 * given(torque, state) - 2.0 * def_.motor_friction * (state.wheel_rate - state.rate);
  const double on_wheels = between - 2.0 * def_.floor_friction * state.wheel_rate +
                           arm_ * def_.wheel_radius * state.rate * state.rate * up.y;
  const double on_body = arm_ * def_.gravity * up.y - between;
  const double determinant = e11_ * e22_ - e12 * e12;
  return {state.rate, (e11_ * on_body - e12 * on_wheels) / determinant, state.wheel_rate,
          (e22_ * on_wheels - e12 * on_body) / determinant};
}

TwoWheeledState TwoWheeledRobot::after(TwoWheeledState state, double torque, double time,
                                       int steps) const noexcept {
  const double h = time / steps;
  for (int step = 0; step < steps; ++step) {
    const TwoWheeledState k1 = derivative(state, torque);
    const TwoWheeledState k2 = derivative(sum(state, k1, h / 2.0), torque);
    const TwoWheeledState k3 = derivative(sum(state, k2, h / 2.0), torque);
    const TwoWheeledState k4 = derivative(sum(state, k3, h), torque);
    state = sum(sum(sum(sum(state, k1, h / 6.0), k2, h / 3.0), k3, h / 3.0), k4, h / 6.0);
  }
  return state;
}

double TwoWheeledRobot::energy(const TwoWheeledState& state) const noexcept {
  const double cosine = direction(state.angle * kDegrees).x;
  const double e12 = arm_ * def_.wheel_radius * cosine - motors_;
  return 0.5 * e11_ * state.wheel_rate * state.wheel_rate + e12 * state.wheel_rate * state.rate +
         0.5 * e22_ * state.rate * state.rate + arm_ * def_.gravity * cosine;
}

}  // namespace devlearn
