#include "devlearn/learner.hpp"

#include <array>
#include <optional>
#include <tuple>

#include "bindings.hpp"
#include "config.hpp"
#include "snapshots.hpp"
#include "straight_method.hpp"

namespace PYBIND11_NAMESPACE {
namespace detail {
namespace {

// What is made when first needed, and then kept as long as the process lives.
template <typename Make>
handle kept(PyObject*& place, const Make& make) {
  if (place == nullptr) {
    object made = make();  // may let another thread in here, too
    if (place == nullptr) place = made.release().ptr();
  }
  return place;
}

handle choice_type() {
  static PyObject* type = nullptr;
  return kept(type, [] { return module_::import("devlearn._types").attr("Choice"); });
}

handle development_type() {
  static PyObject* type = nullptr;
  return kept(type, [] { return module_::import("devlearn._types").attr("Development"); });
}

handle member(devlearn::Event event) {
  static std::array<PyObject*, 5> members{};
  return kept(members[static_cast<std::size_t>(event)], [&] { return pybind11::cast(event); });
}

// A named tuple of these values: what its class's _make does.
template <typename... Values>
object named_tuple(handle type, Values... values) {
  const tuple arguments = pybind11::make_tuple(pybind11::make_tuple(values...));
  PyObject* made =
      PyTuple_Type.tp_new(reinterpret_cast<PyTypeObject*>(type.ptr()), arguments.ptr(), nullptr);
  if (made == nullptr) throw error_already_set();
  return reinterpret_steal<object>(made);
}

}  // namespace

bool type_caster<devlearn::python::Mask>::load(handle source, bool) {
  if (source.is_none()) return true;
  const auto array = array::ensure(source);
  PyErr_Clear();
  if (!array || array.ndim() != 1 || !isinstance<array_t<bool>>(array)) {
    throw devlearn::InvalidValue("allowed", devlearn::python::shown(source),
                                 "None, or bools, one a motion");
  }
  value = devlearn::python::Mask(array_t<bool, array::c_style>::ensure(array));
  return true;
}

bool type_caster<devlearn::Choice>::load(handle source, bool convert) {
  using Fields = std::tuple<devlearn::python::Whole<devlearn::python::MotionTag>, devlearn::Kind>;
  make_caster<Fields> fields;
  if (!isinstance(source, choice_type()) || !fields.load(source, convert)) return false;
  const auto [motion, kind] = cast_op<Fields>(fields);
  value = {motion.value, kind};
  return true;
}

handle type_caster<devlearn::Choice>::cast(const devlearn::Choice& choice, return_value_policy,
                                           handle) {
  const auto made = [&] { return named_tuple(choice_type(), choice.motion, choice.kind); };
  // They never change, and few differ: each is made once.
  static std::array<std::array<PyObject*, 7>, 256> shared{};
  const auto motion = static_cast<std::size_t>(choice.motion);
  if (motion >= shared.size()) return made().release();
  return kept(shared[motion][static_cast<std::size_t>(choice.kind)], made).inc_ref();
}

bool type_caster<devlearn::Development>::load(handle source, bool convert) {
  using Fields = std::tuple<devlearn::SituationId, int, devlearn::Event, int, std::int64_t,
                            std::int64_t, std::optional<double>>;
  make_caster<Fields> fields;
  if (!isinstance(source, development_type()) || !fields.load(source, convert)) return false;
  const auto [situation, motion, event, reduced, explored, effective, expected] =
      cast_op<Fields>(fields);
  value = {situation, motion, event, reduced, explored, effective, expected};
  return true;
}

handle type_caster<devlearn::Development>::cast(const devlearn::Development& development,
                                                return_value_policy, handle) {
  return named_tuple(development_type(), development.situation, development.motion,
                     member(development.event), development.reduced, development.explored_count,
                     development.effective_count, development.value)
      .release();
}

}  // namespace detail
}  // namespace PYBIND11_NAMESPACE

