#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "devlearn/situation.hpp"

namespace devlearn {

/// A round obstacle.
struct Circle {
  Point center;         ///< [m]
  double radius = 0.0;  ///< in [0.01, 1000] m

  /// Throws InvalidValue, naming `name`.radius and so on, unless its numbers lie in their ranges.
  void validate(const std::string& name) const;
};

/// A rectangle at any angle.
struct Rectangle {
  Point center;         ///< [m]
  double width = 0.0;   ///< along its own x axis, in [0.01, 1000] m
  double height = 0.0;  ///< along its own y axis, in [0.01, 1000] m
  double angle = 0.0;   ///< of its own x axis, counter-clockwise, in [-360, 360] degrees

  /// Likewise.
  void validate(const std::string& name) const;
};

/// Any simple polygon, convex or not, its corners in either direction of turning; in its holes it
/// is free to stand.
struct Polygon {
  std::vector<Point> corners;  ///< at least 3, no two neighbours closer than 0.01 m
  /// Each such a polygon inside the outline, apart from it and from the others.
  std::vector<std::vector<Point>> holes = {};

  /// Likewise of their number and their numbers; a World sees to what they make together.
  void validate(const std::string& name) const;
};

/// A wall of no thickness from point to point, which may cross itself; it is closed if it ends
/// where it begins.
struct Polyline {
  std::vector<Point> points;  ///< at least 2, no two neighbours closer than 0.01 m

  /// Likewise.
  void validate(const std::string& name) const;
};

using Obstacle = std::variant<Circle, Rectangle, Polygon, Polyline>;

/// A way along points, at one speed.
struct MoverPath {
  /// What comes after the last point.
  enum class Then : std::uint8_t {
    kBack,    ///< the same way back to the first, and so on
    kAround,  ///< straight to the first, and around again
    kStop,    ///< nothing: it stays there
  };
  static constexpr const char* kThens[] = {"back", "around", "stop"};  ///< by these names in files
  std::vector<Point> points;  ///< 2 to 10 000, no two neighbours closer than 0.01 m
  double speed = 0.1;         ///< in (0, 1] m/s
  Then then = Then::kBack;

  /// Throws InvalidValue, naming `name`.speed and so on, unless its numbers lie in their ranges.
  void validate(const std::string& name) const;
};

/// A walk by random waypoints: every leg_time a new point, uniform in a box; straight and evenly
/// from one to the next.
struct MoverWalk {
  std::uint64_t seed = 0;  ///< of the points
  Point low;               ///< the box's corner of least x and y
  Point high;              ///< and that of greatest
  /// From point to point, in [0.1, 1e6] s; at least what the box's diagonal takes at 1 m/s.
  double leg_time = 10.0;

  /// Likewise.
  void validate(const std::string& name) const;
};

/// An obstacle that moves, and does not turn: its centre goes along a path or a walk, from time 0
/// on.
struct Mover {
  std::variant<Circle, Rectangle> shape;      ///< its center (0, 0): the course says where it is
  std::variant<MoverPath, MoverWalk> course;  ///< all of it in the arena, and clear of the start

  /// Likewise of both.
  void validate(const std::string& name) const;
};

/// What a world is made of. Centres, corners and points lie in the arena enlarged by its own size
/// on each side; limits on numbers are in docs/world-format.md.
struct WorldDef {
  std::string name;           ///< for people
  std::string description;    ///< for people
  double width = 5.0;         ///< the arena's side along x, in [0.5, 1000] m
  double height = 5.0;        ///< the arena's side along y, in [0.5, 1000] m
  Point origin;               ///< the arena's corner of least x and y, each within 100 km of 0
  Pose start{0.5, 0.5, 0.0};  ///< inside the arena, outside every obstacle
  Point target{4.5, 4.5};     ///< inside the arena, outside every obstacle
  std::vector<Obstacle> obstacles;  ///< they may overlap each other and the walls
  std::vector<Mover> movers;        ///< they go through obstacles, walls and each other

  /// The arena's corner of greatest x and y.
  Point far_corner() const noexcept { return {origin.x + width, origin.y + height}; }
};

class Movers;
class Surfaces;

/// An arena with walls, obstacles, a start and a target: checked once, then unchanging. Where
/// movers are is a pure function of time [s], which counts from 0 to 1e9; earlier is as at 0, later
/// as at the end.
class World {
 public:
  /// Throws InvalidValue, naming the field as a world file would (`obstacles[2].radius`).
  explicit World(WorldDef def = {});
  ///@{
  /// A copy costs nothing; there is no move, so that no world is ever empty.
  World(const World&) = default;
  World& operator=(const World&) = default;
  ///@}

  /// A world of 5 m x 5 m drawn by chance, the same on every machine; the robot of the paper has a
  /// way from start to target. kind: "similar" (to Fig. 2), "clutter", "corridors", "rooms" or
  /// "traps". difficulty in [0, 1]: what it means for each kind is in docs/worlds.md. Throws
  /// InvalidValue.
  static World random(const std::string& kind, std::uint64_t seed, double difficulty = 0.5);

  /// The world in a file (the format is in docs/world-format.md and world.schema.json). Throws
  /// FileError, naming file and field.
  static World load(const std::string& path);
  /// The same from JSON text; `source` stands for the file's name in errors.
  static World parse(const std::string& json, const std::string& source = "JSON text");

  /// JSON text that parses back to an equal world, to the bit.
  std::string to_json() const;
  /// Writes to_json() to a file: to the side first, then renamed. Throws FileError.
  void save(const std::string& path) const;

  const WorldDef& def() const noexcept { return *def_; }  ///< as given

  /// The same world with another start. Throws InvalidValue.
  World with_start(const Pose& start) const;
  /// The same world without its movers.
  World standing() const;

  /// d_o: least distance from a point to an obstacle's surface at a time, 0 inside one, infinite
  /// where there is no obstacle; with `walls_count` the arena's walls count too. [m], exact in
  /// closed form.
  double clearance(Point point, bool walls_count = false, double time = 0.0) const noexcept;

  /// Whether it has movers.
  bool moves() const noexcept { return moves_; }
  /// The movers where they are at a time, as obstacles that stand there.
  std::vector<Obstacle> movers_at(double time) const;

  /// Least distance from a point to the arena's walls, 0 outside [m].
  double wall_distance(Point point) const noexcept;

  /// What a body in it can touch: an internal, which may change with any version.
  const Surfaces& surfaces() const noexcept { return *surfaces_; }
  /// Likewise, of what moves.
  const Movers& movers() const noexcept { return *movers_; }

 private:
  // Copies share them.
  std::shared_ptr<const WorldDef> def_;
  std::shared_ptr<const Surfaces> surfaces_;
  std::shared_ptr<const Movers> movers_;
  bool moves_ = false;  // at hand, as every step asks
};

}  // namespace devlearn
