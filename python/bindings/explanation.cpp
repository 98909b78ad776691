#include "devlearn/explanation.hpp"

#include "bindings.hpp"

namespace devlearn::python {

void bind_explanation(py::module_& m) {
  py::class_<Explanation> explanation(
      m, "Explanation",
      "Why motions are chosen in a situation: all that step 3 makes of its "
      "memory. Of N motions,\nn are effective. Where not every motion is "
      "allowed, n and n_R of the probabilities count\nthose that are. str() of "
      "it is a table.");
  explanation.def_readonly("situation", &Explanation::situation, "The situation's id.")
      .def_readonly("memory", &Explanation::memory,
                    "What the choice goes by: lists, orientations, counts.")
      .def_readonly("allowed", &Explanation::allowed,
                    "N bools: whether each motion of M may be chosen.")
      .def_readonly("explore", &Explanation::explore, "Probability to explore, n_R / (n + n_R).")
      .def_readonly("exploit", &Explanation::exploit, "Probability to exploit, n / (n + n_R).")
      .def_readonly("exhausted", &Explanation::exhausted,
                    "1 where nothing is left to explore or exploit, otherwise 0.")
      .def_readonly("probability", &Explanation::probability,
                    "N values: of each motion of M to be chosen; they sum to 1.")
      .def_readonly("curiosity", &Explanation::curiosity,
                    "n values: c_ik of each effective motion, Eq. 5.")
      .def_readonly("op_plain", &Explanation::op_plain,
                    "n values: op of each, another one's curiosity active, Eq. 7.")
      .def_readonly("op_curious", &Explanation::op_curious,
                    "n values: op of each, its own curiosity active, Eq. 7.")
      .def_readonly("winner", &Explanation::winner,
                    "n values: the motion that wins where the curiosity of each is active; -1 of "
                    "one that is not allowed.")
      .def("__str__", py::overload_cast<const Explanation&>(&to_text))
      .def("__repr__", [](const py::object& self) {
        return py::str("<devlearn.Explanation: situation {}, probability {}>")
            .format(self.attr("situation"), self.attr("probability"));
      });

  def_result(explanation, &Explanation::situation, &Explanation::memory, &Explanation::allowed,
             &Explanation::explore, &Explanation::exploit, &Explanation::exhausted,
             &Explanation::probability, &Explanation::curiosity, &Explanation::op_plain,
             &Explanation::op_curious, &Explanation::winner);

  py::class_<ChoiceTrace> trace(m, "ChoiceTrace",
                                "Why one choice came out as it did. str() of it is a table.");
  trace
      .def_readonly("explanation", &ChoiceTrace::explanation,
                    "Of the situation as the choice found it.")
      .def_readonly("choice", &ChoiceTrace::choice, "The Choice.")
      .def_readonly("curious", &ChoiceTrace::curious,
                    "The motion whose curiosity was drawn; -1 unless exploited.")
      .def_readonly("op", &ChoiceTrace::op,
                    "n values: op of each effective motion, Eq. 7; empty unless exploited.")
      .def("__str__", py::overload_cast<const ChoiceTrace&>(&to_text))
      .def("__repr__", [](const py::object& self) {
        return py::str("<devlearn.ChoiceTrace: {!r}>").format(self.attr("choice"));
      });
  def_result(trace, &ChoiceTrace::explanation, &ChoiceTrace::choice, &ChoiceTrace::curious,
             &ChoiceTrace::op);
}

}  // namespace devlearn::python
