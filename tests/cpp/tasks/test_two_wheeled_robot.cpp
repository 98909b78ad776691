#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "core/field_laws.hpp"
#include "devlearn/two_wheeled_robot.hpp"

using namespace devlearn;

namespace {

// Neither motors' friction nor the floor's.
TwoWheeledDef frictionless() {
  TwoWheeledDef def;
  def.motor_friction = 0.0;
  return def;
}

double distance(const TwoWheeledState& a, const TwoWheeledState& b) {
  return std::abs(a.angle - b.angle) + std::abs(a.rate - b.rate) + std::abs(a.wheel - b.wheel) +
         std::abs(a.wheel_rate - b.wheel_rate);
}

// As param_plant.m of the source computes them, for the default robot.
struct Linear {
  double g = 9.81, m = 0.03, R = 0.04, Jw = m * R * R / 2, M = 0.6, H = 0.144, L = H / 2;
  double Jpsi = M * L * L / 3, fm = 0.0022, fw = 0.0, Jm = 1e-5, Rm = 6.69, Kb = 0.468, Kt = 0.317;
  double alpha = Kt / Rm, beta = Kt * Kb / Rm + fm;
  double E_11 = (2 * m + M) * R * R + 2 * Jw + 2 * Jm;
  double E_12 = M * L * R - 2 * Jm;
  double E_22 = M * L * L + Jpsi + 2 * Jm;
  double detE = E_11 * E_22 - E_12 * E_12;
  // theta'' and psi'' by psi, theta', psi' and the voltage of both motors.
  double A1_32 = -g * M * L * E_12 / detE, A1_42 = g * M * L * E_11 / detE;
  double A1_33 = -2 * ((beta + fw) * E_22 + beta * E_12) / detE;
  double A1_43 = 2 * ((beta + fw) * E_12 + beta * E_11) / detE;
  double A1_34 = 2 * beta * (E_22 + E_12) / detE, A1_44 = -2 * beta * (E_11 + E_12) / detE;
  double B1_3 = 2 * alpha * (E_22 + E_12) / detE, B1_4 = -2 * alpha * (E_11 + E_12) / detE;
};

}  // namespace

TEST_CASE("every field of the robot is described, compared and refused beyond its bounds") {
  field_laws::check_fields<TwoWheeledDef>();
}

TEST_CASE("near upright the accelerations are those of the source's state-space matrix") {
  const TwoWheeledRobot robot;
  const Linear linear;
  const double tiny = 1e-7, volts = 3.0;
  const auto near = [](double value) { return doctest::Approx(value).epsilon(1e-6); };
  // A voltage as the torque that it gives at these rates.
  const auto at = [&](const TwoWheeledState& state, double v) {
    const double torque = linear.alpha * (v - linear.Kb * (state.wheel_rate - state.rate));
    return robot.derivative(state, torque);
  };
  CHECK(at({tiny, 0, 0, 0}, 0.0).wheel_rate / tiny == near(linear.A1_32));
  CHECK(at({tiny, 0, 0, 0}, 0.0).rate / tiny == near(linear.A1_42));
  CHECK(at({0, 0, 0, tiny}, 0.0).wheel_rate / tiny == near(linear.A1_33));
  CHECK(at({0, 0, 0, tiny}, 0.0).rate / tiny == near(linear.A1_43));
  CHECK(at({0, tiny, 0, 0}, 0.0).wheel_rate / tiny == near(linear.A1_34));
  CHECK(at({0, tiny, 0, 0}, 0.0).rate / tiny == near(linear.A1_44));
  CHECK(at({0, 0, 0, 0}, volts).wheel_rate / volts == near(linear.B1_3));
  CHECK(at({0, 0, 0, 0}, volts).rate / volts == near(linear.B1_4));
  const TwoWheeledState rolled = at({0, 0, 9.0, 0}, 0.0);  // where it stands makes no difference
  CHECK(rolled.rate == 0.0);
  CHECK(rolled.wheel_rate == 0.0);
}

TEST_CASE("without friction and torque energy is conserved, also in a whole fall") {
  const TwoWheeledRobot robot(frictionless());
  for (const double angle : {0.02, 0.3, 1.2}) {
    TwoWheeledState state{angle, 0.1, 0.0, -0.5};
    const double before = robot.energy(state);
    double worst = 0.0;
    for (int step = 0; step < 100; ++step) {
      state = robot.after(state, 0.0, 0.02, 20);
      worst = std::max(worst, std::abs(robot.energy(state) - before));
    }
    CHECK(worst < 1e-6 * before);
    CHECK(std::abs(state.rate) > 0.1);
  }
}

