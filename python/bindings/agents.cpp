#include "agents.hpp"

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <optional>

#include "bindings.hpp"
#include "devlearn/adaptive_agent.hpp"
#include "devlearn/agent.hpp"
#include "devlearn/detail/require.hpp"
#include "devlearn/learner_agent.hpp"

namespace devlearn::python {
namespace {

// --- what an agent written in Python goes on from -----------------------------------------------

struct Type {
  const char* dtype;  // in a snapshot
  const char* numpy;
};
constexpr Type kTypes[] = {{"F64", "f8"}, {"I64", "i8"}, {"U64", "u8"}, {"I32", "i4"},
                           {"U32", "u4"}, {"U16", "u2"}, {"U8", "u1"},  {"BOOL", "b1"}};

[[noreturn]] void refuse_entry(const std::string& name, const py::object& value) {
  throw InvalidValue("agent.state()[" + name + "]", shown(py::type::of(value)) + " " + shown(value),
                     "a str, a number, or a numpy array of float64, int64, uint64, int32, uint32, "
                     "uint16, uint8 or bool");
}

// A text in UTF-8.
std::string text_from(const std::string& quantity, const py::handle& text) {
  py::ssize_t size = 0;
  const char* const bytes = PyUnicode_AsUTF8AndSize(text.ptr(), &size);
  if (bytes == nullptr) {
    PyErr_Clear();
    throw InvalidValue(quantity, shown(text), "a str without surrogates");
  }
  return {bytes, static_cast<std::size_t>(size)};
}

// A copy of a number or a numpy array.
StateArray array_from(const std::string& name, const py::object& value) {
  const py::module_ numpy = py::module_::import("numpy");
  const bool number = py::isinstance<py::bool_>(value) || py::isinstance<py::int_>(value) ||
                      py::isinstance<py::float_>(value) ||
                      py::isinstance(value, numpy.attr("generic"));
  // Of a subclass, such as a masked array, only a part would be kept.
  if (!number && !py::type::of(value).is(numpy.attr("ndarray"))) refuse_entry(name, value);
  const py::object found = numpy.attr("asarray")(value).attr("dtype");
  for (const Type& type : kTypes) {
    const py::object dtype = numpy.attr("dtype")(type.numpy);
    if (!found.attr("newbyteorder")("=").equal(dtype)) continue;
    auto* const array = new py::array(numpy.attr("array")(
        value, py::arg("dtype") = dtype, py::arg("copy") = true, py::arg("order") = "C"));
    const std::shared_ptr<const void> owner(array, [](const py::array* owned) {
      const Gil gil;
      delete owned;
    });
    const Shape shape(array->shape(), array->shape() + array->ndim());
    return {type.dtype,
            shape,
            {owner, static_cast<const std::byte*>(array->data())},
            static_cast<std::size_t>(array->nbytes())};
  }
  refuse_entry(name, value);
}

AgentState state_from(const py::object& agent) {
  const py::object given = agent.attr("state")();
  if (!py::isinstance<py::dict>(given)) {
    throw InvalidValue("agent.state()", shown(given), "a dict of numpy arrays by name");
  }
  return state_of_dict(name_of(py::type::of(agent)), given.cast<py::dict>());
}

// numpy bounds dimensions and lengths by more than the bytes.
py::array numpy_array(const std::string& name, const py::dtype& dtype,
                      const std::vector<py::ssize_t>& shape, const void* first) {
  try {
    return py::array(dtype, shape, first);
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError)) throw;
    throw InvalidValue(name, shown(error.value(), PyObject_Str), "a shape that numpy can hold");
  }
}

// --- agents written in Python --------------------------------------------------------------------

struct MotionCountTag {
  using type = int;
  static constexpr const char* quantity = "motion_count";
  static constexpr const char* allowed = "a whole number in [1, 65535]";
};
struct EventTag {
  using type = int;
  static constexpr const char* quantity = "event";
  static constexpr const char* allowed = "a whole number in [-1, 63]";
};

/// An agent written in Python.
class PythonAgent final : public Agent {
 public:
  explicit PythonAgent(py::object agent) : agent_(std::move(agent)) {
    for (const char* method : {"choose", "observe"}) {
      if (!py::hasattr(agent_, method)) {
        throw InvalidValue(
            "agent", shown(agent_),
            "None, a Learner, an AdaptiveLearner, or an object with choose(observation) and "
            "observe(outcome)");
      }
    }
  }
  ~PythonAgent() override {
    const Gil gil;
    agent_ = py::object();
  }
  PythonAgent(const PythonAgent&) = delete;
  PythonAgent& operator=(const PythonAgent&) = delete;

