#pragma once

#include "devlearn/world.hpp"

/// A world in which the golden trials touch nothing, so that their history is the same whatever
/// Box2D does.
inline devlearn::World open_world() {
  devlearn::WorldDef def;
  def.name = "open";
  def.width = def.height = 12.0;
  def.start = {5.0, 5.0, 0.0};
  def.target = {6.5, 6.0};
  def.obstacles = {devlearn::Circle{{4.6, 6.8}, 0.2},
                   devlearn::Rectangle{{8.0, 4.2}, 0.4, 0.2, 30.0},
                   devlearn::Polygon{{{8.5, 7.5}, {9.5, 7.4}, {8.9, 8.2}}}};
  return devlearn::World(def);
}
