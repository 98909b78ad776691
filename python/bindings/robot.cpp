#include "devlearn/robot.hpp"

#include <optional>

#include "bindings.hpp"
#include "devlearn/detail/require.hpp"
#include "devlearn/shortest_path.hpp"

namespace devlearn::python {
namespace {

struct SonarCountTag {
  using type = int;
  static constexpr const char* quantity = "sonar_count";
  static constexpr const char* allowed = "a whole number in [0, 720]";
};

}  // namespace

void bind_robot(py::module_& m) {
  py::class_<RobotDef> cls(
      m, "RobotDef",
      "The robot of Fig. 1: a circle on two wheels that turns, then drives forward.\n\n"
      "Parameters: radius in [0.01, 10] m; speed in (0, 10] m/s; sample_time in (0, 10] s, at "
      "most\n"
      "1 m a step; track, the distance between the wheels in Eq. 2, in (0, 10] m or None for the\n"
      "radius, as printed; steering_angles M [degrees, counter-clockwise positive]; sonar_count "
      "in\n"
      "0 ... 720; sonar_fov in [0, 360] degrees about the heading; sonar_range in [0.01, 100] m.\n"
      "Raises InvalidValue.");
  cls.def(py::init([](double radius, double speed, double sample_time, std::optional<double> track,
                      std::vector<double> steering_angles, Whole<SonarCountTag> sonar_count,
                      double sonar_fov, double sonar_range) {
            if (track) require_above("track", *track, 0.0, 10.0, "m");
            RobotDef def{radius,
                         speed,
                         sample_time,
                         track.value_or(0.0),
                         std::move(steering_angles),
                         sonar_count.value,
                         sonar_fov,
                         sonar_range};
            def.validate();
            return def;
          }),
          py::arg("radius") = 0.1, py::arg("speed") = 0.1, py::arg("sample_time") = 0.5,
          py::arg("track") = py::none(),
          py::arg("steering_angles") = py::make_tuple(-60.0, -30.0, 0.0, 30.0, 60.0),
          py::arg("sonar_count") = 5, py::arg("sonar_fov") = 180.0, py::arg("sonar_range") = 2.0);
  cls.def_readonly("radius", &RobotDef::radius, "r [m]");
  cls.def_readonly("speed", &RobotDef::speed, "v [m/s]");
  cls.def_readonly("sample_time", &RobotDef::sample_time, "t_s [s]");
  cls.def_property_readonly(
      "track",
      [](const RobotDef& self) {
        return self.track == 0.0 ? std::nullopt : std::optional<double>(self.track);
      },
      "Distance between the wheels [m]; None for the radius.");
  cls.def_readonly("steering_angles", &RobotDef::steering_angles, "M [degrees]");
  cls.def_readonly("sonar_count", &RobotDef::sonar_count, "Number of sonars.");
  cls.def_readonly("sonar_fov", &RobotDef::sonar_fov, "Field of view [degrees].");
  cls.def_readonly("sonar_range", &RobotDef::sonar_range, "[m]");
  cls.def("sonar_angles", &RobotDef::sonar_angles,
          "Where each sonar looks, relative to the heading, from right to left [degrees].");
  def_fields(cls, {"radius", "speed", "sample_time", "track", "steering_angles", "sonar_count",
                   "sonar_fov", "sonar_range"});

  py::class_<Robot>(
      m, "Robot",
      "The robot's body in a world: how it moves and what its sonars hear. A step is a "
      "pure function of (world, pose, motion).")
      .def(py::init([](const World& world, const std::optional<RobotDef>& def) {
             return Robot(world, def.value_or(RobotDef{}));
           }),
           py::arg("world"), py::arg("robot") = py::none())
      .def(
          "step",
          [](const Robot& self, const Pose& pose, Whole<MotionTag> motion) {
            const Robot::Move step = [&] {
              const Turn turn;
              return self.step(pose, motion.value);
            }();
            return std::make_pair(step.pose, step.collided);
          },
          py::arg("pose"), py::arg("motion"),
          "(next pose, collided): Eq. 1 exactly where the way is free, Box2D where there is "
          "something to touch. Raises InvalidValue.")
      .def(
          "sonar",
          [](const Robot& self, const Pose& pose) {
            std::vector<double> echoes = [&] {
              const Turn turn;
              return self.sonar(pose);
            }();
            return moved_array<double>(std::move(echoes));
          },
          py::arg("pose"),
          "Echo distances from the body's rim, right to left [m]; sonar_range where nothing is "
          "heard. A float64 array of sonar_count values.")
      .def(
          "turn_speeds",
          [](const Robot& self, Whole<MotionTag> motion) {
            const WheelSpeeds speeds = self.turn_speeds(motion.value);
            return std::make_pair(speeds.left, speeds.right);
          },
          py::arg("motion"),
          "(left, right) wheel speeds of the turn, held for one sample time, Eq. 2 [m/s].")
      .def_property_readonly(
          "drive_speeds",
          [](const Robot& self) {
            const WheelSpeeds speeds = self.drive_speeds();
            return std::make_pair(speeds.left, speeds.right);
          },
          "(left, right) wheel speeds of the drive, held for one sample time [m/s].")
      .def_property_readonly("definition", &Robot::def, py::return_value_policy::copy,
                             "Its RobotDef.");

  m.def(
      "shortest_path",
      [](const Robot& robot, const std::optional<Pose>& start, double goal_radius) {
        const std::vector<Pose> way =
            shortest_path(robot, start.value_or(robot.world().def().start), goal_radius);
        std::vector<double> values;
        for (const Pose& pose : way) values.insert(values.end(), {pose.x, pose.y, pose.heading});
        return moved_array<double>(std::move(values), {static_cast<py::ssize_t>(way.size()), 3});
      },
      py::arg("robot"), py::arg("start") = py::none(), py::arg("goal_radius") = 0.1,
      "The shortest way, in steps, that the robot's own motions allow from `start` (None: the "
      "world's) to within goal_radius of the target, touching nothing: poses (steps + 1, 3) [m, m, "
      "degrees]; empty where there is no way. What a learnt path is measured against. Found by A* "
      "over poses, those in one cell of a quarter step counting as one. Raises InvalidValue.");
}

}  // namespace devlearn::python
