#include "devlearn/trial.hpp"

#include <pybind11/typing.h>

#include <functional>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "agents.hpp"
#include "bindings.hpp"
#include "config.hpp"
#include "loop/config_file.hpp"
#include "parts.hpp"
#include "progress.hpp"
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

// (world, steps made when it was changed), the first first.
std::vector<std::pair<World, std::int64_t>> earlier_worlds_of(const Trial& trial) {
  std::vector<std::pair<World, std::int64_t>> worlds;
  for (const auto& [world, steps] : trial.earlier_worlds()) worlds.emplace_back(world, steps);
  return worlds;
}

RecordObject as_record(const Trial& trial, Record&& record, const py::object& learner) {
  return RecordObject(py::module_::import("devlearn.record")
                          .attr("Record")
                          .attr("_of_trial")(columns(std::move(record)), trial.world(),
                                             trial.config(), trial.seed(), agent_of(trial),
                                             names_of(trial.parts()), earlier_worlds_of(trial),
                                             learner));
}

// The snapshot of a trial's learner.
py::object learner_bytes(const py::object& self) {
  const py::object learner = self.attr("learner");
  if (learner.is_none()) {
    throw InvalidValue("learner", "True, and an agent that is none",
                       "False, or a Learner or AdaptiveLearner as the agent");
  }
  return learner.attr("to_bytes")();
}

/// How Python asks for a phase.
struct Asked {
  bool echoes, rounds_only, learner;
  Tally* tally;
  std::optional<EventObject> stop;
  std::optional<Told> progress;
};

// What of a phase is in its record: rounds where it consists of them, otherwise steps.
std::int64_t finished(const Record& record, bool of_rounds) {
  if (record.rounds.empty()) return 0;
  const Round& last = record.rounds.back();
  if (!of_rounds) return last.steps;
  return static_cast<std::int64_t>(record.rounds.size()) - (last.arrived ? 0 : 1);
}

/// Runs `phase(trial, record, options)` without the GIL, `total` rounds or steps. What was finished
/// when Ctrl-C or an exception ended it stays in `trial.interrupted`.
template <typename Phase>
RecordObject run_phase(py::object& self, std::int64_t total, bool of_rounds, const Asked& asked,
                       const Phase& phase) {
  auto& trial = self.cast<Trial&>();
  const py::object learner = asked.learner ? learner_bytes(self) : py::none();
  const InHand in_hand(trial, InHand::For::kRunning), tally_in_hand(asked.tally);
  Record record;
  Progress progress(asked.progress, asked.stop, total);
  Watch watch([&] { return progress.looks([&] { return finished(record, of_rounds); }); });
  try {
    {
      const NoGil no_gil;
      phase(trial, record,
            RunOptions{asked.echoes, std::ref(watch), asked.rounds_only, asked.tally});
    }
    watch.rethrow();
    progress.end();
  } catch (const std::exception&) {
    if (!record.rounds.empty())
      self.attr("interrupted") = as_record(trial, std::move(record), learner);
    throw;
  }
  return as_record(trial, std::move(record), learner);
}

/// Defines a phase of so many rounds or steps, the first of its counts.
template <typename... Counts, typename Phase, typename... Named>
void def_phase(py::class_<Trial>& cls, const char* name, Phase phase, bool of_rounds,
               const char* doc, const Named&... named) {
  cls.def(
      name,
      [phase, of_rounds](py::object& self, Counts... counts, bool echoes, bool rounds_only,
                         bool learner, std::optional<Tally*> tally, std::optional<EventObject> stop,
                         std::optional<Told> progress) {
        const std::int64_t all[] = {counts.value...};
        return run_phase(self, all[0], of_rounds,
                         {echoes, rounds_only, learner, tally.value_or(nullptr), std::move(stop),
                          std::move(progress)},
                         [&](Trial& trial, Record& record, const RunOptions& options) {
                           (trial.*phase)(record, counts.value..., options);
                         });
      },
      named..., py::kw_only(), py::arg("echoes") = false, py::arg("rounds_only") = false,
      py::arg("learner") = false, py::arg("tally") = py::none(), py::arg("stop") = py::none(),
      py::arg("progress") = py::none(), doc);
}

