#include "devlearn/world.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "devlearn/math.hpp"
#include "json.hpp"
#include "world/geometry.hpp"
#include "world/movers.hpp"
#include "world/simple_polygon.hpp"
#include "world/surfaces.hpp"

namespace devlearn {
namespace {

constexpr double kLeastSide = 0.5, kGreatestSide = 1000.0;  // of the arena [m]
constexpr double kFurthest = 1e5;  // of its origin from 0 [m]; beyond, rounding would show
constexpr double kLeastSize = 0.01, kGreatestSize = 1000.0;  // of an obstacle [m]
constexpr double kLeastSpacing = 0.01;                       // of corners [m]; Box2D bears no less
constexpr double kLeastArea = 1e-4;                          // of a polygon or hole [m^2]
// What is a centimetre in decimals is one, whatever its corners were rounded to [m, m^2].
constexpr double kRounding = 1e-9;
constexpr std::size_t kMostObstacles = 100'000;
constexpr std::size_t kMostPoints = 100'000;  // of an outline, a hole or a thin wall
constexpr std::size_t kMostPointsInAll = 1'000'000;
constexpr std::size_t kMostMovers = 1000;
constexpr std::size_t kMostPathPoints = 10'000;                // of a mover
constexpr double kGreatestSpeed = 1.0;                         // of a mover [m/s]
constexpr double kLeastLegTime = 0.1, kGreatestLegTime = 1e6;  // of a mover's walk [s]
constexpr std::size_t kLongestText = 10'000;                   // name and description [bytes]

std::string text_of(Point p) { return "(" + to_text(p.x) + ", " + to_text(p.y) + ")"; }

std::string indexed(const std::string& list, std::size_t index) {
  return list + "[" + std::to_string(index) + "]";
}

void require_text(const std::string& quantity, const std::string& text) {
  if (text.size() > kLongestText) {
    throw InvalidValue(quantity, std::to_string(text.size()) + " bytes",
                       "at most " + std::to_string(kLongestText) + " bytes");
  }
  if (!json::is_utf8(text)) throw InvalidValue(quantity, "other bytes", "UTF-8 text");
}

// Obstacles may stick out of the arena, but not lie anywhere.
void require_near(const std::string& quantity, Point p, const WorldDef& def) {
  const auto require = [&](int axis, double value, double from, double side) {
    const double least = from - side, greatest = from + 2.0 * side;
    if (value >= least && value <= greatest) return;
    throw InvalidValue(indexed(quantity, static_cast<std::size_t>(axis)), to_text(value),
                       "in [" + to_text(least) + ", " + to_text(greatest) +
                           "] m, the arena enlarged by its own size on each side");
  };
  require(0, p.x, def.origin.x, def.width);
  require(1, p.y, def.origin.y, def.height);
}

// Twice the area enclosed, positive for corners in counter-clockwise order.
double doubled_area(const Ring& corners) {
  double sum = 0.0;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    sum += cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  }
  return sum;
}

Ring turning(Ring corners, bool counter_clockwise) {
  if ((doubled_area(corners) > 0.0) != counter_clockwise) {
    std::reverse(corners.begin(), corners.end());
  }
  return corners;
}

Ring corners_of(const Rectangle& rectangle) {
  const Direction along = direction(rectangle.angle);
  const double w = 0.5 * rectangle.width, h = 0.5 * rectangle.height;
  const auto corner = [&](double u, double v) {
    return Point{rectangle.center.x + (u * along.x - v * along.y),
                 rectangle.center.y + (u * along.y + v * along.x)};
  };
  return {corner(-w, -h), corner(w, -h), corner(w, h), corner(-w, h)};
}

// A polygon's outline, then its holes.
std::vector<Ring> rings_of(const Polygon& polygon) {
  std::vector<Ring> rings{turning(polygon.corners, true)};
  for (const Ring& hole : polygon.holes) rings.push_back(turning(hole, false));
  return rings;
}

// Along a thin wall there and back, or around it on either side.
std::vector<Ring> rings_of(const Polyline& polyline) {
  Ring there = polyline.points, back(there.rbegin(), there.rend());
  if (there.front() == there.back()) {
    there.pop_back();
    back.pop_back();
    return {there, back};
  }
  there.insert(there.end(), back.begin() + 1, back.end() - 1);
  return {there};
}

// Some formats end a ring with its first corner.
void open_rings(std::vector<Obstacle>& obstacles) {
  const auto open = [](Ring& corners) {
    if (corners.size() > 3 && corners.front() == corners.back()) corners.pop_back();
  };
  for (Obstacle& obstacle : obstacles) {
    auto* const polygon = std::get_if<Polygon>(&obstacle);
    if (polygon == nullptr) continue;
    open(polygon->corners);
    std::for_each(polygon->holes.begin(), polygon->holes.end(), open);
  }
}

void require_spaced(const std::string& quantity, std::size_t index, Point before, Point here) {
  const double gap = distance(before, here);
  if (gap >= kLeastSpacing - kRounding) return;
  throw InvalidValue(indexed(quantity, index), to_text(gap) + " m from the one before",
                     "neighbours at least " + to_text(kLeastSpacing) + " m apart");
}

// A polygon's outline or one of its holes, as its file names it.
struct NamedRing {
  std::string name;
  const Ring* corners;
};

std::vector<NamedRing> named_rings(const std::string& name, const Polygon& polygon) {
  std::vector<NamedRing> rings{{name + ".corners", &polygon.corners}};
  for (std::size_t i = 0; i < polygon.holes.size(); ++i) {
    rings.push_back({indexed(name + ".holes", i), &polygon.holes[i]});
  }
  return rings;
}

void require_simple(const std::vector<NamedRing>& rings) {
  std::vector<const Ring*> corners;
  corners.reserve(rings.size());
  for (const NamedRing& ring : rings) corners.push_back(ring.corners);
  RingSweep sweep(corners);
  const char* const kHole = "a hole inside the outline, apart from it and from other holes";
  if (const auto contact = sweep.contact()) {
    const auto [first, second] = *contact;
    const std::string& name = rings[second.ring].name;
    if (first.ring == second.ring) {
      throw InvalidValue(name,
                         "edges from corners " + std::to_string(first.corner) + " and " +
                             std::to_string(second.corner) + " that cross or touch",
                         "an outline that neither crosses nor touches itself");
    }
    throw InvalidValue(name,
                       "an edge from corner " + std::to_string(second.corner) +
                           " that crosses or touches the one from corner " +
                           std::to_string(first.corner) + " of " + rings[first.ring].name,
                       kHole);
  }
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const double area = 0.5 * std::abs(doubled_area(*rings[i].corners));
    if (!(area >= kLeastArea - kRounding)) {
      throw InvalidValue(rings[i].name, "an area of " + to_text(area) + " m^2",
                         "at least " + to_text(kLeastArea) + " m^2");
    }
    const auto around = sweep.around(i);
    if (i == 0 || around == std::size_t{0}) continue;
    throw InvalidValue(rings[i].name,
                       around ? "a hole in " + rings[*around].name : "a hole outside the outline",
                       kHole);
  }
}