  void begin_round() override { call_if_there("begin_round"); }

  Choice choose(const Observation& observation) override {
    const Gil gil;
    const py::object chosen = agent_.attr("choose")(KeptObservation(observation));
    py::detail::make_caster<Choice> choice;
    if (choice.load(chosen, true)) return choice;
    if (!PyIndex_Check(chosen.ptr())) {
      throw InvalidValue("agent's choice", shown(chosen), "a motion index or a Choice");
    }
    return {chosen.cast<Whole<MotionTag>>().value, Kind::kUnstated};
  }

  Development observe(const Outcome& outcome) override {
    const Gil gil;
    const py::object result = agent_.attr("observe")(outcome);
    py::detail::make_caster<Development> development;
    if (development.load(result, true)) {
      const Development developed = development;
      constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
      require_count("agent's development.reduced", developed.reduced, 0,
                    std::numeric_limits<int>::max());
      require_count("agent's development.explored_count", developed.explored_count, 0, kMost);
      require_count("agent's development.effective_count", developed.effective_count, 0, kMost);
      return developed;
    }
    if (py::isinstance(result, py::module_::import("devlearn._types").attr("Development"))) {
      throw InvalidValue("agent's development", shown(result),
                         "a Development of an Event and whole numbers");
    }
    return {};
  }

  void cancel() override { call_if_there("cancel"); }
  void end_round(bool arrived) override { call_if_there("end_round", arrived); }

  std::optional<AgentState> state() const override {
    const Gil gil;
    if (py::hasattr(agent_, "state") && py::hasattr(py::type::of(agent_), "from_state")) {
      return state_from(agent_);
    }
    throw InvalidValue("agent", shown(agent_),
                       "a Learner, an AdaptiveLearner, an agent of devlearn's, or one with state() "
                       "and a classmethod "
                       "from_state; save any other yourself, the trial with without_agent=True, "
                       "and give it to load as agent=");
  }

  const py::object& object() const { return agent_; }

 private:
  template <typename... Arguments>
  void call_if_there(const char* method, Arguments... arguments) {
    const Gil gil;
    if (py::hasattr(agent_, method)) agent_.attr(method)(arguments...);
  }

  py::object agent_;
};

// A trial calls what C++ has of T: methods that a class derived from it redefines would go unheard.
template <class T>
void require_own_methods(const py::object& agent, std::initializer_list<const char*> methods) {
  const py::object derived = py::type::of(agent), base = py::type::of<T>();
  for (const char* method : methods) {
    if (!py::getattr(derived, method, py::none()).is(py::getattr(base, method, py::none()))) {
      throw InvalidValue("agent", shown(agent),
                         "one whose " + std::string(method) +
                             " is not redefined, which a trial would not call; or an object of its "
                             "own with choose(observation) and observe(outcome)");
    }
  }
}

// The T that a Python object is. Of a derived class, the object lives as long.
template <class T>
std::shared_ptr<T> held(const py::object& object) {
  if (py::type::of(object).is(py::type::of<T>())) return object.cast<std::shared_ptr<T>>();
  return {shared_object(object), object.cast<T*>()};
}

// One of devlearn's own, or null.
template <class... A>
std::shared_ptr<Agent> as_own(const py::object& agent, Agents<A...>) {
  std::shared_ptr<Agent> own;
  const auto is = [&](auto* type) {
    using T = std::remove_pointer_t<decltype(type)>;
    if (!py::isinstance<T>(agent)) return false;
    require_own_methods<T>(agent, {"choose", "observe"});
    own = held<T>(agent);
    return true;
  };
  static_cast<void>((is(static_cast<A*>(nullptr)) || ...));
  return own;
}

// The same object as it was, or nothing.
template <class... A>
py::object own_object(const std::shared_ptr<Agent>& agent, Agents<A...>) {
  py::object object;
  const auto is = [&](auto* type) {
    const auto own = std::dynamic_pointer_cast<std::remove_pointer_t<decltype(type)>>(agent);
    if (own) object = py::cast(own);
    return own != nullptr;
  };
  static_cast<void>((is(static_cast<A*>(nullptr)) || ...));
  return object;
}

