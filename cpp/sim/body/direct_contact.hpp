#pragma once

#include <optional>

#include "body/contact.hpp"

namespace devlearn {

/// What drive_in_box2d gives among what stands still, to the bit: Box2D's own operations for the
/// contacts of a disc that does not turn, in the order in which it solves them, without a world and
/// its bookkeeping. Nothing where the Box2D at hand is not the one that this follows, or where
/// devlearn was built with DEVLEARN_DIRECT_CONTACTS off.
std::optional<Drive> drive_directly(const Scene& scene, int iterations);

/// Whether drives are solved so.
bool solves_directly();

}  // namespace devlearn
