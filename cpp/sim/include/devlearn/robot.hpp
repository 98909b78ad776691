#pragma once

#include <memory>
#include <string>
#include <vector>

#include "devlearn/detail/fields.hpp"
#include "devlearn/situation.hpp"
#include "devlearn/world.hpp"

namespace devlearn {

struct Drive;
struct Scene;
class Sonars;

/// The robot of Fig. 1: a circle on two wheels that turns, then drives forward.
struct RobotDef {
  double radius = 0.1;
  double speed = 0.1;
  double sample_time = 0.5;
  std::optional<double> track;
  std::vector<double> steering_angles{-60.0, -30.0, 0.0, 30.0, 60.0};
  int sonar_count = 5;
  double sonar_fov = 180.0;
  double sonar_range = 2.0;
  double sonar_beam = 0.0;
  int sonar_rays = 5;
  double sonar_specular = 90.0;
  double sonar_least_range = 0.0;
  double sonar_blind_time = 0.0;
  std::optional<double> safety_margin;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using R = RobotDef;
    return described(
        "RobotDef", field("radius", &R::radius, "r", closed(0.01, 10.0, "m"), "radius of the body"),
        field("speed", &R::speed, "v", above(0.0, 10.0, "m/s"), "speed of the drive"),
        field("sample_time", &R::sample_time, "t_s", above(0.0, 10.0, "s"),
              "how long a step's drive lasts, and its turn by Eq. 2; v t_s is at most 1 m"),
        field("track", &R::track, "", or_none(above(0.0, 10.0, "m")),
              "distance between the wheels in Eq. 2; none for the radius, as printed"),
        field("steering_angles", &R::steering_angles, "M",
              list(whole(1, 65535), closed(-360.0, 360.0, "degrees")),
              "the motions: by how much each turns, counter-clockwise"),
        field("sonar_count", &R::sonar_count, "", whole(0, 720), "number of sonars"),
        field("sonar_fov", &R::sonar_fov, "", closed(0.0, 360.0, "degrees"),
              "the sonars' field of view about the heading"),
        field("sonar_range", &R::sonar_range, "", closed(0.01, 100.0, "m"),
              "how far a sonar hears, from the body's rim"),
        later(field("sonar_beam", &R::sonar_beam, "", closed(0.0, 90.0, "degrees"),
                    "how wide a sonar's cone is; 0: a single ray")),
        later(field("sonar_rays", &R::sonar_rays, "", whole(2, 181),
                    "how many rays make a cone, evenly over it; the nearest echo is heard")),
        later(field("sonar_specular", &R::sonar_specular, "", above(0.0, 90.0, "degrees"),
                    "greatest angle between a ray and a surface's normal at which there is an "
                    "echo; beyond, the sound is thrown elsewhere")),
        later(field("sonar_least_range", &R::sonar_least_range, "", closed(0.0, 100.0, "m"),
                    "nearer echoes are told as this far")),
        later(field("sonar_blind_time", &R::sonar_blind_time, "", closed(0.0, 1.0, "s"),
                    "how long after its ping a sonar is deaf, in air: echoes from nearer than "
                    "171.5 m/s times it are not heard")),
        field(
            "safety_margin", &R::safety_margin, "", or_none(above(0.0, 10.0, "m")),
            "what a safety layer keeps between body and obstacles: motions that would lead nearer "
            "are not allowed; none for no such layer"));
  }

  /// Throws InvalidValue unless every field lies in its range, a step is at most 1 m, and sonars
  /// hear further than sonar_least_range.
  void validate() const;
  /// The robot in a JSON file, an object of these fields (robot.schema.json); those left out keep
  /// their defaults. Throws FileError, naming file and field.
  static RobotDef load(const std::string& path);
  /// Where each sonar looks, relative to the heading [degrees]: evenly over the field of view from
  /// right to left (at 360 degrees without doubling the rear).
  std::vector<double> sonar_angles() const;
};

bool operator==(const RobotDef& a, const RobotDef& b) noexcept;
inline bool operator!=(const RobotDef& a, const RobotDef& b) noexcept { return !(a == b); }

/// Rim speeds of the left and right wheel [m/s].
struct WheelSpeeds {
  double left = 0.0;   ///< [m/s]
  double right = 0.0;  ///< [m/s]
};

/// Where constant wheel speeds lead in a sample time.
struct Arc {
  double turn = 0.0;         ///< from one end to the other, counter-clockwise [degrees]
  double chord_speed = 0.0;  ///< of who drives straight between the ends; below 0: backwards [m/s]
};

/// The robot's body in a world: how it moves and what its sonars hear. Const throughout: a step is
/// a pure function of (world, time, pose, motion). Any number of threads may ask one robot, or
/// several, at once. Times are the world's [s]: they say where its movers are, and are looked at
/// only where there are some.
class Robot {
 public:
  /// Throws InvalidValue.
  Robot(const World& world, const RobotDef& def);
  ~Robot();
  ///@{
  /// It moves, and is not copied.
  Robot(Robot&&) noexcept;
  Robot& operator=(Robot&&) noexcept;
  ///@}

