#include "devlearn/attention.hpp"

#include <utility>
#include <vector>

#include "tasks.hpp"

namespace devlearn::python {

void bind_attention(py::module_& m) {
  def_task<Attention>(
      m, "Attention",
      "A room with a robot on two wheels, which can sound, and a toy (Oudeyer, Kaplan & Hafner\n"
      "2007, section VI). A motion is (l, r, f), the speeds of both wheels in [-1, 1] and the\n"
      "frequency of a sound in [0, 1]; what is sensed is the distance to the toy, with noise [m].\n"
      "A situation is so many tenths of the room's side of it, the last one all beyond.\n"
      "Below 1/3 of f the toy goes anywhere, below 2/3 it stays, else it jumps to the robot. "
      "Nothing\n"
      "is to be reached, and a step costs nothing: what matters is where attention goes.")
      .def_property_readonly(
          "motors",
          [](const Attention& self) {
            return moved_array<double>(std::vector<double>(self.motors().values),
                                       {self.motion_count(), self.motors().columns});
          },
          "A copy of the matrix of (l, r, f), a row a motion; f varies fastest.")
      .def(
          "zone",
          [](const Attention& self, Whole<MotionTag> motion) {
            return static_cast<int>(self.zone(motion.value));
          },
          py::arg("motion"),
          "What the toy does at a motion: 0, it goes anywhere; 1, it stays; 2, it jumps to the "
          "robot. Raises InvalidValue.")
      .def_property_readonly(
          "robot", [](const Attention& self) { return idle(self, "Attention").robot(); },
          "Where the robot is: a Pose [m, m, degrees].")
      .def_property_readonly(
          "toy", [](const Attention& self) { return idle(self, "Attention").toy(); },
          "Where the toy is [m].")
      .def_property_readonly(
          "distance", [](const Attention& self) { return idle(self, "Attention").distance(); },
          "Between them, as it is sensed [m].");
}

}  // namespace devlearn::python
