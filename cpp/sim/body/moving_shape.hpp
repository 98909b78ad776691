#pragma once

#include <box2d/b2_circle_shape.h>
#include <box2d/b2_polygon_shape.h>

#include <variant>

#include "body/box2d_vector.hpp"
#include "devlearn/math.hpp"
#include "devlearn/world.hpp"

namespace devlearn {

/// What moves, as Box2D has it: solid, its centre at 0.
using MovingShape = std::variant<b2CircleShape, b2PolygonShape>;

inline MovingShape moving_shape(const Circle& circle) {
  b2CircleShape shape;
  shape.m_radius = static_cast<float>(circle.radius);
  return shape;
}
inline MovingShape moving_shape(const Rectangle& rectangle) {
  b2PolygonShape shape;
  shape.SetAsBox(static_cast<float>(0.5 * rectangle.width),
                 static_cast<float>(0.5 * rectangle.height));
  // Turned by our own sine, which is the same on every machine.
  const Direction side = direction(rectangle.angle);
  b2Rot turn;
  turn.c = static_cast<float>(side.x);
  turn.s = static_cast<float>(side.y);
  for (int i = 0; i < shape.m_count; ++i) {
    shape.m_vertices[i] = b2Mul(turn, shape.m_vertices[i]);
    shape.m_normals[i] = b2Mul(turn, shape.m_normals[i]);
  }
  return shape;
}
inline MovingShape moving_shape(const std::variant<Circle, Rectangle>& shape) {
  return std::visit([](const auto& of) { return moving_shape(of); }, shape);
}

inline const b2Shape& as_shape(const MovingShape& shape) {
  return std::visit([](const auto& of) -> const b2Shape& { return of; }, shape);
}

}  // namespace devlearn
