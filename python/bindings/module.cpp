#include "bindings.hpp"
#include "devlearn/version.hpp"
#include "tasks.hpp"
#include "wrong_calls.hpp"

namespace {

// By pickle's protocols 0 and 1 an object would be made through pybind11's base class, which ends
// the process: they go the way of 2.
void pickle_by_every_protocol(py::module_& m) {
  for (const auto& [name, value] : m.attr("__dict__").cast<py::dict>()) {
    if (!PyType_Check(value.ptr()) || !py::hasattr(value, "_pybind11_conduit_v1_")) continue;
    value.attr("__reduce_ex__") = py::cpp_function(
        [](const py::object& self, int protocol) {
          const py::object object = py::module_::import("builtins").attr("object");
          return object.attr("__reduce_ex__")(self, std::max(protocol, 2));
        },
        py::name("__reduce_ex__"), py::is_method(value), py::arg("protocol"), "For pickle.");
  }
}

// Jupyter and its like ask objects how they show themselves; Python draws that.
void show_in_notebooks(py::module_& m) {
  const struct {
    const char *type, *method, *function;
  } shown[] = {
      {"World", "_repr_svg_", "world_svg"},
      {"Robot", "_repr_svg_", "robot_svg"},
      {"RobotDef", "_repr_svg_", "robot_def_svg"},
      {"Trial", "_repr_html_", "trial_html"},
      {"Learner", "_repr_html_", "learner_html"},
      {"AdaptiveLearner", "_repr_html_", "adaptive_html"},
      {"Explanation", "_repr_html_", "explanation_html"},
      {"ChoiceTrace", "_repr_html_", "trace_html"},
      {"AdaptiveExplanation", "_repr_html_", "adaptive_explanation_html"},
  };
  for (const auto& [name, method, function] : shown) {
    const py::object type = m.attr(name);
    type.attr(method) = py::cpp_function(
        [function = function](const py::object& self) {
          const auto display = py::module_::import("devlearn.viewer.display");
          return py::str(display.attr(function)(self));
        },
        py::name(method), py::is_method(type), "For notebooks.");
  }
}

}  // namespace

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
  devlearn::python::bind_tally(m);
  devlearn::python::bind_agents(m);
  devlearn::python::bind_value_agents(m);
  devlearn::python::bind_iac(m);
  devlearn::python::bind_operant_conditioning(m);
  devlearn::python::bind_salient_events(m);
  devlearn::python::bind_tasks(m);
  devlearn::python::bind_playroom(m);
  devlearn::python::bind_attention(m);
  devlearn::python::bind_balance(m);
  devlearn::python::bind_appraisal(m);
  devlearn::python::bind_foraging(m);
  devlearn::python::bind_trial(m);
  devlearn::python::bind_trial_snapshot(m);
  devlearn::python::bind_batch(m);
  pickle_by_every_protocol(m);
  show_in_notebooks(m);
  devlearn::python::explain_wrong_calls(m);
}