/// What Python reads of a trial that no other thread runs.
template <typename Value>
auto at_rest(Value (Trial::*read)() const noexcept) {
  return [read](const Trial& self) -> std::decay_t<Value> {
    require_free(&self, "Trial", InHand::For::kReading);
    return (self.*read)();
  };
}

void bind_config(py::module_& m) {
  def_config<NoiseDef>(
      m,
      "By how much chance spoils what a robot does and senses: standard deviations, and chances,\n"
      "of each step, drawn from the stream \"noise\" of the trial's seed. By default there is "
      "none.");
  def_config<TrialConfig>(
      m, "Everything a trial needs besides the world and the seed; the defaults are the paper's.")
      .def_static("paper", &TrialConfig::paper, "The default, with LearnerConfig.paper().")
      .def_static("step5", &TrialConfig::step5, "The other reading, with LearnerConfig.step5().")
      .def_static("adaptive", &TrialConfig::adaptive, "The adaptive learner, by its defaults.");
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
      "agent: None for a new learner as config says, a Learner or AdaptiveLearner (shared, not\n"
      "copied), a RandomAgent, one of devlearn.agents, or any object with choose(observation) ->\n"
      "motion index or Choice, and\n"
      "observe(outcome). If it has them, these are called, too: begin_round(), before the first\n"
      "choice of a round; end_round(arrived), True where path learning arrives, False where the\n"
      "next round begins; cancel(), where its motion was refused. With state() -> dict of arrays\n"
      "and a classmethod from_state(dict) it is saved with the trial.\n"
      "evaluation: a callable of Senses that gives SEF in place of Eq. 6, or an array of SEFs, one "
      "a\n"
      "situation of the grid; situations: a callable of Senses that gives ids in place of the "
      "grid's.\n"
      "Raises InvalidValue.\n\n"
      "A phase that Ctrl-C or an exception ends leaves what it finished in `interrupted`. Trials "
      "in\n"
      "several threads run at once. A trial that one thread runs, its learner, and its agent of\n"
      "devlearn's are refused to others meanwhile, and for good to a child forked then.");
  cls.attr("interrupted") = py::none();
  cls.def(py::init([](const World& world, const std::optional<TrialConfig>& given,
                      Whole<SeedTag> seed, const py::object& agent, const py::object& evaluation,
                      const py::object& situations) {
            const TrialConfig config = given.value_or(TrialConfig{});
            TrialParts parts = parts_from(evaluation, situations);
            if (agent.is_none()) {
              return std::make_unique<Trial>(world, config, seed.value, std::move(parts));
            }
            return std::make_unique<Trial>(world, config, seed.value, as_agent(agent),
                                           std::move(parts));
          }),
          py::arg("world"), py::arg("config") = py::none(), py::arg("seed") = 0,
          py::arg("agent") = py::none(), py::kw_only(), py::arg("evaluation") = py::none(),
          py::arg("situations") = py::none());
  cls.def("__repr__", [](const py::object& self) {
    return py::str("<devlearn.Trial: world {!r}, seed {}, round {}, at ({:.4g}, {:.4g}, {:.4g})>")
        .format(self.attr("world").attr("name"), self.attr("seed"), self.attr("round"),
                *self.attr("pose"));
  });
  def_phase<Whole<StepsTag>>(
      cls, "run", &Trial::run, false,
      "`steps` steps from where the robot is, in the present round.\n\n"
      "All phases take the same options. `echoes` records the sonars, too. With `rounds_only` the\n"
      "record holds `rounds` and no steps or poses, and memory does not grow with steps; not\n"
      "together with echoes. With `learner` the record carries the learner as the phase found it,\n"
      "for `devlearn view`. The steps are counted into `tally`, too, the finished ones also "
      "where\n"
      "the phase is not. `stop`, a threading.Event or what has its is_set(), ends the phase "
      "within\n"
      "50 ms of being set, from another thread too; what is finished is returned as ever.\n"
      "`progress` is called as progress(done, total) ten times a second at most, in steps (in\n"
      "rounds by path_learning), and once at the end; what it raises ends the phase as Ctrl-C "
      "does.",
      py::arg("steps"));
  def_phase<Whole<StepsTag>>(
      cls, "free_learning", &Trial::free_learning, false,
      "A new round of `steps` steps from the start pose; reaching the target ends nothing. Options "
      "as run.",
      py::arg("steps"));
  def_phase<Whole<RoundsTag>, Whole<StepLimitTag>>(
      cls, "path_learning", &Trial::path_learning, true,
      "`rounds` new rounds from the start pose, each until the target is reached, or failed "
      "(arrived False) after `step_limit` steps. Options as run.",
      py::arg("rounds"), py::arg("step_limit") = 10000);
  def_phase<Whole<StepsTag>>(
      cls, "finish_round", &Trial::finish_round, false,
      "Goes on with the present round until the target is reached, for at most `steps` steps: what "
      "finishes a round of path learning that was interrupted. Options as run.",
      py::arg("steps"));
  cls.def(
         "step",
         [](Trial& self) {
           const InHand in_hand(self, InHand::For::kRunning);
           const NoGil no_gil;
           return self.step();
         },
         "One step: once around the loop.")
      .def(
          "begin_round",
          [](Trial& self) {
            const InHand in_hand(self, InHand::For::kRunning);
            const NoGil no_gil;
            self.begin_round();
          },
          "Puts the robot at the start pose for a new round.")
      .def(
          "place",
          [](Trial& self, double x, double y, double heading) {
            const InHand in_hand(self, InHand::For::kRunning);
            const NoGil no_gil;
            self.place({x, y, heading});
          },
          py::arg("x"), py::arg("y"), py::arg("heading"),
          "Puts the robot anywhere it fits [m, m, degrees] for a new round. Raises InvalidValue.")
      .def(
          "change_world",
          [](Trial& self, const World& world) {
            const InHand in_hand(self, InHand::For::kRunning);
            const NoGil no_gil;
            self.change_world(world);
          },
          py::arg("world"),
          "Puts the robot at the start of another world, which has the same arena; robot, grid, "
          "agent\n"
          "and time stay. The present round ends, where the agent is in one. Records that follow "
          "tell of\n"
          "the earlier worlds in their provenance. Raises InvalidValue.")
      .def_property_readonly("pose", at_rest(&Trial::pose), "Where the robot is [m, m, degrees].")
      .def_property_readonly(
          "estimated_pose",
          [](const Trial& self) {
            require_free(&self, "Trial", InHand::For::kReading);
            return self.environment().state().place.estimate;
          },
          "Where its odometry says the robot is; without noise, where it is.")
      .def_property_readonly("time", at_rest(&Trial::time),
                             "The world's time: steps made so far, over all rounds, x sample_time "
                             "[s].")
      .def_property_readonly(
          "earlier_worlds",
          [](const Trial& self) {
            require_free(&self, "Trial", InHand::For::kReading);
            return earlier_worlds_of(self);
          },
          "What change_world changed: (World, steps made by then) of each, the first first.")
      .def_property_readonly("round", at_rest(&Trial::round),
                             "The present round, from 1; 0 before the first.")
      .def_property_readonly("round_open", at_rest(&Trial::round_open),
                             "Whether the agent is in a round: told that it began, and not yet "
                             "that it ended.")
      .def_property_readonly("arrived", at_rest(&Trial::arrived), "Whether d_g <= goal_radius.")
      .def_property_readonly(
          "learner",
          [](const Trial& self)
              -> std::variant<std::shared_ptr<Learner>, std::shared_ptr<AdaptiveLearner>> {
            if (const auto adaptive = self.adaptive_learner()) return adaptive;
            return self.learner();
          },
          "The Learner or AdaptiveLearner, where one is the agent; None otherwise.")
      .def_property_readonly("agent", &agent_of, "Whoever chooses.")
      .def_property_readonly("evaluation", &evaluation_of,
                             "The callable or array that stands in place of Eq. 6; None for Eq. 6.")
      .def_property_readonly("situations", &situations_of,
                             "The callable that stands in place of the grid's situations; None for "
                             "the grid's.")
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
