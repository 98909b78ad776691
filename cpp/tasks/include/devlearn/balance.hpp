#pragma once

#include <cstdint>
#include <vector>

#include "devlearn/detail/fields.hpp"
#include "devlearn/task.hpp"
#include "devlearn/two_wheeled_robot.hpp"

namespace devlearn {

/// The settings of Balance.
struct BalanceConfig {
  TwoWheeledDef robot;
  std::vector<double> torques{-0.04, -0.01, 0.0, 0.01, 0.04};
  double sample_time = 0.02;
  double substep = 0.01;
  double duration = 60.0;
  double angle_limit = 15.0;
  double start_angle = 2.0;
  std::vector<double> angle_edges{-6.0, -3.0, -1.0, 1.0, 3.0, 6.0};
  std::vector<double> rate_edges{-120.0, -60.0, -20.0, 20.0, 60.0, 120.0};
  std::vector<double> wheel_rate_edges{-360.0, -120.0, 120.0, 360.0};
  double sef_scale = 20.0;
  double sef_rate = 0.07;
  double sef_wheel_rate = 0.02;
  double fall_cost = 100.0;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using C = BalanceConfig;
    return described(
        "BalanceConfig", field("robot", &C::robot, "", Nested{}, "what balances"),
        field("torques", &C::torques, "M", list(whole(1, 1000), closed(-1000.0, 1000.0, "N m")),
              "the motions: what each motor is asked for"),
        field("sample_time", &C::sample_time, "t_s", above(0.0, 10.0, "s"), "time of a step"),
        field("substep", &C::substep, "", above(0.0, 10.0, "s"),
              "longest step of integration, of which a step has as many as it needs"),
        field("duration", &C::duration, "", above(0.0, 1e6, "s"),
              "after which an episode has succeeded"),
        field("angle_limit", &C::angle_limit, "", above(0.0, 90.0, "degrees"),
              "angle beyond which the robot has fallen"),
        field("start_angle", &C::start_angle, "", closed(0.0, 90.0, "degrees"),
              "an episode begins at rest, at any angle up to this, below the limit"),
        field("angle_edges", &C::angle_edges, "",
              list(whole(0, 100), closed(-90.0, 90.0, "degrees")),
              "rising; between which angles are one situation"),
        field("rate_edges", &C::rate_edges, "", list(whole(0, 100), closed(-1e6, 1e6, "degrees/s")),
              "the same of the angle's rate"),
        field("wheel_rate_edges", &C::wheel_rate_edges, "",
              list(whole(0, 100), closed(-1e6, 1e6, "degrees/s")), "the same of the wheels' rate"),
        field("sef_scale", &C::sef_scale, "", above(0.0, 1e6),
              "by how much SEF is lower where the robot leans by the limit than upright"),
        field("sef_rate", &C::sef_rate, "T_1", closed(0.0, 100.0, "s"),
              "time by which the angle's rate counts as lean"),
        field("sef_wheel_rate", &C::sef_wheel_rate, "T_2", closed(0.0, 100.0, "s"),
              "time by which the wheels' rate counts as lean"),
        field("fall_cost", &C::fall_cost, "", closed(0.0, 1e6),
              "cost of a step that ends in a fall; others cost nothing"));
  }
  /// Throws InvalidValue unless every field lies in its range.
  void validate() const { detail::require_fields(*this); }
};

inline bool operator==(const BalanceConfig& a, const BalanceConfig& b) noexcept {
  return detail::same_fields(a, b);
}
inline bool operator!=(const BalanceConfig& a, const BalanceConfig& b) noexcept {
  return !(a == b);
}

/// The state of a Balance, in degrees.
struct BalanceState {
  double angle = 0.0;       ///< of the body from upright, positive to the front [degrees]
  double rate = 0.0;        ///< its rate [degrees/s]
  double wheel = 0.0;       ///< angle of the wheels, by which they have rolled [degrees]
  double wheel_rate = 0.0;  ///< its rate [degrees/s]
};

/// A two-wheeled robot learns to stand, what the paper's reference [10] has its robot learn. An
/// episode begins at rest, at an angle drawn; it ends where the angle passes the limit, a fall, or
/// when the robot has stood for the duration. A motion is a torque, held for a sample time.
///
/// Situations are intervals of angle, of its rate and of the wheels' rate. SEF is the negative
/// square of a lean that looks ahead,
///
///     SEF = -sef_scale (u / angle_limit)^2,    u = psi + T_1 psi' + T_2 theta',
///
/// and SMF its growth (Eq. 8), at most -1 for a fall, as for a collision. With the defaults u is,
/// of the state of the default robot near upright, the part that grows by itself. A fall costs
/// fall_cost, collides and is event 1; having stood is event 0; all other steps cost nothing. The
/// estimate is 1 before the end: nothing is known of the cost to go. Senses: the state's four
/// numbers, in degrees.
class Balance final : public Task {
 public:
  using Config = BalanceConfig;  ///< its settings

  /// Throws InvalidValue, also for edges that do not rise, a start at or beyond the limit, and more
  /// than 1e9 steps in an episode or substeps in a step.
  explicit Balance(const Config& config = {});

  int motion_count() const noexcept override { return static_cast<int>(config_.torques.size()); }
  SituationId situation_count() const noexcept override;
  void begin(std::uint64_t seed) override;
  /// An episode begins in this state. Throws InvalidValue for numbers that are not finite, or an
  /// angle beyond the limit.
  void begin_at(const BalanceState& state);
  Observation observation() const override;
  Outcome step(int motion) override;
  bool succeeded() const noexcept override { return ended_ && stands(); }

  const Config& config() const noexcept { return config_; }  ///< its settings
  /// Which of them a state is.
  SituationId situation_of(const BalanceState& state) const noexcept;
  /// SEF of a state.
  double sef_of(const BalanceState& state) const noexcept;
  /// The present one.
  BalanceState state() const noexcept;
  /// Since the episode began [s].
  double time() const noexcept { return static_cast<double>(steps_) * config_.sample_time; }

 private:
  bool stands() const noexcept;
  void sense() noexcept;

  Config config_;
  TwoWheeledRobot robot_;
  int substeps_;
  std::int64_t limit_;
  TwoWheeledState state_;
  double senses_[4] = {};
  std::int64_t steps_ = 0;
  bool begun_ = false, ended_ = false;
};

}  // namespace devlearn
