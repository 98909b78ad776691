#include "devlearn/evaluation.hpp"

#include "bindings.hpp"

namespace devlearn::python {

void bind_evaluation(py::module_& m) {
  py::class_<StateEvaluation> cls(
      m, "StateEvaluation",
      "Step 2, the state evaluation function (Eq. 6):\n\n"
      "    SEF = (a1 - a2 * d_g**2) - a3 * exp(a4 - a5 * d_o)\n\n"
      "Parameters: a1 in [-1e6, 1e6], a2, a3, a5 in [0, 1e6], a4 in [-100, 100]; the defaults are\n"
      "the paper's. Raises InvalidValue.");
  cls.def(py::init([](double a1, double a2, double a3, double a4, double a5) {
            const StateEvaluation evaluation{a1, a2, a3, a4, a5};
            evaluation.validate();
            return evaluation;
          }),
          py::arg("a1") = 20.0, py::arg("a2") = 0.3, py::arg("a3") = 0.2, py::arg("a4") = 5.0,
          py::arg("a5") = 12.0);
  cls.def("__call__", &StateEvaluation::operator(), py::arg("goal_distance"),
          py::arg("obstacle_distance"),
          "SEF at a distance d_g in [0, 1e6] m from the target and d_o >= 0 m (inf where there is "
          "no obstacle) from the nearest obstacle. Numbers give a float; arrays broadcast. Raises "
          "InvalidValue.");
  cls.def("__call__", py::vectorize(&StateEvaluation::operator()), py::arg("goal_distance"),
          py::arg("obstacle_distance"));
  cls.def_readonly("a1", &StateEvaluation::a1, "SEF at the target, far from obstacles.");
  cls.def_readonly("a2", &StateEvaluation::a2, "Pull of the target [1/m^2].");
  cls.def_readonly("a3", &StateEvaluation::a3, "Push of obstacles.");
  cls.def_readonly("a4", &StateEvaluation::a4, "Log of the push at an obstacle's surface.");
  cls.def_readonly("a5", &StateEvaluation::a5, "How fast the push decays [1/m].");
  def_fields(cls, {"a1", "a2", "a3", "a4", "a5"});
}

}  // namespace devlearn::python
