#pragma once

#include "devlearn/detail/cpp17.hpp"

namespace devlearn {

/// e^x by a fixed sequence of IEEE operations, within 1 ulp of the true value. Unlike the C
/// library's, its last bits are the same on every machine, whatever instructions it has.
double exponential(double x) noexcept;

/// A unit vector.
struct Direction {
  double x = 1.0;  ///< the heading's cosine
  double y = 0.0;  ///< the heading's sine
};

/// The unit vector of a heading [degrees, counter-clockwise from the x axis], by fixed operations
/// too: reduction to [-45, 45] degrees is exact, so multiples of 90 degrees are exact.
Direction direction(double heading) noexcept;

/// The reverse: the heading of a vector of any length but 0 [degrees], in [0, 360), to a few units
/// in the last place; exactly a whole number of degrees where direction() made the vector of one.
double heading_of(Direction vector) noexcept;

/// The heading brought into [0, 360) degrees; exact for every finite heading.
double wrapped_heading(double heading) noexcept;

}  // namespace devlearn