template <class... A>
py::handle own_type(const Agent& agent, Agents<A...>) {
  py::handle type;
  static_cast<void>(
      ((dynamic_cast<const A*>(&agent) != nullptr && (type = py::type::handle_of<A>(), true)) ||
       ...));
  return type;
}

}  // namespace

KeptObservation::KeptObservation(const Observation& seen) : Observation(seen) {
  if (!seen.allowed.every()) {
    mask.emplace(seen.allowed.data(), seen.allowed.data() + seen.allowed.size());
  }
  if (!seen.senses.empty()) sensed.emplace(seen.senses.begin(), seen.senses.end());
  allowed = {};
  senses = {};
}

SeenObservation::SeenObservation(const KeptObservation& kept) : seen_(kept) {
  if (kept.sensed) seen_.senses = {kept.sensed->data(), kept.sensed->size()};
  if (!kept.mask) return;
  allowed_ = std::make_unique<bool[]>(kept.mask->size());
  std::copy(kept.mask->begin(), kept.mask->end(), allowed_.get());
  seen_.allowed = {allowed_.get(), kept.mask->size()};
  seen_.allowed.validate(seen_.motion_count);
}

Choice choice_of(Agent& agent, const KeptObservation& observation) {
  return agent.choose(SeenObservation(observation));
}

std::string name_of(const py::object& named) {
  return py::str(py::str("{}:{}").format(named.attr("__module__"), named.attr("__qualname__")));
}

std::shared_ptr<const py::object> shared_object(const py::object& object) {
  return {new py::object(object), [](const py::object* owned) {
            const Gil gil;
            delete owned;
          }};
}

py::dict dict_of(const AgentState& state) {
  py::dict result;
  for (const auto& [name, text] : state.texts) result[py::str(name)] = py::str(text);
  for (const auto& [name, array] : state.arrays) {
    const auto* const first = reinterpret_cast<const std::uint8_t*>(array.data.get());
    if (array.dtype == "BOOL") {
      for (std::size_t i = 0; i < array.bytes; ++i) require_count(name, first[i], 0, 1);
    }
    const auto* const type = std::find_if(std::begin(kTypes), std::end(kTypes),
                                          [&](const Type& t) { return array.dtype == t.dtype; });
    const std::vector<py::ssize_t> shape(array.shape.begin(), array.shape.end());
    const py::object values = numpy_array(name, py::dtype(type->numpy), shape, first);
    result[py::str(name)] = shape.empty() ? py::object(values.attr("item")()) : values;
  }
  return result;
}

AgentState state_of_dict(const std::string& kind, const py::dict& dict) {
  AgentState state;
  state.kind = kind;
  for (const auto& [key, value] : dict) {
    const std::string shown_key = shown(key);
    if (!py::isinstance<py::str>(key)) {
      throw InvalidValue("agent.state()", shown_key, "a name that is a str");
    }
    const std::string name = text_from("agent.state()", key);
    if (py::isinstance<py::str>(value)) {
      state.texts[name] = text_from("agent.state()[" + shown_key + "]", value);
    } else {
      state.arrays[name] = array_from(shown_key, py::reinterpret_borrow<py::object>(value));
    }
  }
  return state;
}

const char* own_name(const Agent& agent) {
  const py::handle type = own_type(agent, OwnAgents());
  if (!type) return nullptr;
  const char* const name = reinterpret_cast<PyTypeObject*>(type.ptr())->tp_name;
  const char* const dot = std::strrchr(name, '.');
  return dot == nullptr ? name : dot + 1;
}

std::shared_ptr<Agent> as_agent(const py::object& agent) {
  if (const auto own = as_own(agent, OwnAgents())) return own;
  if (py::isinstance<Learner>(agent) && !py::hasattr(agent, "observe")) {
    require_own_methods<Learner>(agent, {"choose", "learn"});
    return std::make_shared<LearnerAgent>(held<Learner>(agent));
  }
  if (py::isinstance<AdaptiveLearner>(agent) && !py::hasattr(agent, "observe")) {
    require_own_methods<AdaptiveLearner>(agent, {"choose", "learn", "begin_round", "end_round"});
    return std::make_shared<AdaptiveAgent>(held<AdaptiveLearner>(agent));
  }
  return std::make_shared<PythonAgent>(agent);
}