  /// Where a step led.
  struct Move {
    Pose pose;              ///< after it
    bool collided = false;  ///< whether the body touched something
  };

  /// Eq. 1: turns by steering_angles[motion], then drives for one sample time. Where the swept
  /// body keeps clear of everything, that is Eq. 1 exactly; otherwise Box2D resolves the drive
  /// from this pose. The heading always ends as commanded. Throws InvalidValue for a motion
  /// outside M, a pose that require_place refuses, or a time outside [0, 1e9] s.
  ///
  /// While it drives, movers go straight from where they are to where they are a sample time later,
  /// and push it. One that pins it against what stands still goes on over it: then the body stays
  /// where it is, or drives as among what stands still where that leads no deeper into movers.
  Move step(const Pose& pose, int motion, double time = 0.0) const;

  /// The same for any turn, in degrees, and any speed of the drive from 0 m/s on, at
  /// most 1 m a step: what becomes of a motion that is not made exactly. Throws InvalidValue.
  Move drive(const Pose& pose, double turn, double speed, double time = 0.0) const;

  /// One sample time at constant wheel speeds, forwards or backwards. What they ask for is an arc;
  /// as in Eq. 1 the body turns first and drives straight then: along the arc's chord, half of the
  /// turn off, by the rules of step(). It always ends with the arc's heading and, where nothing is
  /// in the way, at the arc's end; on its way it is off the arc by about |turn| / 8 of its length
  /// at most, in radians. Throws InvalidValue as arc() and step() do.
  Move drive_wheels(const Pose& pose, const WheelSpeeds& speeds, double time = 0.0) const {
    return follow(pose, arc(speeds), time);
  }
  /// The same of an arc, whose chord is at most 1 m.
  Move follow(const Pose& pose, const Arc& arc, double time = 0.0) const;

  /// Which motions the robot can make from a pose, as its safety layer sees it: those that keep its
  /// body further than safety_margin from obstacles, walls and movers all along the way of Eq. 1.
  /// Where none does, or there is no such layer, every one. `allowed` has room for a bool a motion;
  /// whether any is false. Throws InvalidValue for a pose that is not finite.
  bool allowed(const Pose& pose, bool* allowed, double time = 0.0) const;

  /// Echo distances from the body's rim [m], one for each sonar from right to left, by raycast:
  /// sonar_range where nothing is heard, 0 (or sonar_least_range) where something touches the rim.
  /// `echoes` has room for sonar_count values.
  void sonar(const Pose& pose, double* echoes, double time = 0.0) const;
  /// The same, each sonar looking aside by some degrees.
  void sonar(const Pose& pose, const double* aside, double* echoes, double time = 0.0) const;
  /// As a vector.
  std::vector<double> sonar(const Pose& pose, double time = 0.0) const;

  /// Eq. 2: wheel speeds of the turn, held for one sample time.
  WheelSpeeds turn_speeds(int motion) const;
  /// Likewise of the drive.
  WheelSpeeds drive_speeds() const noexcept;
  /// Eq. 2 the other way round, and for any speeds: dtheta = (v_r - v_l) t_s / track, on an arc as
  /// long as their mean leads, at most 1 m. Throws InvalidValue.
  Arc arc(const WheelSpeeds& speeds) const;

  /// Throws InvalidValue unless the body fits at the pose: inside the arena and, but for Box2D's
  /// slop of 0.005 m, in touch with nothing that stands still. Where movers pinned it, it is in
  /// touch with these. `what` names the pose in the message.
  void require_place(const Pose& pose, const char* what = "pose") const;
  /// The same, and in touch with no mover: where it may be put at a time.
  void require_free(const Pose& pose, double time, const char* what = "pose") const;
  /// Throws InvalidValue unless that holds at the world's start at any time.
  void require_start() const;

  const RobotDef& def() const noexcept { return def_; }    ///< as given
  const World& world() const noexcept { return *world_; }  ///< as given

 private:
  Move move(const Pose& pose, double turn, double speed, double time) const;
  bool movers_keep_clear(const Pose& from, const Pose& to, double room, double time) const;
  bool stands(const Pose& pose, double depth) const noexcept;
  Move among_standing(const Scene& scene, const Pose& pose, const Pose& straight) const;
  Move among_moving(const Scene& scene, const Pose& pose, const Pose& straight,
                    double end_time) const;
  bool went_between(const Drive& drive, const Scene& scene, const Pose& pose) const;

  std::shared_ptr<const World> world_;
  RobotDef def_;
  std::unique_ptr<Sonars> sonars_;
};

}  // namespace devlearn
