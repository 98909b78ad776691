#pragma once

#include "devlearn/detail/fields.hpp"

namespace devlearn {

/// By how much chance spoils what a robot does and senses: standard deviations, and chances, of
/// each step. All of it is drawn from the stream "noise" of the seed; by default there is none, and
/// nothing is drawn.
struct NoiseDef {
  double turn = 0.0;
  double drive = 0.0;
  double slip = 0.0;
  double odometry_turn = 0.0;
  double odometry_drive = 0.0;
  double echo = 0.0;
  double bearing = 0.0;
  double dropout = 0.0;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using N = NoiseDef;
    return described(
        "NoiseDef",
        later(field("turn", &N::turn, "", closed(0.0, 90.0, "degrees"),
                    "standard deviation of a step's turn from the motion's")),
        later(field("drive", &N::drive, "", closed(0.0, 1.0, "m"),
                    "standard deviation of a step's drive from v t_s; it never goes backwards")),
        later(field("slip", &N::slip, "", closed(0.0, 1.0),
                    "chance that a motion drawn evenly from M is made in place of the one chosen")),
        later(field(
            "odometry_turn", &N::odometry_turn, "", closed(0.0, 90.0, "degrees"),
            "standard deviation of what odometry makes of a step's turn; it adds up until the "
            "robot is put somewhere")),
        later(field("odometry_drive", &N::odometry_drive, "", closed(0.0, 1.0),
                    "standard deviation of what odometry makes of a step's way, as a share of it; "
                    "likewise")),
        later(field("echo", &N::echo, "", closed(0.0, 10.0, "m"),
                    "standard deviation of a sonar's echo distance")),
        later(field("bearing", &N::bearing, "", closed(0.0, 90.0, "degrees"),
                    "standard deviation of where a sonar looks")),
        later(field("dropout", &N::dropout, "", closed(0.0, 1.0),
                    "chance that a sonar hears nothing")));
  }

  /// Throws InvalidValue unless every field lies in its range.
  void validate() const { detail::require_fields(*this); }
  /// Whether motions come out other than they are meant.
  bool of_motion() const noexcept { return turn > 0.0 || drive > 0.0; }
  /// Whether the robot errs about its pose.
  bool of_odometry() const noexcept { return odometry_turn > 0.0 || odometry_drive > 0.0; }
  /// Whether its sonars err.
  bool of_sonars() const noexcept { return echo > 0.0 || bearing > 0.0 || dropout > 0.0; }
};

inline bool operator==(const NoiseDef& a, const NoiseDef& b) noexcept {
  return detail::same_fields(a, b);
}
inline bool operator!=(const NoiseDef& a, const NoiseDef& b) noexcept { return !(a == b); }

}  // namespace devlearn
