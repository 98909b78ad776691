#pragma once

#include "devlearn/detail/fields.hpp"

namespace devlearn {

/// A two-wheeled robot that balances, in the plane. The defaults are those of NXTway-GS, a robot of
/// LEGO Mindstorms NXT (Y. Yamamoto, "NXTway-GS Model-Based Design", 2009, its param_plant.m).
struct TwoWheeledDef {
  double gravity = 9.81;
  double wheel_mass = 0.03;
  double wheel_radius = 0.04;
  double body_mass = 0.6;
  double body_height = 0.144;
  double motor_inertia = 1e-5;
  double gear_ratio = 1.0;
  double motor_friction = 0.0022;
  double floor_friction = 0.0;
  double torque_constant = 0.317;
  double back_emf = 0.468;
  double resistance = 6.69;
  double battery = 8.0;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using C = TwoWheeledDef;
    return described(
        "TwoWheeledDef", field("gravity", &C::gravity, "g", above(0.0, 100.0, "m/s^2"), "gravity"),
        field("wheel_mass", &C::wheel_mass, "m", above(0.0, 1000.0, "kg"),
              "of a wheel, a disk of inertia J_w = m R^2 / 2"),
        field("wheel_radius", &C::wheel_radius, "R", above(0.0, 10.0, "m"), "of a wheel"),
        field("body_mass", &C::body_mass, "M", above(0.0, 1000.0, "kg"),
              "of the body, of inertia J_psi = M L^2 / 3 about its centre"),
        field("body_height", &C::body_height, "H", above(0.0, 10.0, "m"),
              "of the body, whose centre is L = H / 2 above the axle"),
        field("motor_inertia", &C::motor_inertia, "J_m", closed(0.0, 10.0, "kg m^2"), "of a motor"),
        field("gear_ratio", &C::gear_ratio, "n", above(0.0, 1000.0), "of a motor to its wheel"),
        field("motor_friction", &C::motor_friction, "f_m", closed(0.0, 100.0, "N m s"),
              "torque of friction between body and wheel per angular rate"),
        field("floor_friction", &C::floor_friction, "f_w", closed(0.0, 100.0, "N m s"),
              "torque of friction between wheel and floor per angular rate"),
        field("torque_constant", &C::torque_constant, "K_t", above(0.0, 100.0, "N m/A"),
              "of a motor"),
        field("back_emf", &C::back_emf, "K_b", closed(0.0, 100.0, "V s"), "constant of a motor"),
        field("resistance", &C::resistance, "R_m", above(0.0, 1e6, "Ohm"), "of a motor"),
        field("battery", &C::battery, "V", above(0.0, 1000.0, "V"),
              "voltage, which bounds the torque that a motor can give at a rate"));
  }
  /// Throws InvalidValue unless every field lies in its range.
  void validate() const { detail::require_fields(*this); }
};

inline bool operator==(const TwoWheeledDef& a, const TwoWheeledDef& b) noexcept {
  return detail::same_fields(a, b);
}
inline bool operator!=(const TwoWheeledDef& a, const TwoWheeledDef& b) noexcept {
  return !(a == b);
}

/// Angles and rates of the robot, in radians: of the body from upright, positive to the front, and
/// of the wheels, which roll without slipping: x = R theta.
struct TwoWheeledState {
  double angle = 0.0;       ///< psi [rad]
  double rate = 0.0;        ///< its rate [rad/s]
  double wheel = 0.0;       ///< theta [rad]
  double wheel_rate = 0.0;  ///< its rate [rad/s]
};

/// The mechanics of a two-wheeled robot that drives straight on (Yamamoto 2009, without yaw), with
/// the torque tau of each motor on its wheel as control:
///
///     E11 theta'' + E12 psi'' - M L R psi'^2 sin psi = 2 tau - 2 (f_m + f_w) theta' + 2 f_m psi'
///     E12 theta'' + E22 psi'' - M g L sin psi        = -2 tau + 2 f_m theta' - 2 f_m psi'
///
///     E11 = (2 m + M) R^2 + 2 J_w + 2 n^2 J_m    E12 = M L R cos psi - 2 n^2 J_m
///     E22 = M L^2 + J_psi + 2 n^2 J_m
///
/// The source has the motor's voltage v as control: tau = n K_t (v - K_b (theta' - psi')) / R_m.
/// Here a torque is asked for, and given as far as v stays within the battery's; a motor that would
/// have to be faster than that gives none.
class TwoWheeledRobot {
 public:
  /// Throws InvalidValue.
  explicit TwoWheeledRobot(const TwoWheeledDef& def = {});

  const TwoWheeledDef& def() const noexcept { return def_; }  ///< what it was made of
  /// What is given of a torque that each motor is asked for [N m].
  double given(double torque, const TwoWheeledState& state) const noexcept;
  /// Rates of the four numbers of a state.
  TwoWheeledState derivative(const TwoWheeledState& state, double torque) const noexcept;
  /// The state after so long [s], in so many steps of Runge and Kutta's fourth order. Operations
  /// are fixed: the same on every machine.
  TwoWheeledState after(TwoWheeledState state, double torque, double time,
                        int steps) const noexcept;
  /// Kinetic and potential energy [J], 0 for the body at the height of the axle and at rest.
  double energy(const TwoWheeledState& state) const noexcept;

 private:
  TwoWheeledDef def_;
  double arm_, e11_, motors_, e22_;  // M L, and 2 n^2 J_m
};

}  // namespace devlearn
