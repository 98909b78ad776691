#pragma once

#include <box2d/b2_math.h>

#include "devlearn/world.hpp"

namespace devlearn {

inline b2Vec2 vector(Point p) noexcept {
  return {static_cast<float>(p.x), static_cast<float>(p.y)};
}

}  // namespace devlearn
