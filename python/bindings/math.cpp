#include "devlearn/math.hpp"

#include <utility>

#include "bindings.hpp"
#include "devlearn/detail/require.hpp"

namespace devlearn::python {
namespace {

double finite_heading(double heading) {
  require_finite("heading", heading);
  return heading;
}

}  // namespace

void bind_math(py::module_& m) {
  m.def(
      "direction",
      [](double heading) {
        const Direction unit = direction(finite_heading(heading));
        return std::pair(unit.x, unit.y);
      },
      py::arg("heading"),
      "The unit vector (x, y) of a heading [degrees, counter-clockwise from the x axis]. Its last "
      "bits are the same on every machine; multiples of 90 degrees are exact. Raises InvalidValue "
      "unless the heading is finite.");
  m.def(
      "wrapped_heading", [](double heading) { return wrapped_heading(finite_heading(heading)); },
      py::arg("heading"),
      "The heading brought into [0, 360) degrees, exactly. Raises InvalidValue unless it is "
      "finite.");
  m.def("exponential", &exponential, py::arg("x"),
        "e**x within 1 ulp. Unlike math.exp its last bits are the same on every machine; inf where "
        "it overflows.");
}

}  // namespace devlearn::python
