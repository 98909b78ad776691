#include "devlearn/batch.hpp"

#include <string>
#include <vector>

#include "bindings.hpp"
#include "config.hpp"

namespace devlearn::python {
namespace {

using Shape = std::vector<py::ssize_t>;

// A view of a column that nobody writes to; it keeps alive what it is a view of.
template <typename Scalar, typename T>
py::array view(const std::vector<T>& column, Shape shape, const py::object& owner) {
  static_assert(sizeof(Scalar) == sizeof(T));
  const py::array array(py::dtype::of<Scalar>(), std::move(shape), column.data(), owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

// What Python gives for each environment, as an array of T: of a kind of dtype that T can hold.
template <typename T>
py::array_t<T, py::array::c_style | py::array::forcecast> row_each(const char* quantity,
                                                                   const py::object& given,
                                                                   const std::string& kinds,
                                                                   const Shape& shape,
                                                                   const std::string& wanted) {
  const auto refuse = [&] { throw InvalidValue(quantity, shown(given), wanted); };
  const py::array array = py::array::ensure(given);
  if (!array) {
    PyErr_Clear();
    refuse();
  }
  if (kinds.find(array.dtype().kind()) == kinds.npos ||
      Shape(array.shape(), array.shape() + array.ndim()) != shape) {
    refuse();
  }
  return array;
}

std::string each_of(const Batch& batch, const std::string& what) {
  return std::to_string(batch.count()) + " " + what + ", one an environment";
}

template <typename Value>
auto column(Value Batch::Outcomes::*member) {
  using Stored = typename Value::value_type;
  using Scalar = std::conditional_t<std::is_same_v<Stored, std::uint8_t>, bool, Stored>;
  return [member](const py::object& self) {
    const auto& batch = self.cast<const Batch&>();
    return view<Scalar>(batch.outcomes().*member, {batch.count()}, self);
  };
}

// What is known where the robots are, of a batch that it keeps alive.
struct RowsOf {
  py::object batch;
  const Batch::Rows* rows;

  const Batch& owner() const { return batch.cast<const Batch&>(); }
};

void bind_rows(py::module_& m) {
  py::class_<RowsOf> rows(
      m, "BatchRows",
      "What is known where the robots of a Batch are, a row an environment: arrays that show what "
      "is the case now.");
  const auto def = [&](const char* name, auto member, const char* doc) {
    rows.def_property_readonly(
        name,
        [member](const RowsOf& self) {
          return view<typename std::decay_t<decltype(self.rows->*member)>::value_type>(
              self.rows->*member, {self.owner().count()}, self.batch);
        },
        doc);
  };
  rows.def_property_readonly(
      "pose",
      [](const RowsOf& self) {
        return view<double>(self.rows->pose, {self.owner().count(), 3}, self.batch);
      },
      "x, y, heading: (count, 3) [m, m, degrees].");
  def("situation", &Batch::Rows::situation, "The situation's id.");
  def("goal_distance", &Batch::Rows::goal_distance, "d_g [m]");
  def("clearance", &Batch::Rows::clearance, "d_o [m]");
  def("estimate", &Batch::Rows::estimate,
      "Cost to go at the least, in steps: d_g / (v t_s), 0 at the target.");
  rows.def_property_readonly(
          "echoes",
          [](const RowsOf& self) {
            const py::ssize_t count = self.owner().count();
            const auto values = static_cast<py::ssize_t>(self.rows->echoes.size());
            return view<double>(self.rows->echoes, {count, values / count}, self.batch);
          },
          "The sonars' echoes: (count, sonar_count) [m]; no column where they are not told.")
      .def_property_readonly(
          "allowed",
          [](const RowsOf& self) {
            const py::ssize_t count = self.owner().count();
            const auto values = static_cast<py::ssize_t>(self.rows->allowed.size());
            return view<bool>(self.rows->allowed, {count, values / count}, self.batch);
          },
          "Which motions the robot can make: (count, motion_count) bools.")
      .def("__repr__", [](const RowsOf& self) {
        return "<devlearn.BatchRows: " + std::to_string(self.owner().count()) + " environments>";
      });
}

}  // namespace

void bind_batch(py::module_& m) {
  def_config<BatchConfig>(m, "What episodes of a Batch are.");
  bind_rows(m);

  py::class_<Batch> batch(
      m, "Batch",
      "Several environments of one world and configuration, which one call steps, in C++ and\n"
      "without the GIL: a row each, in arrays that stay where they are and show what is the "
      "case.\n\n"
      "An episode begins at the world's start, or at a drawn pose. It is terminated where the\n"
      "robot arrives, and truncated after step_limit steps without that. What environment i does "
      "depends on its own\n"
      "seed and motions alone, so it is the same in a batch of any size.\n\n"
      "Parameters: world; count, in [1, 2^20]; config, a TrialConfig (None: the paper's); "
      "episodes,\n"
      "a BatchConfig; seed: environment i is seeded with seed + i. Raises InvalidValue.");
  batch.def(py::init([](const World& world, int count, const std::optional<TrialConfig>& config,
                        const std::optional<BatchConfig>& episodes, Whole<SeedTag> seed) {
              const NoGil no_gil;
              return Batch(world, count, config.value_or(TrialConfig{}),
                           episodes.value_or(BatchConfig{}), seed.value);
            }),
            py::arg("world"), py::arg("count") = 1, py::arg("config") = py::none(),
            py::arg("episodes") = py::none(), py::arg("seed") = 0);
  batch.def(
      "reset",
      [](Batch& self, const py::object& seeds, const py::object& which, const py::object& poses) {
        const InHand in_hand(self);
        const py::ssize_t n = self.count();
        std::vector<Pose> places;
        Batch::Reset asked;
        py::array_t<std::uint64_t, py::array::c_style | py::array::forcecast> seed_each;
        py::array_t<bool, py::array::c_style | py::array::forcecast> mask;
        if (!seeds.is_none()) {
          seed_each = row_each<std::uint64_t>(
              "seeds", seeds, "u", {n}, "None, or " + each_of(self, "numbers of dtype uint64"));
          asked.seeds = seed_each.data();
        }
        if (!which.is_none()) {
          mask = row_each<bool>("which", which, "b", {n}, "None, or " + each_of(self, "bools"));
          asked.which = mask.data();
        }
        if (!poses.is_none()) {
          const auto given = row_each<double>(
              "poses", poses, "iuf", {n, 3},
              "None, or x, y, heading [m, m, degrees] of " + each_of(self, "poses"));
          const double* const values = given.data();
          for (py::ssize_t i = 0; i < n; ++i) {
            places.push_back({values[3 * i], values[3 * i + 1], values[3 * i + 2]});
          }
          asked.poses = places.data();
        }
        const NoGil no_gil;
        self.reset(asked);
      },
      py::arg("seeds") = py::none(), py::arg("which") = py::none(), py::arg("poses") = py::none(),
      "Begins an episode in every environment, or in `which`, bools. seeds: one an environment, a\n"
      "uint64 array (None: what is drawn goes on); poses: where each begins, (count, 3) [m, m,\n"
      "degrees] (None: as episodes do). Raises InvalidValue; then nothing was reset.");
  batch
      .def(
          "step",
          [](Batch& self, const py::object& motions) {
            const InHand in_hand(self);
            const auto given = row_each<std::int64_t>("motions", motions, "iu", {self.count()},
                                                      each_of(self, "whole numbers"));
            const NoGil no_gil;
            self.step(given.data());
          },
          py::arg("motions"),
          "One step of every environment: motions[i], an index of M, in environment i. One that "
          "the robot's safety layer would not allow is made, too. Raises InvalidValue, also where "
          "autoreset is disabled and an episode has ended; then nothing was stepped.")
      .def(
          "drive_wheels",
          [](Batch& self, const py::object& speeds) {
            const InHand in_hand(self);
            const py::ssize_t n = self.count();
            const auto given =
                row_each<double>("wheel_speeds", speeds, "iuf", {n, 2},
                                 "left, right [m/s] of " + each_of(self, "pairs of wheel speeds"));
            std::vector<WheelSpeeds> pairs;
            const double* const values = given.data();
            for (py::ssize_t i = 0; i < n; ++i) pairs.push_back({values[2 * i], values[2 * i + 1]});
            const NoGil no_gil;
            self.drive_wheels(pairs.data());
          },
          py::arg("speeds"),
          "The same at constant wheel speeds, (count, 2): left, right [m/s], forwards or "
          "backwards, each at most RobotDef.speed, as Robot.drive_wheels makes them. "
          "`rows.allowed` "
          "is of motions alone.")
      .def("__len__", &Batch::count)
      .def("__repr__", [](const Batch& self) {
        return py::str("<devlearn.Batch: {} environments, world {!r}>")
            .format(self.count(), self.environment(0).world().def().name);
      });
  batch
      .def_property_readonly(
          "rows",
          [](const py::object& self) {
            return RowsOf{self, &self.cast<const Batch&>().rows()};
          },
          "Where the robots are, BatchRows.")
      .def_property_readonly(
          "final_rows",
          [](const py::object& self) {
            return RowsOf{self, &self.cast<const Batch&>().final_rows()};
          },
          "Where episodes ended that ended by the last step, if autoreset is same_step: the rows "
          "that are terminated or truncated.")
      .def_property_readonly("reward", column(&Batch::Outcomes::reward),
                             "What the last step was worth, as BatchConfig.reward says.")
      .def_property_readonly("smf", column(&Batch::Outcomes::smf),
                             "SMF of it as learned from: min(SMF, -1) for a collision.")
      .def_property_readonly("cost", column(&Batch::Outcomes::cost),
                             "What it cost: 1, and touch_cost more where it collided.")
      .def_property_readonly("collided", column(&Batch::Outcomes::collided),
                             "Whether the body touched something.")
      .def_property_readonly("terminated", column(&Batch::Outcomes::terminated),
                             "Whether the target was reached.")
      .def_property_readonly("truncated", column(&Batch::Outcomes::truncated),
                             "Whether the step limit was.")
      .def_property_readonly("begun", column(&Batch::Outcomes::begun),
                             "Whether the step only began an episode.")
      .def(
          "poses",
          [](const Batch& self) {
            std::vector<double> values;
            for (int i = 0; i < self.count(); ++i) {
              const Pose& pose = self.environment(i).pose();
              values.insert(values.end(), {pose.x, pose.y, pose.heading});
            }
            return moved_array<double>(std::move(values), {self.count(), 3});
          },
          "Where the robots truly are, whatever they sense of it: a copy, (count, 3) [m, m, "
          "degrees].")
      .def(
          "times",
          [](const Batch& self) {
            std::vector<double> values;
            for (int i = 0; i < self.count(); ++i) values.push_back(self.environment(i).time());
            return moved_array<double>(std::move(values), {self.count()});
          },
          "Their worlds' time, by which movers move: a copy, (count,) [s]. Episodes do not set it "
          "back, seeds do.")
      .def_property_readonly(
          "world", [](const Batch& self) { return self.environment(0).world(); }, "The World.")
      .def_property_readonly(
          "config", [](const Batch& self) { return self.environment(0).config(); },
          "The TrialConfig.")
      .def_property_readonly(
          "episodes", [](const Batch& self) { return self.config(); }, "The BatchConfig.")
      .def_property_readonly(
          "grid", [](const Batch& self) { return self.environment(0).grid(); },
          "The SituationGrid over the arena.");
}

}  // namespace devlearn::python
