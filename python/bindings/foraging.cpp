#include "devlearn/foraging.hpp"

#include "bindings.hpp"
#include "tasks.hpp"

namespace devlearn::python {

void bind_foraging(py::module_& m) {
  def_task<Foraging>(
      m, "Foraging",
      "The foraging scenarios of Sequeira, Melo & Paiva (2011; 2014), as in their published "
      "program: a\nfox in a small grid world, which sees where it is and what is there, and "
      "nothing else. Motions:\nup, down, left, right, and among lairs eat and open; against a wall "
      "or the fence it stays. A\nsituation is 16 times the cell, numbered row by row, walls too, "
      "and what is there. The event of\na step is 0 if a prey was eaten. An episode has no end of "
      "its own.")
      .def(
          "drawn", [](const Foraging& self) { return idle(self, "Task").drawn(); },
          "The grid, a line a row: # a wall, F the fox, h a hare, r a rabbit, w water, = the "
          "fence, "
          "o a\nlair that is closed, O one with its rabbit out, . one that is empty. Raises "
          "InvalidValue where no\nepisode is under way.");
}

}  // namespace devlearn::python