namespace devlearn::python {
namespace {

struct ReserveTag {
  using type = std::size_t;
  static constexpr const char* quantity = "situations";
  static constexpr const char* allowed = "a whole number in [0, 2^32 - 2]";
};

// A copy of an array's values, which must have this type and so many dimensions.
template <typename T>
std::vector<T> array_values(const py::handle& memory, const char* name, int dimensions = 1) {
  if (!py::hasattr(memory, name)) {
    throw InvalidValue("memory", shown(memory), "a LearnerMemory, which has " + std::string(name));
  }
  const py::object given = memory.attr(name);
  const auto array = py::array_t<T, py::array::c_style>::ensure(given);
  if (!py::isinstance<py::array_t<T>>(given) || !array || array.ndim() != dimensions) {
    PyErr_Clear();
    throw InvalidValue(
        "memory." + std::string(name),
        py::isinstance<py::array>(given)
            ? std::string(
                  py::str("{} of shape {}").format(given.attr("dtype"), given.attr("shape")))
            : std::string(py::repr(py::type::of(given))),
        "an array of " + std::string(py::str(py::dtype::of<T>())) + " in " +
            std::to_string(dimensions) + (dimensions == 1 ? " dimension" : " dimensions"));
  }
  return {array.data(), array.data() + array.size()};
}

MemoryObject memory_of(Idle learner) {
  LearnerMemory all = learner->state().memory;
  const auto situations = static_cast<py::ssize_t>(all.situation.size());
  return MemoryObject(
      py::module_::import("devlearn._types")
          .attr("LearnerMemory")(
              moved_array<std::int64_t>(std::move(all.situation)),
              moved_array<std::uint16_t>(std::move(all.effective_count)),
              moved_array<std::uint16_t>(std::move(all.ineffective_count)),
              moved_array<std::uint16_t>(std::move(all.motions),
                                         {situations, learner->config().motion_count}),
              moved_array<double>(std::move(all.orientation)),
              moved_array<std::uint32_t>(std::move(all.times_learned))));
}

Learner from_memory(const MemoryObject& memory, const std::optional<LearnerConfig>& config,
                    Whole<SeedTag> seed) {
  LearnerState state = Learner(config.value_or(LearnerConfig{}), seed.value).state();
  LearnerMemory& all = state.memory;
  all.situation = array_values<std::int64_t>(memory, "situation");
  all.effective_count = array_values<std::uint16_t>(memory, "effective_count");
  all.ineffective_count = array_values<std::uint16_t>(memory, "ineffective_count");
  all.motions = array_values<std::uint16_t>(memory, "motions", 2);
  all.orientation = array_values<double>(memory, "orientation");
  all.times_learned = array_values<std::uint32_t>(memory, "times_learned");
  return Learner(state);
}

// What is called at every step.
Choice choose(Idle self, Whole<SituationTag> situation) { return self->choose(situation.value); }
Development learn(Idle self, double smf) { return self->learn(smf); }

void bind_config(py::module_& m) {
  def_config<LearnerConfig>(m, "The learner's parameters; the defaults are the paper's.")
      .def_static("paper", &LearnerConfig::paper,
                  "The default: abandon and retry, the reading under which the paper's results "
                  "come out.")
      .def_static("step5", &LearnerConfig::step5,
                  "The other reading, for comparison: weaken and wander.");
}

void bind_results(py::module_& m) {
  py::native_enum<Kind>(m, "Kind", "enum.IntEnum", "Why a motion was chosen.")
      .value("EXPLORE", Kind::kExplore, "drawn from the motions not yet tried here")
      .value("EXPLOIT", Kind::kExploit, "winner of orientation and curiosity")
      .value("EXHAUSTED", Kind::kExhausted,
             "all that are allowed were tried and none is effective: any of these")
      .value("UNSTATED", Kind::kUnstated, "chosen by an agent that gives no reason")
      .value("HABIT", Kind::kHabit, "as in the best round so far")
      .value("DEVIATION", Kind::kDeviation, "another than the habit's, tried for what it promises")
      .value("HELD", Kind::kHeld, "the motion of before, for the situation has not changed")
      .finalize();
  py::native_enum<Event>(m, "Event", "enum.IntEnum", "What one outcome changed.")
      .value("NOTHING", Event::kNothing, "an ineffective motion stayed so")
      .value("EXTENSION", Event::kExtension, "the motion entered the effective list, Eq. 10-13")
      .value("REJECTION", Event::kRejection, "an explored motion proved ineffective")
      .value("ORIENTATION", Event::kOrientation, "the orientations changed by Eq. 9")
      .value("ABANDONMENT", Event::kAbandonment, "an exploited motion met SMF < 0 and left")
      .finalize();

  py::class_<MemoryUse> use(m, "MemoryUse", "Memory in bytes.");
  use.def_readonly("used", &MemoryUse::used, "By the situations experienced, their index included.")
      .def_readonly("spare", &MemoryUse::spare,
                    "Held for more of them: reserved, or left over by growth.")
      .def("__repr__", [](const py::object& self) {
        return py::str("MemoryUse(used={}, spare={})")
            .format(self.attr("used"), self.attr("spare"));
      });

  def_result(use, &MemoryUse::used, &MemoryUse::spare);

  py::class_<SituationMemory> memory(
      m, "SituationMemory",
      "What one situation holds, as a copy: three disjoint lists of motion "
      "indices, together always M (Eq. 3-4).");
  memory
      .def_readonly("effective", &SituationMemory::effective,
                    "M_i: motions found effective, in the order they entered.")
      .def_readonly("ineffective", &SituationMemory::ineffective,
                    "Motions found ineffective, or no longer good enough.")
      .def_readonly("unexplored", &SituationMemory::unexplored, "RM_i: motions not tried yet.")
      .def_readonly("orientation", &SituationMemory::orientation,
                    "Orientation of each effective motion; they sum to 1.")
      .def_readonly("times_learned", &SituationMemory::times_learned,
                    "n_ij of each effective motion.")
      .def("__repr__", [](const py::object& self) {
        return py::str(
                   "SituationMemory(effective={}, ineffective={}, unexplored={}, "
                   "orientation={}, times_learned={})")
            .format(self.attr("effective"), self.attr("ineffective"), self.attr("unexplored"),
                    self.attr("orientation"), self.attr("times_learned"));
      });
  def_result(memory, &SituationMemory::effective, &SituationMemory::ineffective,
             &SituationMemory::unexplored, &SituationMemory::orientation,
             &SituationMemory::times_learned);
}

}  // namespace

void bind_learner(py::module_& m) {
  bind_config(m);
  bind_results(m);
  bind_explanation(m);  // it shows results, and the learner shows it

  py::class_<Learner, std::shared_ptr<Learner>> cls(
      m, "Learner",
      "The sensorimotor developmental learner: a situation in, a motion out; how good it was in,\n"
      "the lists develop. It knows no robot, grid or task.\n\n"
      "    learner = Learner(LearnerConfig(motion_count=4), seed=1)\n"
      "    choice = learner.choose(situation)      # any whole number in 0 ... 2**63 - 1\n"
      "    ...execute choice.motion...\n"
      "    learner.learn(smf)                      # SMF = SEF after - SEF before, Eq. 8\n\n"
      "The same configuration, seed and outcomes give the same history everywhere. copy.copy and\n"
      "copy.deepcopy give independent learners that go on alike. One thread at a time.");
  cls.def(py::init([](const std::optional<LearnerConfig>& config, Whole<SeedTag> seed) {
            return std::make_shared<Learner>(config.value_or(LearnerConfig{}), seed.value);
          }),
          py::arg("config") = py::none(), py::arg("seed") = 0)
      .def(
          "choose",
          [](Idle self, Whole<SituationTag> situation, const Mask& allowed) {
            return self->choose(situation.value, allowed);
          },
          py::arg("situation"), py::arg("allowed") = py::none(),
          "Step 3: chooses a motion, among those `allowed`: bools, one a motion (None: every one). "
          "The others are neither drawn nor explored nor won by. Raises InvalidValue for a "
          "negative situation, while an earlier choice waits for learn() or cancel(), where no "
          "motion is allowed, or for a situation that refuse_growth refuses.")
      .def(
          "best",
          [](Idle self, Whole<SituationTag> situation) { return self->best(situation.value); },
          py::arg("situation"),
          "The effective motion of highest orientation, the first among equals; None where none "
          "is effective. Draws and changes nothing.")
      .def(
          "forget",
          [](Idle self, Whole<SituationTag> situation) { return self->forget(situation.value); },
          py::arg("situation"),
          "Forgets a situation, as if it had never been experienced; whether there was anything "
          "to forget. The last one takes its place in the order of situations. Raises "
          "InvalidValue for a negative situation, or while a choice waits in it.")
      .def(
          "learn",
          [](Idle self, double smf, std::optional<Whole<MotionTag>> motion) {
            return motion ? self->learn(smf, motion->value) : self->learn(smf);
          },
          py::arg("smf"), py::arg("motion") = py::none(),
          "Steps 4-5: learns from the chosen motion's SMF (finite; >= 0 means effective), or from "
          "that of the `motion` that really ran. Raises InvalidValue where no choice waits.")
      .def(
          "cancel", [](Idle self) { self->cancel(); },
          "The waiting choice was not executed; nothing is learned. Raises InvalidValue where none "
          "waits.")
      .def(
          "update",
          [](Idle self, Whole<SituationTag> situation, Whole<MotionTag> motion, double smf) {
            return self->update(situation.value, motion.value, smf);
          },
          py::arg("situation"), py::arg("motion"), py::arg("smf"),
          "Learns about any situation and motion, whoever chose: delayed outcomes, several robots, "
          "replay. A waiting choice goes on waiting. Raises InvalidValue.")
      .def(
          "situation",
          [](Idle self, Whole<SituationTag> situation) { return self->situation(situation.value); },
          py::arg("situation"),
          "A situation's lists, as a copy; of one never experienced every motion is unexplored. "
          "Creates nothing.")
      .def(
          "explain",
          [](Idle self, Whole<SituationTag> situation, const Mask& allowed) {
            return self->explain(situation.value, allowed);
          },
          py::arg("situation"), py::arg("allowed") = py::none(),
          "Why motions are chosen in a situation as it is now, of all or of those allowed: an "
          "Explanation. Changes nothing.")
      .def_property_readonly(
          "last_choice", [](Idle self) { return self->last_choice(); },
          "Why the last choice came out as it did, learned from or not: a ChoiceTrace; None before "
          "the first one since the learner was made or loaded.")
      .def(
          "situations", [](Idle self) { return moved_array<SituationId>(self->situations()); },
          "Ids of the situations experienced, in that order: an int64 array.")
      .def(
          "reserve",
          [](Learner& self, Whole<ReserveTag> situations, bool touch) {
            const InHand in_hand(self, InHand::For::kRunning);
            const NoGil no_gil;
            self.reserve(situations.value, touch ? Pages::kTouched : Pages::kUntouched);
          },
          py::arg("situations"), py::arg("touch").noconvert() = false,
          "Makes room for so many situations in all; touch: and takes the memory from the system "
          "now, so that no later call waits for it.")
      .def_property_readonly(
          "room", [](Idle self) { return self->room(); }, "For how many situations there is room.")
      .def(
          "refuse_growth", [](Idle self, bool refuse) { self->refuse_growth(refuse); },
          py::arg("refuse").noconvert() = true,
          "Whether situations beyond the room are refused (by choose and update, with "
          "InvalidValue; nothing has changed then) instead of room being made, which for a "
          "million of them takes a fifth of a second. Not part of a snapshot.")
      .def("memory", &memory_of,
           "All that it remembers, as a LearnerMemory: a tuple of arrays, which are copies.")
      .def_static(
          "from_memory", &from_memory, py::arg("memory"), py::arg("config") = py::none(),
          py::arg("seed") = 0,
          "A learner that remembers what the arrays of a LearnerMemory say, which are "
          "copied; its draws begin anew from the seed. Raises InvalidValue where they "
          "break a law: lists that do not partition M, unexplored motions out of order, "
          "orientations outside [1e-12, 1] or whose sum is not 1 within 1e-9, counts below 1, "
          "a situation twice, other types or shapes.")
      .def_property_readonly(
          "explored_count", [](Idle self) { return self->explored_count(); },
          "NUM_RM: mappings explored so far.")
      .def_property_readonly(
          "effective_count", [](Idle self) { return self->effective_count(); },
          "NUM_M: mappings now effective.")
      .def_property_readonly(
          "situations_experienced", [](Idle self) { return self->situations_experienced(); },
          "How many situations were experienced.")
      .def_property_readonly(
          "memory_use", [](Idle self) { return self->memory_use(); },
          "Bytes used and spare, a MemoryUse.")
      .def_property_readonly("config", &Learner::config, py::return_value_policy::copy,
                             "Its parameters.")
      .def_property_readonly("seed", &Learner::seed, "The seed it began with.")
      .def_property_readonly(
          "pending", [](Idle self) { return self->pending(); },
          "The choice that waits for its outcome, or None.")
      .def("__repr__", [](Idle self) {
        return "<devlearn.Learner: " + std::to_string(self->situations_experienced()) +
               " situations, " + std::to_string(self->explored_count()) + " mappings explored, " +
               std::to_string(self->effective_count()) + " effective>";
      });
  def_snapshots(cls);
  StraightMethod<&choose>::put_before(cls, "choose");
  StraightMethod<&learn>::put_before(cls, "learn");
}

}  // namespace devlearn::python
