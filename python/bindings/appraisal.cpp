#include "devlearn/appraisal.hpp"

#include "agents.hpp"
#include "bindings.hpp"
#include "def_agent.hpp"

namespace devlearn::python {
namespace {

void bind_appraisal_explanation(py::module_& m) {
  using Why = AppraisalExplanation;
  py::class_<Why> cls(
      m, "AppraisalExplanation",
      "How a situation is appraised at present, for each of its N motions. The reward of a motion "
      "is\nthe sum of its four appraisals and of the mean reward from outside, weighted by the "
      "settings.\nstr() of it is a table.");
  cls.def_readonly("situation", &Why::situation, "The situation's id.")
      .def_readonly("config", &Why::config, "The AppraisalConfig: the weights among its settings.")
      .def_readonly("epsilon", &Why::epsilon, "The probability of a random motion, at present.")
      .def_readonly("goal", &Why::goal,
                    "The situation of the highest external value; -1: none as yet.")
      .def_readonly("goal_distance", &Why::goal_distance,
                    "Motions from here to the goal, by all transitions seen; -1: no way is known.")
      .def_readonly("allowed", &Why::allowed,
                    "N bools: whether each was allowed at the last choice here.")
      .def_readonly("visits", &Why::visits, "N values: how often each was tried.")
      .def_readonly("novelty", &Why::novelty, "N values, in [0, 1].")
      .def_readonly("motivation", &Why::motivation, "In [0, 1], the same for all motions.")
      .def_readonly("control", &Why::control, "N values, in [0, 1].")
      .def_readonly("valence", &Why::valence, "N values, in [0, 1].")
      .def_readonly("external", &Why::external,
                    "N values: mean reward from outside; 0 for one never tried.")
      .def_readonly("reward", &Why::reward, "N values: what they come to.")
      .def_readonly("value", &Why::value, "N values: Q, by which motions are chosen.")
      .def_readonly("external_value", &Why::external_value,
                    "N values: Q of external rewards alone.")
      .def("__str__", py::overload_cast<const Why&>(&to_text))
      .def("__repr__", [](const py::object& self) {
        return py::str("<devlearn.agents.AppraisalExplanation: situation {}, reward {}>")
            .format(self.attr("situation"), self.attr("reward"));
      });
  def_result(cls, &Why::situation, &Why::config, &Why::epsilon, &Why::goal, &Why::goal_distance,
             &Why::allowed, &Why::visits, &Why::novelty, &Why::motivation, &Why::control,
             &Why::valence, &Why::external, &Why::reward, &Why::value, &Why::external_value);
}

}  // namespace

void bind_appraisal(py::module_& m) {
  auto cls = def_value_agent<Appraisal>(
      m, "Appraisal",
      "Learning by appraising, as in Sequeira, Melo & Paiva (2011; 2014): rewards come from "
      "within.\nEach step is appraised by its history, for novelty, motivation, control and "
      "valence, each in\n[0, 1]; Q is learned of their sum with the reward from outside, weighted, "
      "by prioritized\nsweeping. Motions are chosen by Q, epsilon-greedy, with an epsilon that "
      "falls.");
  bind_appraisal_explanation(m);
  cls.def_property_readonly(
         "epsilon", [](const Appraisal& self) { return readable(self).epsilon(); },
         "The probability of a random motion, at present.")
      .def(
          "explain",
          [](const Appraisal& self, Whole<SituationTag> situation) {
            return readable(self).explain(situation.value);
          },
          py::arg("situation"),
          "How a situation is appraised, an AppraisalExplanation; None for one never met. Draws "
          "and\nchanges nothing. Raises InvalidValue.");
}

}  // namespace devlearn::python
