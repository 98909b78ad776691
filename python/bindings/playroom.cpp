#include "devlearn/playroom.hpp"

#include "tasks.hpp"

namespace devlearn::python {
namespace {

py::tuple pair_of(const Playroom::Square& square) {
  return py::make_tuple(square.row, square.column);
}

// The names of what is numbered from 0, in their order.
template <typename Named>
py::tuple names(int count) {
  py::tuple names(count);
  for (int i = 0; i < count; ++i) names[i] = Playroom::name(static_cast<Named>(i));
  return names;
}

py::dict squares_of(const Playroom& self) {
  const Playroom::State& state = self.state();
  py::dict squares;
  squares["eye"] = pair_of(state.eye);
  squares["hand"] = pair_of(state.hand);
  squares["marker"] = pair_of(state.marker);
  for (int i = 0; i < Playroom::kObjects; ++i) {
    const auto object = static_cast<Playroom::Object>(i);
    squares[Playroom::name(object)] = pair_of(state.objects[object]);
  }
  return squares;
}

}  // namespace

void bind_playroom(py::module_& m) {
  auto cls = def_task<Playroom>(
      m, "Playroom",
      "The playroom of Singh, Barto & Chentanez (2004): 5 x 5 squares, a light switch, a ball, a\n"
      "bell, a blue and a red block that turn music on and off, and a toy monkey, which cries "
      "where\n"
      "the bell rang in the dark with music on. The agent has an eye, a hand and a marker, and "
      "senses\n"
      "what is in their squares, light, music and ringing. Motions, events and objects are "
      "numbered\n"
      "as in MOTIONS, EVENTS and OBJECTS.");
  cls.attr("MOTIONS") = names<Playroom::Motion>(Playroom::kMotions);
  cls.attr("EVENTS") = names<Playroom::Event>(Playroom::kEvents);
  cls.attr("OBJECTS") = names<Playroom::Object>(Playroom::kObjects);
  cls.def_property_readonly(
         "squares", [](const Playroom& self) { return squares_of(idle(self, "Playroom")); },
         "Where the eye, the hand, the marker and each object are, by name: (row, column), each 0 "
         "... 4, row 0 in the north. Before an episode all are (0, 0).")
      .def_property_readonly(
          "counts",
          [](const Playroom& self) {
            py::dict counts;
            for (int i = 0; i < Playroom::kEvents; ++i) {
              const auto event = static_cast<Playroom::Event>(i);
              counts[Playroom::name(event)] = idle(self, "Playroom").counts()[event];
            }
            return counts;
          },
          "How often each event came in the episode, by name.")
      .def_property_readonly(
          "light", [](const Playroom& self) { return idle(self, "Playroom").state().light; },
          "Whether it is light.")
      .def_property_readonly(
          "music", [](const Playroom& self) { return idle(self, "Playroom").state().music; },
          "Whether there is music.");
}

}  // namespace devlearn::python
