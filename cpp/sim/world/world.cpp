#include "devlearn/world.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "devlearn/math.hpp"
#include "json.hpp"
#include "world/geometry.hpp"
#include "world/simple_polygon.hpp"
#include "world/surfaces.hpp"

namespace devlearn {
namespace {

constexpr double kLeastSide = 0.5, kGreatestSide = 1000.0;  // of the arena [m]
constexpr double kFurthest = 1e5;  // of its origin from 0 [m]; beyond, rounding would show
constexpr double kLeastSize = 0.01, kGreatestSize = 1000.0;  // of an obstacle [m]
constexpr double kLeastSpacing = 0.01;                       // of corners [m]; Box2D bears no less
constexpr double kLeastArea = 1e-4;                          // of a polygon [m^2]
// What is a centimetre in decimals is one, whatever its corners were rounded to [m, m^2].
constexpr double kRounding = 1e-9;
constexpr std::size_t kMostObstacles = 100'000;
constexpr std::size_t kMostCorners = 100'000;  // of a polygon
constexpr std::size_t kMostCornersInAll = 1'000'000;
constexpr std::size_t kLongestText = 10'000;  // name and description [bytes]

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
double doubled_area(const std::vector<Point>& corners) {
  double sum = 0.0;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    sum += cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  }
  return sum;
}

std::vector<Point> counter_clockwise(std::vector<Point> corners) {
  if (doubled_area(corners) < 0.0) std::reverse(corners.begin(), corners.end());
  return corners;
}

std::vector<Point> corners_of(const Rectangle& rectangle) {
  const Direction along = direction(rectangle.angle);
  const double w = 0.5 * rectangle.width, h = 0.5 * rectangle.height;
  const auto corner = [&](double u, double v) {
    return Point{rectangle.center.x + (u * along.x - v * along.y),
                 rectangle.center.y + (u * along.y + v * along.x)};
  };
  return {corner(-w, -h), corner(w, -h), corner(w, h), corner(-w, h)};
}

// Some formats end a ring with its first corner.
void open_rings(std::vector<Obstacle>& obstacles) {
  for (Obstacle& obstacle : obstacles) {
    auto* const polygon = std::get_if<Polygon>(&obstacle);
    if (polygon == nullptr) continue;
    std::vector<Point>& corners = polygon->corners;
    if (corners.size() > 3 && corners.front() == corners.back()) corners.pop_back();
  }
}

void require_simple(const std::string& quantity, const std::vector<Point>& corners) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double gap = distance(corners[i], corners[(i + 1) % n]);
    if (!(gap >= kLeastSpacing - kRounding)) {
      throw InvalidValue(indexed(quantity, (i + 1) % n), to_text(gap) + " m from the corner before",
                         "corners at least " + to_text(kLeastSpacing) + " m apart");
    }
  }
  if (const auto contact = SelfContact(corners).find()) {
    throw InvalidValue(quantity,
                       "edges from corners " + std::to_string(contact->first) + " and " +
                           std::to_string(contact->second) + " that cross or touch",
                       "an outline that neither crosses nor touches itself");
  }
  const double area = 0.5 * std::abs(doubled_area(corners));
  if (!(area >= kLeastArea - kRounding)) {
    throw InvalidValue(quantity, "an area of " + to_text(area) + " m^2",
                       "at least " + to_text(kLeastArea) + " m^2");
  }
}

void require_point(const std::string& quantity, Point p) {
  require_finite(indexed(quantity, 0), p.x);
  require_finite(indexed(quantity, 1), p.y);
}

void require_corners(const std::string& quantity, std::size_t count) {
  if (count >= 3 && count <= kMostCorners) return;
  throw InvalidValue(quantity, std::to_string(count) + " corners",
                     "3 to " + std::to_string(kMostCorners) + " corners");
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
    const std::string quantity = name_ + ".corners";
    const std::size_t count = polygon.corners.size();
    require_corners(quantity, count);
    corners_in_all_ += count;
    if (corners_in_all_ > kMostCornersInAll) {
      throw InvalidValue("obstacles", std::to_string(corners_in_all_) + " or more corners",
                         "at most " + std::to_string(kMostCornersInAll) + " corners in all");
    }
    for (std::size_t i = 0; i < count; ++i) {
      require_near(indexed(quantity, i), polygon.corners[i], def_);
    }
    require_simple(quantity, polygon.corners);
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
  const WorldDef& def_;
  std::string name_;
  std::size_t corners_in_all_ = 0;
};

void require_place(const World& world, const std::string& quantity, Point p) {
  const Point low = world.def().origin, high = world.def().far_corner();
  require_in(quantity + ".x", p.x, low.x, high.x, "m");
  require_in(quantity + ".y", p.y, low.y, high.y, "m");
  if (!(world.clearance(p) > 0.0)) {
    throw InvalidValue(quantity, text_of(p) + ", in an obstacle", "a point outside every obstacle");
  }
}

void require_start(const World& world) {
  const Pose& start = world.def().start;
  require_place(world, "start", {start.x, start.y});
  require_finite("start.heading", start.heading);
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
  require_corners(name + ".corners", corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    require_point(indexed(name + ".corners", i), corners[i]);
  }
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

  std::vector<std::vector<Point>> outlines;
  std::vector<Circle> circles;
  for (const Obstacle& obstacle : def_->obstacles) {
    if (const auto* circle = std::get_if<Circle>(&obstacle)) {
      circles.push_back(*circle);
    } else if (const auto* rectangle = std::get_if<Rectangle>(&obstacle)) {
      outlines.push_back(corners_of(*rectangle));
    } else {
      outlines.push_back(counter_clockwise(std::get<Polygon>(obstacle).corners));
    }
  }
  surfaces_ = std::make_shared<Surfaces>(Box{def_->origin, def_->far_corner()}, std::move(outlines),
                                         std::move(circles));

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

double World::wall_distance(Point p) const noexcept { return surfaces_->wall_distance(p); }

double World::clearance(Point point, bool walls_count) const noexcept {
  const double obstacles = surfaces_->distance(point);
  return walls_count ? std::min(obstacles, wall_distance(point)) : obstacles;
}

}  // namespace devlearn
