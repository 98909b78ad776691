#include "bindings.hpp"
#include "devlearn/version.hpp"
#include "wrong_calls.hpp"

PYBIND11_MODULE(_core, m) {
  m.doc() = "The C++ core of devlearn. Use it through the package `devlearn`.";
  m.attr("__version__") = devlearn::version();
  m.attr("commit") = devlearn::commit();
  m.attr("box2d_version") = DEVLEARN_BOX2D_VERSION;

  devlearn::python::bind_threads(m);
  devlearn::python::bind_error(m);
  devlearn::python::bind_math(m);
  devlearn::python::bind_file(m);
  devlearn::python::bind_random(m);
  devlearn::python::bind_situation(m);
  devlearn::python::bind_evaluation(m);
  devlearn::python::bind_learner(m);
  devlearn::python::bind_adaptive(m);
  devlearn::python::bind_world(m);
  devlearn::python::bind_robot(m);
  devlearn::python::bind_record(m);
  devlearn::python::bind_agents(m);
  devlearn::python::bind_value_agents(m);
  devlearn::python::bind_trial(m);
  devlearn::python::bind_trial_snapshot(m);
  devlearn::python::explain_wrong_calls(m);
}
