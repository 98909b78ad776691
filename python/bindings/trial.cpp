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
/// An agent written in Python.
class PythonAgent final : public Agent {
 public:
  explicit PythonAgent(py::object agent) : agent_(std::move(agent)) {
    for (const char* method : {"choose", "observe"}) {
      if (!py::hasattr(agent_, method)) {
        throw InvalidValue("agent", py::repr(agent_),
                           "None, a Learner, or an object with choose(observation) and "
                           "observe(outcome)");
      }
    }
  }

  Choice choose(const Observation& observation) override {
    const py::gil_scoped_acquire gil;
    const py::object chosen = agent_.attr("choose")(observation);
    py::detail::make_caster<Choice> choice;
    if (choice.load(chosen, true)) return choice;
    if (!PyIndex_Check(chosen.ptr())) {
      throw InvalidValue("agent's choice", py::repr(chosen), "a motion index or a Choice");
    }
    return {chosen.cast<Whole<MotionTag>>().value, Kind::kUnstated};
  }

  Development observe(const Outcome& outcome) override {
    const py::gil_scoped_acquire gil;
    const py::object result = agent_.attr("observe")(outcome);
    py::detail::make_caster<Development> development;
    return development.load(result, true) ? Development(development) : Development{};
  }

  void cancel() override {
    const py::gil_scoped_acquire gil;
    if (py::hasattr(agent_, "cancel")) agent_.attr("cancel")();
  }

  const py::object& object() const { return agent_; }

 private:
  py::object agent_;
};

}  // namespace

std::shared_ptr<Agent> as_agent(const py::object& agent) {
  if (py::isinstance<RandomAgent>(agent)) return agent.cast<std::shared_ptr<RandomAgent>>();
  if (py::isinstance<Learner>(agent) && !py::hasattr(agent, "observe")) {
    return std::make_shared<LearnerAgent>(agent.cast<std::shared_ptr<Learner>>());
  }
  return std::make_shared<PythonAgent>(agent);
}

py::object agent_of(const Trial& trial) {
  if (const auto* python = dynamic_cast<const PythonAgent*>(trial.agent().get())) {
    return python->object();
  }
  if (const auto learner = trial.learner()) return py::cast(learner);
  return py::cast(std::dynamic_pointer_cast<RandomAgent>(trial.agent()));
}

namespace {

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

void bind_messages(py::module_& m) {
  py::class_<Observation>(m, "Observation", "What an agent knows when it chooses.")
      .def_readonly("situation", &Observation::situation, "The present situation's id.")
      .def_readonly("pose", &Observation::pose, "[m, m, degrees]")
      .def_readonly("sef", &Observation::sef, "SEF here.")
      .def_readonly("goal_distance", &Observation::goal_distance, "d_g [m]")
      .def_readonly("clearance", &Observation::clearance, "d_o [m]")
      .def_readonly("motion_count", &Observation::motion_count,
                    "Choose one in 0 ... motion_count - 1.");
  py::class_<Outcome>(m, "Outcome", "What an agent is told about the motion it chose.")
      .def_readonly("situation", &Outcome::situation, "The next situation's id.")
      .def_readonly("sef", &Outcome::sef, "SEF there.")
      .def_readonly("smf", &Outcome::smf, "SMF as learned from: min(SMF, -1) for a collision.")
      .def_readonly("collided", &Outcome::collided, "Whether the body touched something.")
      .def_readonly("arrived", &Outcome::arrived, "d_g <= goal_radius.");

  py::class_<RandomAgent, std::shared_ptr<RandomAgent>>(
      m, "RandomAgent", "Uniformly random motions: what learning is measured against.")
      .def(py::init([](Whole<SeedTag> seed) { return std::make_shared<RandomAgent>(seed.value); }),
           py::arg("seed") = 0)
      .def(py::pickle(
          [](const RandomAgent& self) { return self.random().state(); },
          [](const Random::State& state) { return std::make_shared<RandomAgent>(Random(state)); }));
}

}  // namespace

void bind_trial(py::module_& m) {
  bind_config(m);
  bind_messages(m);

  py::class_<Trial> cls(
      m, "Trial", py::dynamic_attr(),
      "The closed loop: world -> sense -> situation -> choice -> motion -> evaluation ->\n"
      "development -> record.\n\n"
      "Parameters: world; config, a TrialConfig (None: the paper's); seed of the learner's draws;\n"
      "agent: None for a new paper's learner, a Learner (shared, not copied), or any object with\n"
      "choose(observation) -> motion index or Choice, observe(outcome) and, if it likes, "
      "cancel(),\n"
      "called where its motion was refused. Raises InvalidValue.\n\n"
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
          "One tick of the loop.")
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
          "`steps` ticks from where the robot is, in the present round. `echoes` records the "
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
          py::arg("x"), py::arg("y"), py::arg("heading"),
          "Puts the robot anywhere it fits [m, m, degrees] for a new round. Raises InvalidValue.")
      .def_property_readonly("pose", &Trial::pose, "Where the robot is [m, m, degrees].")
      .def_property_readonly("round", &Trial::round,
                             "The present round, from 1; 0 before the first.")
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