py::object agent_of(const Trial& trial) {
  if (const auto* python = dynamic_cast<const PythonAgent*>(trial.agent().get())) {
    return python->object();
  }
  if (const auto learner = trial.learner()) return py::cast(learner);
  if (const auto learner = trial.adaptive_learner()) return py::cast(learner);
  return own_object(trial.agent(), OwnAgents());
}

LoadOptions load_options(const py::object& agent) {
  if (agent.is_none()) return {nullptr, ShortestPathAgent::maker};
  if (!PyType_Check(agent.ptr())) return {as_agent(agent)};
  if (!py::hasattr(agent, "from_state")) {
    throw InvalidValue("agent", shown(agent), "an agent, or a class with from_state");
  }
  const AgentMaker make = [agent](const AgentState& state) {
    const Gil gil;
    // A module may have moved, or be the program itself.
    const std::string name = py::str(agent.attr("__qualname__"));
    const std::size_t colon = state.kind.find(':');
    if (colon == state.kind.npos || state.kind.substr(colon + 1) != name) {
      throw InvalidValue("agent", state.kind, "one of " + name + ", the class given");
    }
    return as_agent(agent.attr("from_state")(dict_of(state)));
  };
  return {nullptr, make};
}

void bind_agents(py::module_& m) {
  // What it says of itself: a number a field.
  const auto shown = [](const char* format, std::vector<std::string> names) {
    return [format, names = std::move(names)](const py::object& self) {
      return py::str(format).format(*attributes(self, names));
    };
  };
  py::class_<KeptObservation> observation(
      m, "Observation",
      "What an agent knows when it chooses.\n\n"
      "A trial makes it. So does, with what agents of devlearn's look at, a loop of one's own:\n"
      "situation, a whole number in [0, 2**63 - 1]; motion_count in [1, 65535]; estimate and sef,\n"
      "numbers; allowed, bools, one a motion (None: every one); senses, finite numbers (None: no\n"
      "such). What is left out is 0. Raises InvalidValue.");
  observation
      .def(py::init([](Whole<SituationTag> situation, Whole<MotionCountTag> motion_count,
                       double estimate, double sef, const Mask& allowed,
                       const std::optional<std::vector<double>>& senses) {
             require_count("situation", situation.value, 0,
                           std::numeric_limits<SituationId>::max());
             require_count("motion_count", motion_count.value, 1, 65535);
             Observation seen;
             seen.situation = situation.value;
             seen.motion_count = motion_count.value;
             seen.estimate = estimate;
             seen.sef = sef;
             seen.allowed = allowed;
             seen.allowed.validate(seen.motion_count);
             if (senses) {
               for (const double value : *senses) require_finite("senses", value);
               seen.senses = {senses->data(), senses->size()};
             }
             return KeptObservation(seen);
           }),
           py::arg("situation"), py::arg("motion_count"), py::kw_only(), py::arg("estimate") = 0.0,
           py::arg("sef") = 0.0, py::arg("allowed") = py::none(), py::arg("senses") = py::none())
      .def_readonly("situation", &Observation::situation, "The present situation's id.")
      .def_readonly("pose", &Observation::pose, "[m, m, degrees]")
      .def_readonly("sef", &Observation::sef, "SEF here.")
      .def_readonly("goal_distance", &Observation::goal_distance, "d_g [m]")
      .def_readonly("clearance", &Observation::clearance, "d_o [m]")
      .def_readonly("estimate", &Observation::estimate,
                    "Cost to go at the least, in steps: d_g / (v t_s), 0 at the target.")
      .def_readonly("motion_count", &Observation::motion_count,
                    "Choose one in 0 ... motion_count - 1.")
      .def_property_readonly(
          "allowed",
          [](const KeptObservation& self) -> std::optional<py::array_t<bool>> {
            if (!self.mask) return std::nullopt;
            py::array_t<bool> allowed(static_cast<py::ssize_t>(self.mask->size()));
            std::copy(self.mask->begin(), self.mask->end(), allowed.mutable_data());
            return allowed;
          },
          "Of these, the motions that the robot can make: bools, one a motion; None for every "
          "one.")
      .def_property_readonly(
          "senses",
          [](const KeptObservation& self) -> std::optional<py::array_t<double>> {
            if (!self.sensed) return std::nullopt;
            return py::array_t<double>(static_cast<py::ssize_t>(self.sensed->size()),
                                       self.sensed->data());
          },
          "What a task senses, as numbers; None where there are none, as in a trial.")
      .def(
          "__repr__",
          shown(
              "<devlearn.Observation: situation {0}, pose ({1.x:.4g}, {1.y:.4g}, {1.heading:.4g}), "
              "sef {2:.4g}, goal_distance {3:.4g}, clearance {4:.4g}, estimate {5:.4g}, "
              "motion_count {6}>",
              {"situation", "pose", "sef", "goal_distance", "clearance", "estimate",
               "motion_count"}));
  def_result(observation, &Observation::situation, &Observation::pose, &Observation::sef,
             &Observation::goal_distance, &Observation::clearance, &Observation::estimate,
             &Observation::motion_count, &KeptObservation::mask, &KeptObservation::sensed);
  py::class_<Outcome> outcome(
      m, "Outcome",
      "What an agent is told about the motion it chose.\n\n"
      "A trial makes it; so does a loop of one's own: situation, a whole number in\n"
      "[0, 2**63 - 1]; cost, estimate, sef and smf, numbers; arrived and collided, bools; event, "
      "a\n"
      "whole number in [-1, 63]. Raises InvalidValue.");
  outcome
      .def(py::init([](Whole<SituationTag> situation, double cost, double estimate, bool arrived,
                       double sef, double smf, bool collided, Whole<EventTag> event) {
             require_count("situation", situation.value, 0,
                           std::numeric_limits<SituationId>::max());
             require_count("event", event.value, -1, kEventCount - 1);
             return Outcome{situation.value, sef,      smf,  collided,
                            arrived,         estimate, cost, event.value};
           }),
           py::arg("situation"), py::kw_only(), py::arg("cost") = 1.0, py::arg("estimate") = 0.0,
           py::arg("arrived") = false, py::arg("sef") = 0.0, py::arg("smf") = 0.0,
           py::arg("collided") = false, py::arg("event") = -1)
      .def_readonly("situation", &Outcome::situation, "The next situation's id.")
      .def_readonly("sef", &Outcome::sef, "SEF there.")
      .def_readonly("smf", &Outcome::smf, "SMF as learned from: min(SMF, -1) for a collision.")
      .def_readonly("collided", &Outcome::collided, "Whether the body touched something.")
      .def_readonly("arrived", &Outcome::arrived, "d_g <= goal_radius.")
      .def_readonly("estimate", &Outcome::estimate, "Cost to go from there, as in Observation.")
      .def_readonly("cost", &Outcome::cost,
                    "What the step cost: 1, and touch_cost more if it collided.")
      .def_readonly("event", &Outcome::event,
                    "The salient event that it was, in [0, 63], -1 for none. In a trial 0 is an "
                    "arrival, and 1 a touch.")
      .def_property_readonly("reward", &Outcome::reward, "-cost.")
      .def(
          "__repr__",
          shown("<devlearn.Outcome: situation {}, sef {:.4g}, smf {:.4g}, collided {}, arrived {}, "
                "estimate {:.4g}, cost {:.4g}, reward {:.4g}, event {}>",
                {"situation", "sef", "smf", "collided", "arrived", "estimate", "cost", "reward",
                 "event"}));

  def_result(outcome, &Outcome::situation, &Outcome::sef, &Outcome::smf, &Outcome::collided,
             &Outcome::arrived, &Outcome::estimate, &Outcome::cost, &Outcome::event);
  py::class_<RandomAgent, std::shared_ptr<RandomAgent>> random_agent(
      m, "RandomAgent", "Uniformly random motions: what learning is measured against.");
  random_agent
      .def(py::init([](Whole<SeedTag> seed) { return std::make_shared<RandomAgent>(seed.value); }),
           py::arg("seed") = 0)
      .def("__repr__", [](const RandomAgent& self) {
        return "<devlearn.RandomAgent: generator " + words_of(self.random()) + ">";
      });
  def_calls(random_agent);
  def_pickling_by_state(
      random_agent, [](const RandomAgent& self) { return self.random().state(); },
      [](const py::object& state) { return RandomAgent(Random(state.cast<Random::State>())); });
}

}  // namespace devlearn::python
