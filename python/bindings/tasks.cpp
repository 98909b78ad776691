#include "tasks.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "agents.hpp"
#include "progress.hpp"

namespace devlearn::python {
namespace {

struct EpisodesTag {
  using type = std::int64_t;
  static constexpr const char* quantity = "episodes";
  static constexpr const char* allowed = "a whole number in [0, 2^63 - 1]";
};
struct FirstTag {
  using type = std::int64_t;
  static constexpr const char* quantity = "first";
  static constexpr const char* allowed = "a whole number in [0, 2^63 - 1]";
};
struct StepLimitTag {
  using type = std::int64_t;
  static constexpr const char* quantity = "step_limit";
  static constexpr const char* allowed = "a whole number in [1, 2^63 - 1]";
};

py::array array_of_episodes(const std::vector<Episode>& episodes) {
  return py::array_t<Episode>(static_cast<py::ssize_t>(episodes.size()), episodes.data());
}

py::array run(const py::object& self, const py::object& given, Whole<EpisodesTag> count,
              Whole<SeedTag> seed, Whole<FirstTag> first, Whole<StepLimitTag> step_limit,
              const std::optional<EventObject>& stop, const std::optional<Told>& progress) {
  auto& task = self.cast<Task&>();
  const std::shared_ptr<Agent> agent = as_agent(given);
  const InHand in_hand(task, *agent);
  self.attr("interrupted") = py::none();
  std::vector<Episode> episodes;
  Progress told(progress, stop, count.value);
  Watch watch(
      [&] { return told.looks([&] { return static_cast<std::int64_t>(episodes.size()); }); });
  try {
    {
      const NoGil no_gil;
      run_episodes(task, *agent,
                   {count.value, seed.value, first.value, step_limit.value, std::ref(watch)},
                   episodes);
    }
    watch.rethrow();
    told.end();
  } catch (const std::exception&) {
    self.attr("interrupted") = array_of_episodes(episodes);
    throw;
  }
  return array_of_episodes(episodes);
}

}  // namespace

void bind_tasks(py::module_& m) {
  PYBIND11_NUMPY_DTYPE(Episode, reward, steps, ended, succeeded);
  py::class_<Task, std::shared_ptr<Task>> cls(
      m, "Task",
      "An environment that is no world of the robot's: what all in devlearn.tasks have. An "
      "episode\n"
      "is begun, then observed and stepped until an outcome has arrived, or for as long as one\n"
      "likes. Not while another thread's run has it in hand.",
      py::dynamic_attr());
  cls.attr("interrupted") = py::none();
  cls.def_property_readonly("motion_count", &Task::motion_count,
                            "M: motions are 0 ... motion_count - 1.")
      .def_property_readonly("situation_count", &Task::situation_count,
                             "Situations are 0 ... situation_count - 1.")
      .def(
          "begin", [](Task& self, Whole<SeedTag> seed) { idle(self, "Task").begin(seed.value); },
          py::arg("seed") = 0,
          "An episode begins, whatever was before. All that is by chance in it follows from seed, "
          "in [0, 2**64 - 1]. Raises InvalidValue.")
      .def(
          "observation",
          [](Task& self) { return KeptObservation(idle(self, "Task").observation()); },
          "What is observed now. Raises InvalidValue where no episode is under way.")
      .def(
          "step",
          [](Task& self, Whole<MotionTag> motion) { return idle(self, "Task").step(motion.value); },
          py::arg("motion"),
          "Executes a motion. Where the episode has ended, well or not, the outcome has arrived. "
          "Raises InvalidValue for a motion that is none, and where no episode is under way.")
      .def_property_readonly(
          "succeeded", [](Task& self) { return idle(self, "Task").succeeded(); },
          "Whether the episode that has ended ended well.");
  m.def(
      "run_episodes", &run, py::arg("task"), py::arg("agent"), py::arg("episodes"), py::kw_only(),
      py::arg("seed") = 0, py::arg("first") = 0, py::arg("step_limit") = 10'000,
      py::arg("stop") = py::none(), py::arg("progress") = py::none(),
      "An agent lives through episodes of a task, each a round, and goes on learning.\n\n"
      "Episode i begins with a seed drawn from seed and i: runs in pieces equal one in one call,\n"
      "and devlearn.envs.LearnerOn on the task as an environment.\n\n"
      "Parameters: task, one of devlearn.tasks; agent, as of a Trial, shared and not copied;\n"
      "episodes, how many, >= 0; seed of the task, in [0, 2**64 - 1]; first, the first one's\n"
      "number, >= 0; step_limit, steps after which an episode is cut off, >= 1; stop, a\n"
      "threading.Event or what has its is_set(), ends the run; progress, called as\n"
      "progress(done, total), ten times a second at most and at the end.\n\n"
      "Returns an array with the fields reward (the sum of all steps'), steps, ended (by the\n"
      "task, not by the limit) and succeeded, an entry an episode. Raises InvalidValue, and what\n"
      "the agent raises. An episode that is broken off, also by Ctrl-C, is not counted: what was\n"
      "finished is in task.interrupted, and a run with first begins with it anew.");
}

}  // namespace devlearn::python
