#pragma once

#include <optional>

#include "body/contact.hpp"

namespace devlearn {

/// What drive_in_box2d gives, to the bit, where the body touches a single surface: Box2D's own
/// operations for one contact of a disc that does not turn, without a world and its bookkeeping.
/// Nothing where the body touches several, or where the Box2D at hand is not the one that this
/// follows, or where devlearn was built with DEVLEARN_DIRECT_CONTACTS off.
std::optional<Drive> drive_directly(const Scene& scene, int iterations);

/// Whether drives along a single surface are solved so.
bool solves_directly();

}  // namespace devlearn