void require_point(const std::string& quantity, Point p) {
  require_finite(indexed(quantity, 0), p.x);
  require_finite(indexed(quantity, 1), p.y);
}

void require_number(const std::string& quantity, std::size_t count, std::size_t least,
                    const std::string& of) {
  if (count >= least && count <= kMostPoints) return;
  throw InvalidValue(quantity, std::to_string(count) + of,
                     std::to_string(least) + " to " + std::to_string(kMostPoints) + of);
}
void require_corners(const std::string& quantity, std::size_t count) {
  require_number(quantity, count, 3, " corners");
}
void require_points(const std::string& quantity, std::size_t count) {
  require_number(quantity, count, 2, " points");
}

// Adds up what the obstacles hold while checking them one by one.
class ObstacleCheck {
 public:
  explicit ObstacleCheck(const WorldDef& def) : def_(def) {}

  void operator()(const Circle& circle) const {
    require_near(name_ + ".center", circle.center, def_);
    circle.validate(name_);
  }
  void operator()(const Rectangle& rectangle) const {
    require_near(name_ + ".center", rectangle.center, def_);
    rectangle.validate(name_);
  }
  void operator()(const Polygon& polygon) {
    const std::vector<NamedRing> rings = named_rings(name_, polygon);
    for (const NamedRing& ring : rings) {
      require_corners(ring.name, ring.corners->size());
      add(ring.name, *ring.corners);
      require_spaced(ring.name, 0, ring.corners->back(), ring.corners->front());
    }
    require_simple(rings);
  }
  void operator()(const Polyline& polyline) {
    require_points(name_ + ".points", polyline.points.size());
    add(name_ + ".points", polyline.points);
  }

  void check_all() {
    if (def_.obstacles.size() > kMostObstacles) {
      throw InvalidValue("obstacles", std::to_string(def_.obstacles.size()) + " obstacles",
                         "at most " + std::to_string(kMostObstacles) + " obstacles");
    }
    for (std::size_t i = 0; i < def_.obstacles.size(); ++i) {
      name_ = indexed("obstacles", i);
      std::visit(*this, def_.obstacles[i]);
    }
  }

