#include "devlearn/salient_events.hpp"

#include "bindings.hpp"
#include "def_agent.hpp"

namespace devlearn::python {
namespace {

void bind_explanation_of_salient_events(py::module_& m) {
  py::class_<OptionView> view(m, "OptionView", "An option, as it stands in a situation.");
  view.def_readonly("event", &OptionView::event, "The salient event that it leads to, 0 ... 63.")
      .def_readonly("available", &OptionView::available, "Whether it can be begun here.")
      .def_readonly("probability", &OptionView::probability,
                    "Of its event, in [0, 1], discounted by the steps to it: sum_x P(x | s).")
      .def_readonly("intrinsic", &OptionView::intrinsic,
                    "Intrinsic reward of its event now, where it comes in the likeliest way.")
      .def_readonly("value", &OptionView::value, "Q_B of it.")
      .def_readonly("motion", &OptionView::motion,
                    "What it does first, the first among equals; -1 where it is not available.")
      .def("__repr__", [](const py::object& self) {
        return py::str("<devlearn.OptionView: event {}, probability {:.4g}, value {:.4g}>")
            .format(self.attr("event"), self.attr("probability"), self.attr("value"));
      });
  def_result(view, &OptionView::event, &OptionView::available, &OptionView::probability,
             &OptionView::intrinsic, &OptionView::value, &OptionView::motion);

  using Why = SalientEventsExplanation;
  py::class_<Why> why(m, "SalientEventsExplanation",
                      "What SalientEvents makes of a situation. str() of it is a table.");
  why.def_readonly("situation", &Why::situation, "The situation's id.")
      .def_readonly("allowed", &Why::allowed,
                    "N bools: whether each motion was, at the last choice there.")
      .def_readonly("value", &Why::value, "N values: Q_B of each motion.")
      .def_readonly("options", &Why::options,
                    "An OptionView each, in the order in which they were made.")
      .def_readonly("running", &Why::running,
                    "Events of the options under way, the outermost first.")
      .def("__str__", py::overload_cast<const Why&>(&to_text))
      .def("__repr__", [](const py::object& self) {
        return py::str("<devlearn.SalientEventsExplanation: situation {}, options {}>")
            .format(self.attr("situation"), self.attr("options"));
      });
  def_result(why, &Why::situation, &Why::allowed, &Why::value, &Why::options, &Why::running);
}

}  // namespace

void bind_salient_events(py::module_& m) {
  bind_explanation_of_salient_events(m);
  def_value_agent<SalientEvents>(
      m, "SalientEvents",
      "Skills from salient events (Singh, Barto & Chentanez 2004): an option for each event, "
      "which\n"
      "is rewarding in itself while the option's model does not foresee it. Epsilon-greedy over\n"
      "motions and options.")
      .def_property_readonly(
          "events", [](const SalientEvents& self) { return readable(self).events(); },
          "The events for which there is an option, in the order in which they first came.")
      .def_property_readonly(
          "intrinsic_reward",
          [](const SalientEvents& self) { return readable(self).intrinsic_reward(); },
          "Intrinsic reward of the last outcome, r_i.")
      .def(
          "explain",
          [](const SalientEvents& self, Whole<SituationTag> situation) {
            return readable(self).explain(situation.value);
          },
          py::arg("situation"),
          "What it makes of a situation, a SalientEventsExplanation; None for one never met. Draws "
          "and changes nothing. Raises InvalidValue.");
}

}  // namespace devlearn::python
