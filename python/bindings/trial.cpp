#include "devlearn/trial.hpp"

#include <chrono>
#include <memory>
#include <optional>

#include "agents.hpp"
#include "bindings.hpp"
#include "config.hpp"
#include "loop/config_file.hpp"
#include "record_object.hpp"

namespace devlearn::python {
namespace {

struct StepsTag {
  using type = std::int64_t;
  static constexpr const char* quantity = "steps";
  static constexpr const char* allowed = "a whole number in [0, 2^40]";
};
struct RoundsTag {
  using type = std::int64_t;
  static constexpr const char* quantity = "rounds";
  static constexpr const char* allowed = "a whole number in [0, 2^30]";
};
struct StepLimitTag {
  using type = std::int64_t;
  static constexpr const char* quantity = "step_limit";
  static constexpr const char* allowed = "a whole number in [1, 2^40]";
};

RecordObject as_record(const Trial& trial, Record&& record) {
  return RecordObject(py::module_::import("devlearn.record")
                          .attr("Record")
                          .attr("_of_trial")(columns(std::move(record)), trial.world(),
                                             trial.config(), trial.seed(), agent_of(trial)));
}

/// Runs `phase(trial, record, options)` without the GIL. Ctrl-C is looked for every 20 ms, between
/// two steps; then, and where an agent raises, what is finished stays in `trial.interrupted`.
template <typename Phase>
RecordObject run_phase(py::object& self, bool echoes, bool rounds_only, const Phase& phase) {
  auto& trial = self.cast<Trial&>();
  using Clock = std::chrono::steady_clock;
  constexpr auto kBetweenLooks = std::chrono::milliseconds(20);
  Clock::time_point looked = Clock::now();
  bool stopped = false;
  const RunOptions options{echoes,
                           [&] {
                             if (Clock::now() - looked < kBetweenLooks) return false;
                             const py::gil_scoped_acquire gil;
                             stopped = PyErr_CheckSignals() != 0;
                             looked = Clock::now();
                             return stopped;
                           },
                           rounds_only};
  Record record;
  try {
    const InRun in_run(trial.learner());
    const Turn turn;
    phase(trial, record, options);
  } catch (...) {
    if (!record.rounds.empty()) self.attr("interrupted") = as_record(trial, std::move(record));
    throw;
  }
  if (stopped) {
    const py::error_already_set interrupt;
    self.attr("interrupted") = as_record(trial, std::move(record));
    throw interrupt;
  }
  return as_record(trial, std::move(record));
}

void bind_config(py::module_& m) {
  def_config<TrialConfig>(
      m, "Everything a trial needs besides the world and the seed; the defaults are the paper's.")
      .def_static("paper", &TrialConfig::paper, "The default, with LearnerConfig.paper().")
      .def_static("step5", &TrialConfig::step5, "The other reading, with LearnerConfig.step5().");
  m.def(
      "load_config", [](const py::object& path) { return load_config(file_path(path)); },
      py::arg("path"),
      "A TrialConfig from a JSON file, an object of its fields; those left out keep their "
      "defaults. Raises FileError.");
}

}  // namespace

void bind_trial(py::module_& m) {
  bind_config(m);

  py::class_<Trial> cls(
      m, "Trial", py::dynamic_attr(),
      "The closed loop: world -> sense -> situation -> choice -> motion -> evaluation ->\n"
      "development -> record.\n\n"
      "Parameters: world; config, a TrialConfig (None: the paper's); seed of the learner's draws;\n"
      "agent: None for a new paper's learner, a Learner (shared, not copied), a RandomAgent, or "
      "any\n"
      "object with choose(observation) -> motion index or Choice, and observe(outcome). If it has\n"
      "them, these are called, too: begin_round(), before the first choice of a round;\n"
      "end_round(arrived), True where path learning arrives, False where the next round begins;\n"
      "cancel(), where its motion was refused. With state() -> dict of arrays and a classmethod\n"
      "from_state(dict) it is saved with the trial. Raises InvalidValue.\n\n"
      "A phase that Ctrl-C or an agent's exception ends leaves what it finished in `interrupted`.");
  cls.attr("interrupted") = py::none();
  cls.def(py::init([](const World& world, const std::optional<TrialConfig>& given,
                      Whole<SeedTag> seed, const py::object& agent) {
            const TrialConfig config = given.value_or(TrialConfig{});
            if (agent.is_none()) return std::make_unique<Trial>(world, config, seed.value);
            return std::make_unique<Trial>(world, config, seed.value, as_agent(agent));
          }),
          py::arg("world"), py::arg("config") = py::none(), py::arg("seed") = 0,
          py::arg("agent") = py::none())
      .def(
          "step",
          [](Trial& self) {
            const InRun in_run(self.learner());
            const Turn turn;
            return self.step();
          },
          "One step: once around the loop.")
      .def(
          "run",
          [](py::object& self, Whole<StepsTag> steps, bool echoes, bool rounds_only) {
            return run_phase(self, echoes, rounds_only,
                             [&](Trial& trial, Record& record, const RunOptions& run) {
                               trial.run(record, steps.value, run);
                             });
          },
          py::arg("steps"), py::kw_only(), py::arg("echoes") = false,
          py::arg("rounds_only") = false,
          "`steps` steps from where the robot is, in the present round. `echoes` records the "
          "sonars, too. With `rounds_only` the record holds `rounds` and no steps or poses, and "
          "memory does not grow with steps; not together with echoes.")
      .def(
          "free_learning",
          [](py::object& self, Whole<StepsTag> steps, bool echoes, bool rounds_only) {
            return run_phase(self, echoes, rounds_only,
                             [&](Trial& trial, Record& record, const RunOptions& run) {
                               trial.free_learning(record, steps.value, run);
                             });
          },
          py::arg("steps"), py::kw_only(), py::arg("echoes") = false,
          py::arg("rounds_only") = false,
          "A new round of `steps` steps from the start pose; reaching the target ends nothing.")
      .def(
          "path_learning",
          [](py::object& self, Whole<RoundsTag> rounds, Whole<StepLimitTag> step_limit, bool echoes,
             bool rounds_only) {
            return run_phase(self, echoes, rounds_only,
                             [&](Trial& trial, Record& record, const RunOptions& run) {
                               trial.path_learning(record, rounds.value, step_limit.value, run);
                             });
          },
          py::arg("rounds"), py::arg("step_limit") = 10000, py::kw_only(),
          py::arg("echoes") = false, py::arg("rounds_only") = false,
          "`rounds` new rounds from the start pose, each until the target is reached, or failed "
          "(arrived False) after `step_limit` steps.")
      .def(
          "finish_round",
          [](py::object& self, Whole<StepsTag> steps, bool echoes, bool rounds_only) {
            return run_phase(self, echoes, rounds_only,
                             [&](Trial& trial, Record& record, const RunOptions& run) {
                               trial.finish_round(record, steps.value, run);
                             });
          },
          py::arg("steps"), py::kw_only(), py::arg("echoes") = false,
          py::arg("rounds_only") = false,
          "Goes on with the present round until the target is reached, for at most `steps` steps: "
          "what finishes a round of path learning that was interrupted.")
      .def("begin_round", &Trial::begin_round, py::call_guard<Turn>(),
           "Puts the robot at the start pose for a new round.")
      .def(
          "place",
          [](Trial& self, double x, double y, double heading) {
            self.place({x, y, heading});
          },
          py::arg("x"), py::arg("y"), py::arg("heading"), py::call_guard<Turn>(),
          "Puts the robot anywhere it fits [m, m, degrees] for a new round. Raises InvalidValue.")
      .def_property_readonly("pose", &Trial::pose, "Where the robot is [m, m, degrees].")
      .def_property_readonly("round", &Trial::round,
                             "The present round, from 1; 0 before the first.")
      .def_property_readonly("round_open", &Trial::round_open,
                             "Whether the agent is in a round: told that it began, and not yet "
                             "that it ended.")
      .def_property_readonly("arrived", &Trial::arrived, "Whether d_g <= goal_radius.")
      .def_property_readonly("learner", &Trial::learner,
                             "The paper's learner, where that is the agent; None otherwise.")
      .def_property_readonly("agent", &agent_of, "Whoever chooses.")
      .def_property_readonly("world", &Trial::world, py::return_value_policy::copy, "The World.")
      .def_property_readonly("robot", &Trial::robot, py::return_value_policy::reference_internal,
                             "The Robot.")
      .def_property_readonly("grid", &Trial::grid, py::return_value_policy::copy,
                             "The SituationGrid over the arena.")
      .def_property_readonly("config", &Trial::config, py::return_value_policy::copy,
                             "The TrialConfig.")
      .def_property_readonly("seed", &Trial::seed, "The seed it began with.");
}

}  // namespace devlearn::python
