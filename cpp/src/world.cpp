#include "devlearn/world.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "devlearn/error.hpp"
#include "devlearn/math.hpp"
#include "geometry.hpp"
#include "simple_polygon.hpp"
#include "world_text.hpp"

namespace devlearn {
namespace {

constexpr double kLeastSide = 0.5, kGreatestSide = 1000.0;   // of the arena [m]
constexpr double kLeastSize = 0.01, kGreatestSize = 1000.0;  // of an obstacle [m]
constexpr double kLeastSpacing = 0.01;                       // of corners [m]; Box2D bears no less
constexpr double kLeastArea = 1e-4;                          // of a polygon [m^2]
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
  if (!is_utf8(text)) throw InvalidValue(quantity, "other bytes", "UTF-8 text");
}

// Obstacles may stick out of the arena, but not lie anywhere.
void require_near(const std::string& quantity, Point p, const WorldDef& def) {
  const auto require = [&](int axis, double value, double side) {
    if (value >= -side && value <= 2.0 * side) return;
    throw InvalidValue(indexed(quantity, static_cast<std::size_t>(axis)), to_text(value),
                       "in [" + to_text(-side) + ", " + to_text(2.0 * side) +
                           "] m, the arena enlarged by its own size on each side");
  };
  require(0, p.x, def.width);
  require(1, p.y, def.height);
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

void require_simple(const std::string& quantity, const std::vector<Point>& corners) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double gap = distance(corners[i], corners[(i + 1) % n]);
    if (!(gap >= kLeastSpacing)) {
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
  if (!(area >= kLeastArea)) {
    throw InvalidValue(quantity, "an area of " + to_text(area) + " m^2",
                       "at least " + to_text(kLeastArea) + " m^2");
  }
}

// Adds up what the obstacles hold while checking them one by one.
class ObstacleCheck {
 public:
  explicit ObstacleCheck(const WorldDef& def) : def_(def) {}

  void operator()(const Circle& circle) const {
    require_near(name_ + ".center", circle.center, def_);
    require_in(name_ + ".radius", circle.radius, kLeastSize, kGreatestSize, "m");
  }
  void operator()(const Rectangle& rectangle) const {
    require_near(name_ + ".center", rectangle.center, def_);
    require_in(name_ + ".size[0]", rectangle.width, kLeastSize, kGreatestSize, "m");
    require_in(name_ + ".size[1]", rectangle.height, kLeastSize, kGreatestSize, "m");
    require_in(name_ + ".angle", rectangle.angle, -360.0, 360.0, "degrees");
  }
  void operator()(const Polygon& polygon) {
    const std::string quantity = name_ + ".corners";
    const std::size_t count = polygon.corners.size();
    if (count < 3 || count > kMostCorners) {
      throw InvalidValue(quantity, std::to_string(count) + " corners",
                         "3 to " + std::to_string(kMostCorners) + " corners");
    }
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
  require_in(quantity + ".x", p.x, 0.0, world.def().width, "m");
  require_in(quantity + ".y", p.y, 0.0, world.def().height, "m");
  if (!(world.clearance(p) > 0.0)) {
    throw InvalidValue(quantity, text_of(p) + ", in an obstacle", "a point outside every obstacle");
  }
}

void require_start(const World& world) {
  const Pose& start = world.def().start;
  require_place(world, "start", {start.x, start.y});
  require_finite("start.heading", start.heading);
}

Circle bound_of(const std::vector<Point>& corners) {
  const auto [left, right] = std::minmax_element(corners.begin(), corners.end(),
                                                 [](Point a, Point b) { return a.x < b.x; });
  const auto [bottom, top] = std::minmax_element(corners.begin(), corners.end(),
                                                 [](Point a, Point b) { return a.y < b.y; });
  Circle bound{{0.5 * (left->x + right->x), 0.5 * (bottom->y + top->y)}, 0.0};
  for (const Point& corner : corners) {
    bound.radius = std::max(bound.radius, distance(bound.center, corner));
  }
  return bound;
}

// Whether a bounding circle, so far off (squared), can hold nothing nearer than `least`; the
// margin exceeds every rounding error, so leaving the circle out never changes a result.
bool out_of_reach(double squared, double bound_radius, double least) {
  constexpr double kMargin = 1e-9;
  const double reach = least + bound_radius + kMargin;
  return squared > reach * reach;
}

// Calls f(a, b) for each side of an outline.
template <typename F>
void for_each_side(const std::vector<Point>& corners, F f) {
  Point a = corners.back();
  for (const Point& b : corners) {
    f(a, b);
    a = b;
  }
}

// Whether a ray from p along the x axis crosses the side a-b.
bool crosses_ray(Point p, Point a, Point b) {
  return (a.y > p.y) != (b.y > p.y) && (cross(b - a, p - a) > 0.0) == (b.y > a.y);
}

double outline_distance(const std::vector<Point>& corners, Point p) {
  double least = std::numeric_limits<double>::infinity();
  bool inside = false;
  for_each_side(corners, [&](Point a, Point b) {
    least = std::min(least, squared_distance(p, a, b));
    if (crosses_ray(p, a, b)) inside = !inside;
  });
  return inside ? 0.0 : std::sqrt(least);
}

double swept_outline_distance(const std::vector<Point>& corners, Point p, Point q) {
  double least = std::numeric_limits<double>::infinity();
  bool inside = false;
  for_each_side(corners, [&](Point a, Point b) {
    const bool parted = (cross(b - a, p - a) > 0.0) == (cross(b - a, q - a) > 0.0) ||
                        (cross(q - p, a - p) > 0.0) == (cross(q - p, b - p) > 0.0);
    least = parted ? std::min({least, squared_distance(p, a, b), squared_distance(q, a, b),
                               squared_distance(a, p, q), squared_distance(b, p, q)})
                   : 0.0;
    if (crosses_ray(p, a, b)) inside = !inside;
  });
  return inside ? 0.0 : std::sqrt(least);
}

double wall_distance(const WorldDef& def, Point p) {
  return std::max(0.0, std::min({p.x, def.width - p.x, p.y, def.height - p.y}));
}

}  // namespace

World::World(WorldDef def) : def_(std::move(def)) {
  require_text("name", def_.name);
  require_text("description", def_.description);
  require_in("arena.width", def_.width, kLeastSide, kGreatestSide, "m");
  require_in("arena.height", def_.height, kLeastSide, kGreatestSide, "m");
  ObstacleCheck(def_).check_all();

  const auto add_edges = [this](const std::vector<Point>& corners) {
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < n; ++i) {
      edges_.push_back(
          {corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n], corners[(i + 2) % n]});
    }
  };
  // Clockwise, since walls are solid on the outside.
  add_edges({{0.0, 0.0}, {0.0, def_.height}, {def_.width, def_.height}, {def_.width, 0.0}});
  for (const Obstacle& obstacle : def_.obstacles) {
    if (const auto* circle = std::get_if<Circle>(&obstacle)) {
      circles_.push_back(*circle);
      continue;
    }
    const auto* rectangle = std::get_if<Rectangle>(&obstacle);
    std::vector<Point> corners =
        rectangle ? corners_of(*rectangle) : counter_clockwise(std::get<Polygon>(obstacle).corners);
    add_edges(corners);
    const Circle bound = bound_of(corners);
    outlines_.push_back({std::move(corners), bound});
  }

