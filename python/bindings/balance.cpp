#include "devlearn/balance.hpp"

#include <array>

#include "tasks.hpp"

namespace devlearn::python {
namespace {

using Four = std::array<double, 4>;

BalanceState state_of(const Four& numbers) {
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

}  // namespace

void bind_balance(py::module_& m) {
  def_config<TwoWheeledDef>(
      m,
      "A two-wheeled robot that balances. The defaults are those of NXTway-GS, a robot of LEGO\n"
      "Mindstorms NXT (Y. Yamamoto 2009).");
  def_task<Balance>(
      m, "Balance",
      "A two-wheeled robot learns to stand. An episode begins at rest, at an angle drawn; it ends\n"
      "where the angle passes the limit, a fall, or when the robot has stood for the duration. A\n"
      "motion is a torque, held for a sample time. Situations are intervals of angle, of its rate\n"
      "and of the wheels' rate. With u = psi + T_1 psi' + T_2 theta', a lean that looks ahead, "
      "SEF\n"
      "is -sef_scale (u / angle_limit)^2, and SMF its growth, at most -1 for a fall. A fall costs\n"
      "fall_cost, other steps nothing; the estimate is 1 before the end. Senses: angle [degrees],\n"
      "its rate [degrees/s], the wheels' angle, by which they have rolled, and its rate.")
      .def(
          "begin_at",
          [](Balance& self, const Four& state) { idle(self, "Balance").begin_at(state_of(state)); },
          py::arg("state"),
          "An episode begins in this state, four numbers as the senses. Raises InvalidValue for "
          "numbers that are not finite, and for an angle beyond the limit.")
      .def_property_readonly(
          "state",
          [](Balance& self) {
            const BalanceState now = idle(self, "Balance").state();
            const Four numbers{now.angle, now.rate, now.wheel, now.wheel_rate};
            return py::array_t<double>(4, numbers.data());
          },
          "Four numbers as the senses, after the end, too.")
      .def_property_readonly(
          "time", [](Balance& self) { return idle(self, "Balance").time(); },
          "Since the episode began [s].")
      .def(
          "situation_of",
          [](const Balance& self, const Four& state) { return self.situation_of(state_of(state)); },
          py::arg("state"), "Which situation a state is, four numbers as the senses.")
      .def(
          "sef_of",
          [](const Balance& self, const Four& state) { return self.sef_of(state_of(state)); },
          py::arg("state"), "SEF of a state, four numbers as the senses.");
}

}  // namespace devlearn::python
