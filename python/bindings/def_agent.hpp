#pragma once

// A class for each agent of devlearn's that has a Config.

#include <memory>
#include <optional>
#include <string>

#include "agents.hpp"
#include "bindings.hpp"
#include "config.hpp"

namespace devlearn::python {

/// An agent that Python reads; not while another thread's run has it in hand.
template <class A>
const A& readable(const A& agent) {
  require_free(&agent, own_name(agent), InHand::For::kReading);
  return agent;
}

/// Pickling by what it goes on from.
template <class A>
void def_pickling_of_agent(py::class_<A, std::shared_ptr<A>>& cls) {
  def_pickling_by_state(
      cls, [](const A& self) { return dict_of(*readable(self).state()); },
      [](const py::object& state) {
        if (!py::isinstance<py::dict>(state)) {
          throw InvalidValue("state", shown(state), "a dict, as pickle writes it");
        }
        return A(state_of_dict(A::kKind, state.cast<py::dict>()), "state");
      });
}

/// The class of agent A, which goes on from what it is told in a trial, and that of its settings.
/// `further` tells of parameters besides config and seed; who calls defines the constructor.
template <class A>
py::class_<A, std::shared_ptr<A>> def_agent_without_init(py::module_& m, const std::string& name,
                                                         const std::string& about,
                                                         const std::string& further = "") {
  using Config = typename A::Config;
  const py::object config = def_config<Config>(m, "The settings of " + name + ".");
  const std::string doc =
      about + "\n\nIn a trial: Trial(world, agent=" + name +
      "()). It is saved with its trial, pickled and copied.\n\nParameters: config, a " + name +
      "Config, also " + name + ".Config (None: the defaults); seed of its draws" + further +
      ".\nRaises InvalidValue.";
  py::class_<A, std::shared_ptr<A>> cls(m, name.c_str(), doc.c_str());
  cls.attr("Config") = config;
  def_pickling_of_agent(cls);
  def_calls(cls);
  cls.def_property_readonly(
         "config", [](const A& self) { return self.config(); }, "Its settings.")
      .def("__repr__", [](const py::object& self) {
        return py::str("<devlearn.agents.{}: {!r}>")
            .format(py::type::of(self).attr("__name__"), self.attr("config"));
      });
  return cls;
}

/// The same, with the constructor of those that are made from settings and a seed.
template <class A>
py::class_<A, std::shared_ptr<A>> def_agent(py::module_& m, const std::string& name,
                                            const std::string& about) {
  using Config = typename A::Config;
  auto cls = def_agent_without_init<A>(m, name, about);
  cls.def(py::init([](const std::optional<Config>& given, Whole<SeedTag> seed) {
            return std::make_shared<A>(given.value_or(Config{}), seed.value);
          }),
          py::arg("config") = py::none(), py::arg("seed") = 0);
  return cls;
}

/// The class of an agent that learns values of motions.
template <class A>
py::class_<A, std::shared_ptr<A>> def_value_agent(py::module_& m, const std::string& name,
                                                  const std::string& about) {
  auto cls = def_agent<A>(m, name, about);
  cls.def(
      "value",
      [](const A& self, Whole<SituationTag> situation, Whole<MotionTag> motion) {
        return readable(self).value(situation.value, motion.value);
      },
      py::arg("situation"), py::arg("motion"),
      "The value of a motion in a situation; None for a situation never met. Raises "
      "InvalidValue.");
  return cls;
}

}  // namespace devlearn::python