 private:
  void add(const std::string& quantity, const std::vector<Point>& points) {
    points_in_all_ += points.size();
    if (points_in_all_ > kMostPointsInAll) {
      throw InvalidValue("obstacles",
                         std::to_string(points_in_all_) + " or more corners and points",
                         "at most " + std::to_string(kMostPointsInAll) + " in all");
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      require_near(indexed(quantity, i), points[i], def_);
      if (i > 0) require_spaced(quantity, i, points[i - 1], points[i]);
    }
  }

  const WorldDef& def_;
  std::string name_;
  std::size_t points_in_all_ = 0;
};

// What surfaces are made of, sorted.
struct Shapes {
  std::vector<std::vector<Ring>> outlines;
  std::vector<Ring> thin_walls;
  std::vector<Circle> circles;

  void operator()(const Circle& circle) { circles.push_back(circle); }
  void operator()(const Rectangle& rectangle) { outlines.push_back({corners_of(rectangle)}); }
  void operator()(const Polygon& polygon) { outlines.push_back(rings_of(polygon)); }
  void operator()(const Polyline& polyline) {
    for (Ring& ring : rings_of(polyline)) thin_walls.push_back(std::move(ring));
  }
};

void require_place(const World& world, const std::string& quantity, Point p) {
  const Point low = world.def().origin, high = world.def().far_corner();
  require_in(quantity + ".x", p.x, low.x, high.x, "m");
  require_in(quantity + ".y", p.y, low.y, high.y, "m");
  if (!(world.surfaces().distance(p) > 0.0)) {
    throw InvalidValue(quantity, text_of(p) + ", in an obstacle", "a point outside every obstacle");
  }
}

// Rounds begin there at any time.
void require_start(const World& world) {
  const Pose& start = world.def().start;
  require_place(world, "start", {start.x, start.y});
  require_finite("start.heading", start.heading);
  for (std::size_t i = 0; i < world.movers().size(); ++i) {
    if (world.movers().distance_ever(i, {start.x, start.y}) > 0.0) continue;
    throw InvalidValue(indexed("movers", i),
                       "a course that leads over the start, " + text_of({start.x, start.y}),
                       "one that keeps clear of it, as a round may begin at any time");
  }
}

// Where a mover's centre may be; an arena has no hollows, so neither is the way between two points.
void require_course(const std::string& name, const MoverPath& path, const WorldDef& def) {
  const Point low = def.origin, high = def.far_corner();
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const std::string quantity = indexed(name + ".path.points", i);
    require_in(indexed(quantity, 0), path.points[i].x, low.x, high.x, "m");
    require_in(indexed(quantity, 1), path.points[i].y, low.y, high.y, "m");
  }
}
void require_course(const std::string& name, const MoverWalk& walk, const WorldDef& def) {
  const Point low = def.origin, high = def.far_corner();
  for (const auto& [corner, p] : {std::pair{".walk.low", walk.low}, {".walk.high", walk.high}}) {
    require_in(indexed(name + corner, 0), p.x, low.x, high.x, "m");
    require_in(indexed(name + corner, 1), p.y, low.y, high.y, "m");
  }
}

void require_movers(const WorldDef& def) {
  if (def.movers.size() > kMostMovers) {
    throw InvalidValue("movers", std::to_string(def.movers.size()) + " movers",
                       "at most " + std::to_string(kMostMovers) + " movers");
  }
  for (std::size_t i = 0; i < def.movers.size(); ++i) {
    const std::string name = indexed("movers", i);
    def.movers[i].validate(name);
    std::visit([&](const auto& course) { require_course(name, course, def); },
               def.movers[i].course);
  }
}

}  // namespace

void Circle::validate(const std::string& name) const {
  require_point(name + ".center", center);
  require_in(name + ".radius", radius, kLeastSize, kGreatestSize, "m");
}

void Rectangle::validate(const std::string& name) const {
  require_point(name + ".center", center);
  require_in(name + ".size[0]", width, kLeastSize, kGreatestSize, "m");
  require_in(name + ".size[1]", height, kLeastSize, kGreatestSize, "m");
  require_in(name + ".angle", angle, -360.0, 360.0, "degrees");
}

void Polygon::validate(const std::string& name) const {
  for (const NamedRing& ring : named_rings(name, *this)) {
    require_corners(ring.name, ring.corners->size());
    for (std::size_t i = 0; i < ring.corners->size(); ++i) {
      require_point(indexed(ring.name, i), (*ring.corners)[i]);
    }
  }
}

