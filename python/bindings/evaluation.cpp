#include "devlearn/evaluation.hpp"

#include "config.hpp"

namespace devlearn::python {

void bind_evaluation(py::module_& m) {
  def_config<StateEvaluation>(
      m,
      "Step 2, the state evaluation function (Eq. 6); the defaults are the paper's:\n\n"
      "    SEF = (a1 - a2 * d_g**2) - a3 * exp(a4 - a5 * d_o)")
      .def("__call__", &StateEvaluation::operator(), py::arg("goal_distance"),
           py::arg("obstacle_distance"),
           "SEF at a distance d_g in [0, 1e6] m from the target and d_o >= 0 m (inf where there is "
           "no obstacle) from the nearest obstacle. Numbers give a float; arrays broadcast. Raises "
           "InvalidValue.")
      .def("__call__", py::vectorize([](const StateEvaluation* self, double goal, double obstacle) {
             take_a_breath();
             return (*self)(goal, obstacle);
           }),
           py::arg("goal_distance"), py::arg("obstacle_distance"));
}

}  // namespace devlearn::python
