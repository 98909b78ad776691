#pragma once

#include <cstdint>
#include <optional>

#include "devlearn/detail/fields.hpp"
#include "devlearn/motors.hpp"
#include "devlearn/random.hpp"
#include "devlearn/situation.hpp"
#include "devlearn/task.hpp"

namespace devlearn {

/// The settings of Attention.
struct AttentionConfig {
  int speeds = 5;
  int frequencies = 9;
  double side = 1.0;
  double speed = 0.1;
  double axle = 0.2;
  double noise = 0.01;
  int steps = 5000;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using C = AttentionConfig;
    return described(
        "AttentionConfig",
        field("speeds", &C::speeds, "", whole(2, 21), "speeds of a wheel, evenly from -1 to 1"),
        field("frequencies", &C::frequencies, "", whole(3, 99),
              "frequencies of the sound, in the middles of even parts of [0, 1]"),
        field("side", &C::side, "", closed(0.01, 1e3, "m"), "side of the square room"),
        field("speed", &C::speed, "", closed(0.0, 1e3, "m"),
              "way of a wheel in a step at a speed of 1"),
        field("axle", &C::axle, "", closed(0.001, 1e3, "m"), "distance between the wheels"),
        field("noise", &C::noise, "", closed(0.0, 1e3, "m"),
              "standard deviation of the distance that is sensed"),
        field("steps", &C::steps, "", whole(1, 1'000'000'000), "steps of an episode"));
  }
  /// Throws InvalidValue unless every setting lies in its range.
  void validate() const { detail::require_fields(*this); }
};

inline bool operator==(const AttentionConfig& a, const AttentionConfig& b) noexcept {
  return detail::same_fields(a, b);
}
inline bool operator!=(const AttentionConfig& a, const AttentionConfig& b) noexcept {
  return !(a == b);
}

/// A room with a robot on two wheels, which can sound, and a toy (Oudeyer, Kaplan & Hafner 2007,
/// section VI). A motion is (l, r, f): the speeds of the left and right wheel in [-1, 1], and the
/// frequency of a sound in [0, 1]. What is sensed is the distance to the toy, with noise [m]. What
/// the toy does depends on the frequency:
///
///     below 1/3   it goes somewhere else in the room, anywhere: nobody can know
///     below 2/3   it stays: how the distance changes depends on l and r
///     else        it jumps to the robot: the distance is 0
///
/// Nothing is to be reached, and a step costs nothing: what matters is where attention goes. An
/// episode begins with all in random places and ends after Config::steps.
class Attention final : public Task {
 public:
  using Config = AttentionConfig;  ///< its settings
  /// What the toy does.
  enum class Zone : std::uint8_t {
    kRandom = 0,  ///< it moves at random
    kStays = 1,   ///< it stays where it is
    kJumps = 2,   ///< it jumps to the robot
  };

  /// Throws InvalidValue.
  explicit Attention(const Config& config = {});

  int motion_count() const noexcept override { return static_cast<int>(motors_.rows()); }
  /// Tenths of the room's side, of what is sensed; the last one is also all beyond.
  SituationId situation_count() const noexcept override { return 15; }
  void begin(std::uint64_t seed) override;
  Observation observation() const override;
  Outcome step(int motion) override;
  /// Whether an episode has ended: nothing can go wrong.
  bool succeeded() const noexcept override { return left_ == 0; }

  const Config& config() const noexcept { return config_; }  ///< its settings
  /// (l, r, f) of each motion; f varies fastest.
  const Motors& motors() const noexcept { return motors_; }
  /// What the toy does at a motion. Throws InvalidValue for a motion that is none.
  Zone zone(int motion) const;
  const Pose& robot() const noexcept { return robot_; }   ///< where the robot is
  Point toy() const noexcept { return toy_; }             ///< where the toy is
  double distance() const noexcept { return distance_; }  ///< as it is sensed [m]

 private:
  void require_motion(int motion) const;
  void require_under_way(const char* call) const;
  Point anywhere() noexcept;
  void sense() noexcept;

  Config config_;
  Motors motors_;
  Random random_{0, "task"};
  Pose robot_;
  Point toy_;
  double distance_ = 0.0;
  int left_ = -1;  // steps of the episode; -1 before the first
};

}  // namespace devlearn