void Polyline::validate(const std::string& name) const {
  require_points(name + ".points", points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    require_point(indexed(name + ".points", i), points[i]);
  }
}

void MoverPath::validate(const std::string& name) const {
  const std::string quantity = name + ".points";
  if (points.size() < 2 || points.size() > kMostPathPoints) {
    throw InvalidValue(quantity, std::to_string(points.size()) + " points",
                       "2 to " + std::to_string(kMostPathPoints) + " points");
  }
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) require_point(indexed(quantity, i), points[i]);
  for (std::size_t i = then == Then::kAround ? 0 : 1; i < n; ++i) {
    const double gap = distance(points[(i + n - 1) % n], points[i]);
    if (gap >= kLeastSpacing - kRounding) continue;
    throw InvalidValue(indexed(quantity, i), to_text(gap) + " m from the point before",
                       "points at least " + to_text(kLeastSpacing) + " m apart");
  }
  require_above(name + ".speed", speed, 0.0, kGreatestSpeed, "m/s");
}

void MoverWalk::validate(const std::string& name) const {
  require_point(name + ".low", low);
  require_point(name + ".high", high);
  if (!(low.x <= high.x && low.y <= high.y)) {
    throw InvalidValue(name + ".high", text_of(high),
                       "no less than low, " + text_of(low) + ", in x and in y");
  }
  const double least = distance(low, high) / kGreatestSpeed;
  require_in(name + ".leg_time", leg_time, kLeastLegTime, kGreatestLegTime, "s");
  if (leg_time < least) {
    throw InvalidValue(name + ".leg_time", to_text(leg_time),
                       "at least " + to_text(least) + " s, what the box's diagonal takes at " +
                           to_text(kGreatestSpeed) + " m/s");
  }
}

void Mover::validate(const std::string& name) const {
  std::visit(
      [&](const auto& of) {
        of.validate(name);
        if (of.center == Point{}) return;
        throw InvalidValue(name + ".center", text_of(of.center),
                           "(0, 0): the mover's course says where it is");
      },
      shape);
  if (const auto* const path = std::get_if<MoverPath>(&course)) path->validate(name + ".path");
  if (const auto* const walk = std::get_if<MoverWalk>(&course)) walk->validate(name + ".walk");
}

World::World(WorldDef def) {
  open_rings(def.obstacles);
  def_ = std::make_shared<WorldDef>(std::move(def));
  require_text("name", def_->name);
  require_text("description", def_->description);
  require_in("arena.width", def_->width, kLeastSide, kGreatestSide, "m");
  require_in("arena.height", def_->height, kLeastSide, kGreatestSide, "m");
  require_in("arena.origin[0]", def_->origin.x, -kFurthest, kFurthest, "m");
  require_in("arena.origin[1]", def_->origin.y, -kFurthest, kFurthest, "m");
  ObstacleCheck(*def_).check_all();
  require_movers(*def_);

  Shapes shapes;
  for (const Obstacle& obstacle : def_->obstacles) std::visit(shapes, obstacle);
  surfaces_ = std::make_shared<Surfaces>(Box{def_->origin, def_->far_corner()}, shapes.outlines,
                                         shapes.thin_walls, std::move(shapes.circles));
  movers_ = std::make_shared<Movers>(def_->movers);
  moves_ = !def_->movers.empty();

  require_start(*this);
  devlearn::require_place(*this, "target", def_->target);
}

World World::with_start(const Pose& start) const {
  WorldDef moved = *def_;
  moved.start = start;
  World world = *this;
  world.def_ = std::make_shared<WorldDef>(std::move(moved));
  require_start(world);
  return world;
}

World World::standing() const {
  WorldDef still = *def_;
  still.movers.clear();
  World world = *this;
  world.def_ = std::make_shared<WorldDef>(std::move(still));
  world.movers_ = std::make_shared<Movers>(world.def_->movers);
  world.moves_ = false;
  return world;
}

double World::wall_distance(Point p) const noexcept { return surfaces_->wall_distance(p); }

double World::clearance(Point point, bool walls_count, double time) const noexcept {
  double least = surfaces_->distance(point);
  if (walls_count) least = std::min(least, wall_distance(point));
  if (!moves_) return least;
  return std::min(least, std::max(0.0, movers_->distance(point, time)));
}

std::vector<Obstacle> World::movers_at(double time) const {
  std::vector<Obstacle> there;
  for (std::size_t i = 0; i < movers_->size(); ++i) {
    std::visit(
        [&](auto shape) {
          shape.center = movers_->place(i, time);
          there.emplace_back(shape);
        },
        movers_->shape(i));
  }
  return there;
}

}  // namespace devlearn
