#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "devlearn/adaptive.hpp"
#include "devlearn/detail/fields.hpp"
#include "devlearn/evaluation.hpp"
#include "devlearn/learner.hpp"
#include "devlearn/noise.hpp"
#include "devlearn/robot.hpp"
#include "devlearn/situation.hpp"

namespace devlearn {

/// Where d_o of Eq. 6 comes from.
enum class ClearanceSource : std::uint8_t {
  kGeometric,  ///< exact distance from the robot's centre to the nearest surface
  kSonar,      ///< least echo plus the robot's radius, what a real robot has
};

/// Everything a trial needs besides the world and the seed; the defaults are the paper's.
struct TrialConfig {
  std::variant<LearnerConfig, AdaptiveConfig> learner;
  StateEvaluation evaluation;
  RobotDef robot;
  ClearanceSource clearance_source = ClearanceSource::kGeometric;
  bool walls_count = false;
  double goal_radius = 0.1;
  double touch_cost = 5.0;
  double cell_size = 0.25;
  int heading_bins = 12;
  NoiseDef noise;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using C = TrialConfig;
    return described(
        "TrialConfig",
        field("learner", &C::learner, "", one_of("learner", "adaptive"),
              "the paper's steps 3-5, or the adaptive learner; its motions are the robot's"),
        field("evaluation", &C::evaluation, "", Nested{}, "step 2, Eq. 6"),
        field("robot", &C::robot, "", Nested{}, "Eq. 1-2"),
        field("clearance_source", &C::clearance_source, "", names("geometric", "sonar"),
              "where d_o of Eq. 6 comes from: the exact distance, or the least echo plus the "
              "robot's radius"),
        field("walls_count", &C::walls_count, "", Truth{},
              "whether walls count in d_o; the clearance source sonar needs it"),
        field("goal_radius", &C::goal_radius, "", above(0.0, 100.0, "m"),
              "arrived when d_g is no more than this"),
        later(field("touch_cost", &C::touch_cost, "", closed(0.0, 1e6),
                    "what a step costs beside 1 where the body touched something; the paper's "
                    "learner does not look at costs")),
        field("cell_size", &C::cell_size, "", closed(0.001, 1000.0, "m"),
              "side of a cell of the situation grid"),
        field("heading_bins", &C::heading_bins, "", whole(1, 3600),
              "headings of the situation grid"),
        field("noise", &C::noise, "", Nested{}, "what chance spoils of motions and senses"));
  }

  /// The default; see LearnerConfig::paper.
  static TrialConfig paper() { return {}; }
  /// See LearnerConfig::step5.
  static TrialConfig step5();
  /// The paper's, with an AdaptiveConfig.
  static TrialConfig adaptive();

  /// N_M of the learner.
  int motion_count() const;

  /// Throws InvalidValue.
  void validate() const;
};

bool operator==(const TrialConfig& a, const TrialConfig& b);
inline bool operator!=(const TrialConfig& a, const TrialConfig& b) { return !(a == b); }

/// What is sensed at a pose. The sonars' echoes there are told by a Robot of the same world and
/// def.
struct Senses {
  Pose pose;                   ///< [m, m, degrees]
  double goal_distance = 0.0;  ///< d_g [m]
  double clearance = 0.0;      ///< d_o [m]
};

/// A function of what is sensed, under a name by which a snapshot knows it: the same value for the
/// same senses. What it throws comes out of the trial's call.
template <typename Value>
struct NamedFunction {
  std::string name;                              ///< UTF-8; empty where there is no function
  std::function<Value(const Senses&)> function;  ///< null: the trial's own
};

/// What stands in place of Eq. 6 and of the grid's situations; by default nothing. Redefining both
/// is what the paper concludes with.
struct TrialParts {
  NamedFunction<double> evaluation;  ///< SEF, within +-1e300
  /// Or SEF of each of the grid's situations, as long as there are such; empty: none.
  std::vector<double> sef_table;
  NamedFunction<SituationId> situations;  ///< ids, at least 0
};

}  // namespace devlearn
