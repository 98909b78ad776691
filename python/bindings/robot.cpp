#include "devlearn/robot.hpp"

#include <cstdint>
#include <functional>
#include <optional>

#include "config.hpp"
#include "devlearn/detail/require.hpp"
#include "devlearn/shortest_path.hpp"

namespace devlearn::python {
namespace {

std::optional<std::int64_t> count_or_none(std::int64_t steps) {
  if (steps == ShortestPath::kNoWay) return std::nullopt;
  return steps;
}

}  // namespace

void bind_robot(py::module_& m) {
  def_config<RobotDef>(
      m, "The robot of Fig. 1: a circle on two wheels that turns, then drives forward.")
      .def_static(
          "load", [](const py::object& path) { return RobotDef::load(file_path(path)); },
          py::arg("path"),
          "The robot in a JSON file, an object of these fields (robot.schema.json); those left out "
          "keep their defaults. Raises FileError.")
      .def("sonar_angles", &RobotDef::sonar_angles,
           "Where each sonar looks, relative to the heading, from right to left [degrees].");

  py::class_<Robot> robot(
      m, "Robot",
      "The robot's body in a world: how it moves and what its sonars hear. A step is a "
      "pure function of (world, time, pose, motion). Times are the world's [s]: they say where its "
      "movers are.");
  robot
      .def(py::init([](const World& world, const std::optional<RobotDef>& def) {
             return Robot(world, def.value_or(RobotDef{}));
           }),
           py::arg("world"), py::arg("robot") = py::none())
      .def(
          "step",
          [](const Robot& self, const Pose& pose, Whole<MotionTag> motion, double time) {
            require_finite("time", time);
            const Robot::Move step = [&] {
              const NoGil no_gil;
              return self.step(pose, motion.value, time);
            }();
            return std::make_pair(step.pose, step.collided);
          },
          py::arg("pose"), py::arg("motion"), py::arg("time") = 0.0,
          "(next pose, collided): Eq. 1 exactly where the way is free, Box2D where there is "
          "something to touch, or that pushes. Raises InvalidValue.")
      .def(
          "drive",
          [](const Robot& self, const Pose& pose, double turn, double speed, double time) {
            require_finite("time", time);
            const Robot::Move move = [&] {
              const NoGil no_gil;
              return self.drive(pose, turn, speed, time);
            }();
            return std::make_pair(move.pose, move.collided);
          },
          py::arg("pose"), py::arg("turn"), py::arg("speed"), py::arg("time") = 0.0,
          "The same for any turn [degrees] and any speed of the drive from 0 m/s on, at most 1 m a "
          "step: what becomes of a motion that is not made exactly. Raises InvalidValue.")
      .def(
          "drive_wheels",
          [](const Robot& self, const Pose& pose, double left, double right, double time) {
            require_finite("time", time);
            const Robot::Move move = [&] {
              const NoGil no_gil;
              return self.drive_wheels(pose, {left, right}, time);
            }();
            return std::make_pair(move.pose, move.collided);
          },
          py::arg("pose"), py::arg("left"), py::arg("right"), py::arg("time") = 0.0,
          "The same at constant wheel speeds [m/s], forwards or backwards, their mean at most 1 m "
          "a "
          "step. What they ask for is an arc, of which the turn is (right - left) sample_time / "
          "track; the body turns by half of that and drives straight along the arc's chord. It "
          "always ends with the arc's heading and, where nothing is in the way, at the arc's end. "
          "Raises InvalidValue.")
      .def(
          "allowed",
          [](const Robot& self, const Pose& pose, double time) {
            require_finite("time", time);
            py::array_t<bool> allowed(static_cast<py::ssize_t>(self.def().steering_angles.size()));
            self.allowed(pose, allowed.mutable_data(), time);
            return allowed;
          },
          py::arg("pose"), py::arg("time") = 0.0,
          "Which motions the robot can make from a pose, as its safety layer sees it: those that "
          "keep its body further than safety_margin from obstacles, walls and movers all along the "
          "way of "
          "Eq. 1. Where none does, or there is no such layer, every one. A bool array. Raises "
          "InvalidValue for a pose that is not finite.")
      .def(
          "sonar",
          [](const Robot& self, const Pose& pose, double time) {
            require_finite("time", time);
            std::vector<double> echoes = [&] {
              const NoGil no_gil;
              return self.sonar(pose, time);
            }();
            return moved_array<double>(std::move(echoes));
          },
          py::arg("pose"), py::arg("time") = 0.0,
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
                             "Its RobotDef.")
      .def_property_readonly("world", &Robot::world, py::return_value_policy::copy, "Its World.")
      .def(
          "__repr__",
          [](const py::object& self) {
            return py::str("Robot({!r}, {!r})").format(self.attr("world"), self.attr("definition"));
          })
      .def(
          "__deepcopy__", [](const py::object& self, const py::dict&) { return self; },
          py::arg("memo"));
  def_pickling(robot, {"world", "definition"});

  py::class_<ShortestPath> path(
      m, "ShortestPath",
      "The shortest way that the robot's own motions allow, or what is known of it: what "
      "shortest_path returns.");
  path.def_property_readonly(
          "poses",
          [](const ShortestPath& self) {
            std::vector<double> values;
            for (const Pose& pose : self.poses) {
              values.insert(values.end(), {pose.x, pose.y, pose.heading});
            }
            return moved_array<double>(std::move(values),
                                       {static_cast<py::ssize_t>(self.poses.size()), 3});
          },
          "(steps + 1, 3) [m, m, degrees], from the start to the first within goal_radius; empty "
          "where no way was found.")
      .def_property_readonly(
          "steps", [](const ShortestPath& self) { return count_or_none(self.steps()); },
          "Steps of the way; None where none was found.")
      .def_property_readonly(
          "lower_bound", [](const ShortestPath& self) { return count_or_none(self.lower_bound); },
          "No way has fewer steps; None where there is no way at all.")
      .def_property_readonly("exact", &ShortestPath::exact,
                             "Whether `steps` is the least, or there is no way; False where the "
                             "search gave up before it knew.")
      .def("__repr__", [](const py::object& self) {
        return py::str("<devlearn.ShortestPath: steps {}, lower_bound {}, exact {}>")
            .format(self.attr("steps"), self.attr("lower_bound"), self.attr("exact"));
      });

  m.def(
      "shortest_path",
      [](const Robot& robot, const std::optional<Pose>& start, double goal_radius) {
        const Pose from = start.value_or(robot.world().def().start);
        Watch watch;
        ShortestPath path;
        {
          const NoGil no_gil;
          path = shortest_path(robot, from, goal_radius, std::ref(watch));
        }
        watch.rethrow();
        return path;
      },
      py::arg("robot"), py::arg("start") = py::none(), py::arg("goal_radius") = 0.1,
      "The shortest way, in steps, that the robot's own motions allow from `start` (None: the\n"
      "world's) to within goal_radius [m] of the target, touching nothing that stands still: a\n"
      "ShortestPath. Of movers it knows nothing. What a\n"
      "learnt path is measured against.\n\n"
      "Found by A* over poses, those in one cell of a quarter step counting as one. Where the\n"
      "flooding of a grid shows that there is no way, that is known at once. In large arenas A* "
      "may\n"
      "give up, after 4 million poses: then the way is one that may be longer than the shortest, "
      "and\n"
      "`lower_bound` says by how much at most. Takes seconds at most, and hears Ctrl-C. Raises\n"
      "InvalidValue.");
  m.def(
      "may_reach_target",
      [](const Robot& robot, const std::optional<Pose>& start, double goal_radius) {
        const Pose from = start.value_or(robot.world().def().start);
        const NoGil no_gil;
        return may_reach_target(robot, from, goal_radius);
      },
      py::arg("robot"), py::arg("start") = py::none(), py::arg("goal_radius") = 0.1,
      "Whether the robot's body may get from `start` (None: the world's) to within goal_radius "
      "[m]\n"
      "of the target: much faster than shortest_path. False is certain; True up to cells of half "
      "a\n"
      "step or a 2048th of the arena, and to what the robot's motions allow. Raises InvalidValue.");
}

}  // namespace devlearn::python
