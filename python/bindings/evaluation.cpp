#include "devlearn/evaluation.hpp"

#include "config.hpp"

namespace devlearn::python {

void bind_evaluation(py::module_& m) {
  def_config<StateEvaluation>(
      m,
      "Step 2, the state evaluation function (Eq. 6); the defaults are the paper's:\n\n"
      "    SEF = (a1 - a2 * d_g**2) - a3 * exp(a4 - a5 * d_o)")
      .def_static(
          "scaled", &StateEvaluation::scaled, py::arg("arena"), py::arg("radius"),
          "The paper's shape for another arena [m, its greater side, in [0.01, 1e6]] and another "
          "radius of the robot [m, in [1e-5, arena / 2]]: SEF is the paper's at the same share of "
          "the arena from the target and the same number of radii from an obstacle. The paper's 5 "
          "m and 0.1 m give the defaults; else a2 = 0.3 (5 m / arena)**2 and a5 = 12 (0.1 m / "
          "radius). Raises InvalidValue.")
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
