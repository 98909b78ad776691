#include "devlearn/robot.hpp"

#include <optional>

#include "config.hpp"
#include "devlearn/shortest_path.hpp"

namespace devlearn::python {

void bind_robot(py::module_& m) {
  def_config<RobotDef>(
      m, "The robot of Fig. 1: a circle on two wheels that turns, then drives forward.")
      .def("sonar_angles", &RobotDef::sonar_angles,
           "Where each sonar looks, relative to the heading, from right to left [degrees].");

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
              const NoGil no_gil;
              return self.step(pose, motion.value);
            }();
            return std::make_pair(step.pose, step.collided);
          },
          py::arg("pose"), py::arg("motion"),
          "(next pose, collided): Eq. 1 exactly where the way is free, Box2D where there is "
          "something to touch. Raises InvalidValue.")
      .def(
          "allowed",
          [](const Robot& self, const Pose& pose) {
            py::array_t<bool> allowed(static_cast<py::ssize_t>(self.def().steering_angles.size()));
            self.allowed(pose, allowed.mutable_data());
            return allowed;
          },
          py::arg("pose"),
          "Which motions the robot can make from a pose, as its safety layer sees it: those that "
          "keep its body further than safety_margin from obstacles and walls all along the way of "
          "Eq. 1. Where none does, or there is no such layer, every one. A bool array. Raises "
          "InvalidValue for a pose that is not finite.")
      .def(
          "sonar",
          [](const Robot& self, const Pose& pose) {
            std::vector<double> echoes = [&] {
              const NoGil no_gil;
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