  require_start(*this);
  devlearn::require_place(*this, "target", def_.target);
}

World World::with_start(const Pose& start) const {
  World world = *this;
  world.def_.start = start;
  require_start(world);
  return world;
}

double World::clearance(Point point, bool walls_count) const noexcept {
  double least = walls_count ? wall_distance(def_, point) : std::numeric_limits<double>::infinity();
  for (const Circle& circle : circles_) {
    const double squared = squared_length(point - circle.center);
    if (out_of_reach(squared, circle.radius, least)) continue;
    least = std::min(least, std::max(0.0, std::sqrt(squared) - circle.radius));
  }
  for (const Outline& outline : outlines_) {
    const double squared = squared_length(point - outline.bound.center);
    if (out_of_reach(squared, outline.bound.radius, least)) continue;
    least = std::min(least, outline_distance(outline.corners, point));
  }
  return least;
}

double World::swept_clearance(Point a, Point b) const noexcept {
  double least = std::min(wall_distance(def_, a), wall_distance(def_, b));
  for (const Circle& circle : circles_) {
    const double squared = squared_distance(circle.center, a, b);
    if (out_of_reach(squared, circle.radius, least)) continue;
    least = std::min(least, std::max(0.0, std::sqrt(squared) - circle.radius));
  }
  for (const Outline& outline : outlines_) {
    const double squared = squared_distance(outline.bound.center, a, b);
    if (out_of_reach(squared, outline.bound.radius, least)) continue;
    least = std::min(least, swept_outline_distance(outline.corners, a, b));
  }
  return least;
}

}  // namespace devlearn