TEST_CASE("friction takes energy, and a torque gives what it does on the wheels against the body") {
  const TwoWheeledRobot robot;
  TwoWheeledState state{0.1, 0.0, 0.0, 3.0};
  double energy = robot.energy(state);
  for (int step = 0; step < 50; ++step) {
    state = robot.after(state, 0.0, 0.02, 10);
    CHECK(robot.energy(state) < energy);
    energy = robot.energy(state);
  }
  const TwoWheeledRobot ideal(frictionless());
  const TwoWheeledState before{0.1, 0.5, 0.0, 1.0};
  const TwoWheeledState after = ideal.after(before, 0.02, 0.1, 100);
  const double turned = (after.wheel - before.wheel) - (after.angle - before.angle);
  CHECK(ideal.energy(after) - ideal.energy(before) == doctest::Approx(2.0 * 0.02 * turned));
}

TEST_CASE("a frictionless robot falls from upright as e^(lambda t), lambda^2 = g M L E11 / det E") {
  const TwoWheeledRobot robot(frictionless());
  const Linear linear;
  const double lambda = std::sqrt(linear.A1_42);
  CHECK(lambda == doctest::Approx(16.4).epsilon(0.01));  // 1/s
  const double angle = 1e-7, time = 0.5;
  // On the growing mode the wheels run away as A1_32 / A1_42 of the body.
  const double ratio = linear.A1_32 / linear.A1_42;
  const TwoWheeledState begun{angle, lambda * angle, ratio * angle, ratio * lambda * angle};
  const TwoWheeledState after = robot.after(begun, 0.0, time, 500);
  CHECK(after.angle == doctest::Approx(angle * std::exp(lambda * time)).epsilon(1e-6));
  CHECK(after.wheel_rate == doctest::Approx(ratio * lambda * after.angle).epsilon(1e-6));
}

TEST_CASE("hung upside down a frictionless robot swings with the period of its closed form") {
  const TwoWheeledRobot robot(frictionless());
  const Linear linear;
  const double pi = 3.14159265358979323846;
  const double E_12 = -linear.M * linear.L * linear.R - 2 * linear.Jm;  // cos psi = -1
  const double det = linear.E_11 * linear.E_22 - E_12 * E_12;
  const double period = 2 * pi / std::sqrt(linear.g * linear.M * linear.L * linear.E_11 / det);
  const TwoWheeledState begun{pi + 1e-5, 0, 0, 0};
  const TwoWheeledState half = robot.after(begun, 0.0, period / 2, 2000);
  const TwoWheeledState whole = robot.after(begun, 0.0, period, 4000);
  CHECK(half.angle - pi == doctest::Approx(-1e-5).epsilon(1e-5));
  CHECK(whole.angle - pi == doctest::Approx(1e-5).epsilon(1e-5));
}

TEST_CASE("halving the step of integration divides the error by sixteen") {
  const TwoWheeledRobot robot;
  const auto fallen = [&](int steps) {
    TwoWheeledState state{0.05, 0.3, 0.0, 2.0};
    for (int i = 0; i < 12; ++i) state = robot.after(state, (i % 3 - 1) * 0.03, 0.02, steps);
    return state;
  };
  const TwoWheeledState exact = fallen(256);
  CHECK(exact.angle > 1.0);
  double before = distance(fallen(1), exact);
  CHECK(before < 3e-3);
  for (const int steps : {2, 4, 8}) {
    const double error = distance(fallen(steps), exact);
    CHECK(before / error == doctest::Approx(16.0).epsilon(0.15));
    before = error;
  }
}

TEST_CASE("a motor gives no more than the battery's voltage makes it") {
  const TwoWheeledRobot robot;
  const Linear linear;
  CHECK(robot.given(0.03, {}) == 0.03);
  CHECK(robot.given(9.0, {}) == doctest::Approx(linear.alpha * 8.0));
  CHECK(robot.given(-9.0, {}) == doctest::Approx(-linear.alpha * 8.0));
  const double idle = 8.0 / linear.Kb;  // the rate that needs the whole voltage
  CHECK(robot.given(0.03, {0, 0, 0, idle}) == doctest::Approx(0.0));
  CHECK(robot.given(-0.03, {0, 0, 0, idle}) == -0.03);
  CHECK(robot.given(0.03, {0, idle, 0, 0}) == 0.03);
  CHECK(robot.given(0.03, {0, 0, 0, 2 * idle}) == 0.0);  // and does not brake unasked
}

TEST_CASE("a robot leans and rolls alike to the front and to the back") {
  const TwoWheeledRobot robot;
  const TwoWheeledState front = robot.after({0.1, 0.2, 0.3, 0.4}, 0.02, 0.2, 20);
  const TwoWheeledState back = robot.after({-0.1, -0.2, -0.3, -0.4}, -0.02, 0.2, 20);
  CHECK(front.angle == doctest::Approx(-back.angle));
  CHECK(front.wheel_rate == doctest::Approx(-back.wheel_rate));
}
