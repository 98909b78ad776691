#include "devlearn/operant_conditioning.hpp"

#include "def_agent.hpp"

namespace devlearn::python {
namespace {

void bind_explanation_of_conditioning(py::module_& m) {
  using E = ConditioningExplanation;
  py::class_<E> why(m, "ConditioningExplanation",
                    "What devlearn.agents.OperantConditioning has come to in a situation. str() of "
                    "it is a table.");
  why.def_readonly("situation", &E::situation, "The situation's id.")
      .def_readonly("allowed", &E::allowed, "N bools: whether each motion may be chosen.")
      .def_readonly("probability", &E::probability,
                    "N values: of each to be chosen; they sum to 1.")
      .def_readonly("tried", &E::tried, "N whole numbers: how often each was.")
      .def_readonly("reinforced", &E::reinforced, "N whole numbers: and was reinforced.")
      .def_readonly("extinguished", &E::extinguished, "N whole numbers: and was extinguished.")
      .def_readonly("entropy", &E::entropy, "Of all N probabilities, -sum p log2 p [bits].")
      .def_readonly("mean_reward", &E::mean_reward, "Of the rewards that came; 0 before the first.")
      .def_readonly("last_motion", &E::last_motion, "The one last tried; -1 for none.")
      .def_readonly("last_reinforcement", &E::last_reinforcement,
                    "What came of it: 1 reinforced, -1 extinguished, 0 neither.")
      .def("__str__", py::overload_cast<const E&>(&to_text))
      .def("__repr__", [](const py::object& self) {
        return py::str("<devlearn.ConditioningExplanation: situation {}, probability {}>")
            .format(self.attr("situation"), self.attr("probability"));
      });
  def_result(why, &E::situation, &E::allowed, &E::probability, &E::tried, &E::reinforced,
             &E::extinguished, &E::entropy, &E::mean_reward, &E::last_motion,
             &E::last_reinforcement);
}

}  // namespace

void bind_operant_conditioning(py::module_& m) {
  bind_explanation_of_conditioning(m);
  def_agent<OperantConditioning>(
      m, "OperantConditioning",
      "Operant conditioning as a one-to-one mapping, a learning automaton of linear reward and\n"
      "penalty in each situation (Narendra & Thathachar 1974): a probability for each of N "
      "motions.\n"
      "Where motion i is reinforced, p_i grows by a (1 - p_i) and the others shrink by a p_j; "
      "where\n"
      "it is extinguished, p_i shrinks by b p_i and the others grow by b (1 / (N - 1) - p_j).")
      .def(
          "probability",
          [](const OperantConditioning& self, Whole<SituationTag> situation,
             Whole<MotionTag> motion) {
            return readable(self).probability(situation.value, motion.value);
          },
          py::arg("situation"), py::arg("motion"),
          "The probability of a motion in a situation where all are allowed; None for a situation "
          "never met. Raises InvalidValue.")
      .def(
          "entropy",
          [](const OperantConditioning& self, Whole<SituationTag> situation) {
            return readable(self).entropy(situation.value);
          },
          py::arg("situation"),
          "Entropy of a situation's probabilities, -sum p log2 p, in [0, log2 N] bits; None for a "
          "situation never met. Raises InvalidValue.")
      .def(
          "mean_entropy",
          [](const OperantConditioning& self) { return readable(self).mean_entropy(); },
          "The mean of that over all situations met; None before the first.")
      .def(
          "explain",
          [](const OperantConditioning& self, Whole<SituationTag> situation, const Mask& allowed) {
            return readable(self).explain(situation.value, allowed);
          },
          py::arg("situation"), py::arg("allowed") = py::none(),
          "What it has come to in a situation, of all motions or of those allowed: a "
          "ConditioningExplanation; None for a situation never met. Changes nothing. Raises "
          "InvalidValue.");
}

}  // namespace devlearn::python
