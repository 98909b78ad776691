#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <queue>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "devlearn/math.hpp"
#include "devlearn/random.hpp"
#include "devlearn/world.hpp"
#include "excerpt.hpp"
#include "world/fine_direction.hpp"
#include "world/surfaces.hpp"

// Worlds drawn by chance: by fixed operations only, so that they are the same on every machine.
namespace devlearn {
namespace {

constexpr double kSide = 5.0;        // of every arena [m]
constexpr double kMiddling = 0.5;    // the difficulty that goes without saying
constexpr double kThickness = 0.08;  // of walls [m]
constexpr double kPi = 3.14159265358979323846;

// What goes from one value at difficulty 0 evenly to another at difficulty 1.
double graded(double easy, double hard, double difficulty) {
  return easy + (hard - easy) * difficulty;
}
int graded(int easy, int hard, double difficulty) {
  return easy + static_cast<int>(std::lround((hard - easy) * difficulty));
}

double between(Random& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

// The point at (u, v) in axes of which the first is `along`.
Point turned(double u, double v, const Direction& along) {
  return {u * along.x - v * along.y, u * along.y + v * along.x};
}

// --- a way -------------------------------------------------------------------------------------

// Whether the paper's robot gets from the start to within 0.1 m of the target without touching
// anything: a search over its own poses, nearest to the target first. What it says is there, is.
class WaySearch {
 public:
  explicit WaySearch(const World& world) : world_(world) {}

  bool finds_one() {
    const Pose& start = world_.def().start;
    if (!(world_.clearance({start.x, start.y}, true) > kRoom)) return false;
    reach(start);
    while (!open_.empty()) {
      const auto [left, index] = open_.top();
      if (left <= kGoal) return true;
      open_.pop();
      const Pose from = poses_[index];
      for (int turn = -60; turn <= 60; turn += 30) {
        const double heading = wrapped_heading(from.heading + turn);
        const Direction ahead = direction(heading);
        const Pose to{from.x + kStep * ahead.x, from.y + kStep * ahead.y, heading};
        if (world_.surfaces().keep_clear_of({from.x, from.y}, {to.x, to.y}, kRoom)) reach(to);
      }
    }
    return false;
  }

 private:
  static constexpr double kRoom = 0.12;  // the body's radius, Box2D's skin around it, and a little
  static constexpr double kStep = 0.05, kGoal = 0.1;
  static constexpr double kCell = 0.05;  // poses in one, with the same heading, count as one
  static constexpr auto kCells = static_cast<std::size_t>(kSide / kCell) + 1;

  void reach(const Pose& pose) {
    const auto cell = [](double x) { return static_cast<std::size_t>(x / kCell); };
    const auto heading = static_cast<std::size_t>(std::lround(pose.heading / 30.0)) % 12;
    const std::size_t here = (cell(pose.y) * kCells + cell(pose.x)) * 12 + heading;
    if (reached_[here]) return;
    reached_[here] = true;
    open_.emplace(distance({pose.x, pose.y}, world_.def().target), poses_.size());
    poses_.push_back(pose);
  }

  using Open = std::pair<double, std::size_t>;  // distance to the target, and which pose
  const World& world_;
  std::vector<Pose> poses_;
  std::vector<bool> reached_ = std::vector<bool>(kCells * kCells * 12);
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open_;
};

bool has_way(const WorldDef& def) { return WaySearch(World(def)).finds_one(); }

// Where the obstacles leave no way, leaves out those that close it.
void keep_a_way(WorldDef& def) {
  if (has_way(def)) return;
  const std::vector<Obstacle> drawn = std::exchange(def.obstacles, {});
  for (const Obstacle& obstacle : drawn) {
    def.obstacles.push_back(obstacle);
    if (!has_way(def)) def.obstacles.pop_back();
  }
}

// --- obstacles here and there ------------------------------------------------------------------

// Places by chance, each with room of its own: a gap between their discs, and from start and
// target.
class Places {
 public:
  Places(const WorldDef& def, double gap) : gap_(gap) {
    add({def.start.x, def.start.y}, kOwnRoom);
    add(def.target, kOwnRoom);
  }

  bool free(Point center, double radius) const {
    return std::all_of(taken_.begin(), taken_.end(), [&](const Circle& other) {
      return distance(center, other.center) >= radius + other.radius + gap_;
    });
  }
  void add(Point center, double radius) { taken_.push_back({center, radius}); }

  // A free place for a disc, its middle so far from the walls. Where none is found the last drawn
  // has to do.
  Point draw(Random& random, double radius, double off_walls = 0.0) {
    Point center;
    for (int tries = 0; tries < kMostTries; ++tries) {
      center.x = between(random, off_walls, kSide - off_walls);
      center.y = between(random, off_walls, kSide - off_walls);
      if (free(center, radius)) break;
    }
    add(center, radius);
    return center;
  }

 private:
  static constexpr double kOwnRoom = 0.2;  // of start and target [m]
  static constexpr int kMostTries = 10'000;
  double gap_;
  std::vector<Circle> taken_;
};

// The obstacles of Fig. 2, as in the world "paper".
std::vector<Obstacle> papers_obstacles() {
  return {Circle{{1.3, 1.4}, 0.25},
          Rectangle{{2.5, 0.9}, 0.6, 0.35, 0.0},
          Polygon{{{3.6, 1.1}, {4.2, 1.3}, {3.7, 1.7}}},
          Rectangle{{1.0, 2.8}, 0.35, 0.7, 0.0},
          Circle{{2.4, 2.3}, 0.3},
          Polygon{{{3.2, 2.7}, {3.9, 2.6}, {3.5, 3.2}}},
          Rectangle{{2.2, 3.9}, 0.8, 0.3, 0.0},
          Circle{{3.4, 4.2}, 0.2}};
}

// The middle of an obstacle, and the radius of a disc around it that holds the obstacle.
Circle disc_around(const Obstacle& obstacle) {
  if (const auto* circle = std::get_if<Circle>(&obstacle)) return *circle;
  if (const auto* rectangle = std::get_if<Rectangle>(&obstacle)) {
    const double w = rectangle->width, h = rectangle->height;
    return {rectangle->center, std::sqrt(w * w + h * h) / 2};
  }
  Circle disc;
  const std::vector<Point>& corners = std::get<Polygon>(obstacle).corners;
  for (const Point& corner : corners) {
    disc.center.x += corner.x;
    disc.center.y += corner.y;
  }
  disc.center.x /= static_cast<double>(corners.size());
  disc.center.y /= static_cast<double>(corners.size());
  for (const Point& corner : corners) {
    disc.radius = std::max(disc.radius, distance(corner, disc.center));
  }
  return disc;
}

// The obstacle with its middle elsewhere, turned by an angle in [0, 360) degrees.
Obstacle moved(const Obstacle& obstacle, Point to, double angle) {
  if (const auto* circle = std::get_if<Circle>(&obstacle)) return Circle{to, circle->radius};
  if (const auto* rectangle = std::get_if<Rectangle>(&obstacle)) {
    return Rectangle{to, rectangle->width, rectangle->height, rectangle->angle + angle};
  }
  const Point from = disc_around(obstacle).center;
  const Direction along = fine_direction(angle * (kPi / 180.0));
  Polygon polygon = std::get<Polygon>(obstacle);
  for (Point& corner : polygon.corners) {
    const Point arm = corner - from;
    corner = {to.x + along.x * arm.x - along.y * arm.y, to.y + along.y * arm.x + along.x * arm.y};
  }
  return polygon;
}

WorldDef similar(Random& random, double difficulty) {
  constexpr const char* kCounts[] = {"Four", "Five", "Six",    "Seven", "Eight",
                                     "Nine", "Ten",  "Eleven", "Twelve"};
  const int count = graded(4, 12, difficulty);
  WorldDef def;
  def.description = std::string(kCounts[count - 4]) +
                    " obstacles with the sizes of the paper's, placed at random.";
  def.start = {0.51, 0.515, 0.0};
  def.target = {4.4, 4.4};
  Places places(def, graded(0.5, 0.2, difficulty));
  const std::vector<Obstacle> originals = papers_obstacles();
  for (int i = 0; i < count; ++i) {
    const Obstacle& original = originals[static_cast<std::size_t>(i) % originals.size()];
    const Point place = places.draw(random, disc_around(original).radius);
    def.obstacles.push_back(moved(original, place, random.uniform() * 360.0));
  }
  return def;
}

WorldDef clutter(Random& random, double difficulty) {
  const int count = graded(20, 60, difficulty);
  WorldDef def;
  def.description = std::to_string(count) + " small obstacles, placed at random.";
  Places places(def, graded(0.3, 0.2, difficulty));
  for (int i = 0; i < count; ++i) {
    const double size = between(random, 0.06, 0.16);
    const Point center = places.draw(random, size);
    const double angle = between(random, 0.0, 360.0);
    const auto sides = random.index(6);
    if (sides < 2) {
      def.obstacles.push_back(Circle{center, size});
    } else if (sides < 4) {  // of which the diagonal is the disc's
      const Direction half = direction(between(random, 20.0, 70.0));
      def.obstacles.push_back(Rectangle{center, 2.0 * size * half.x, 2.0 * size * half.y, angle});
    } else {
      Polygon polygon;
      const auto corners = 3 + random.index(3);
      for (unsigned k = 0; k < corners; ++k) {
        const Direction arm = direction(angle + 360.0 * (k + between(random, -0.2, 0.2)) / corners);
        polygon.corners.push_back({center.x + size * arm.x, center.y + size * arm.y});
      }
      def.obstacles.push_back(polygon);
    }
  }
  return def;
}

WorldDef traps(Random& random, double difficulty) {
  const int count = graded(1, 4, difficulty);
  const double depth = graded(0.5, 1.0, difficulty), width = graded(0.8, 1.0, difficulty);
  WorldDef def;
  def.description = "U-shaped pockets that open towards the start: " + std::to_string(count) + ".";
  Places places(def, 0.2);
  const double radius = 0.5 * std::sqrt(depth * depth + width * width);
  for (int i = 0; i < count; ++i) {
    Point center{0.5 * kSide, 0.5 * kSide};  // the first in the way as the crow flies
    if (i == 0) {
      center.x += between(random, -0.3, 0.3);
      center.y += between(random, -0.3, 0.3);
      places.add(center, radius);
    } else {
      center = places.draw(random, radius, radius);
    }
    // From start to target at 45 degrees; the pocket's bottom is ahead, its sides left and right.
    const Direction ahead = direction(45.0 + between(random, -25.0, 25.0));
    const double out = 0.5 * depth, in = out - kThickness;
    const double side = 0.5 * width, inside = side - kThickness;
    Polygon polygon;
    for (const Point p : {Point{-out, -side},
                          {out, -side},
                          {out, side},
                          {-out, side},
                          {-out, inside},
                          {in, inside},
                          {in, -inside},
                          {-out, -inside}}) {
      const Point arm = turned(p.x, p.y, ahead);
      polygon.corners.push_back({center.x + arm.x, center.y + arm.y});
    }
    def.obstacles.push_back(polygon);
  }
  return def;
}

// --- walls -------------------------------------------------------------------------------------

// A wall along an axis: at `at` on the other axis, from `from` to `to`.
struct Wall {
  bool upright = false;  // along y
  double at = 0.0, from = 0.0, to = 0.0;

  Rectangle rectangle() const {
    const double middle = 0.5 * (from + to), length = to - from;
    return upright ? Rectangle{{at, middle}, kThickness, length, 0.0}
                   : Rectangle{{middle, at}, length, kThickness, 0.0};
  }
};

// A maze without loops over square cells, dug from the first, going straight where it can as often
// as not: so passages are long.
class Maze {
 public:
  Maze(Random& random, int size) : size_(size), passages_(static_cast<std::size_t>(size * size)) {
    std::vector<int> way{0}, came{kFirst};  // cells, and by which direction each was dug
    passages_[0].dug = true;
    while (!way.empty()) {
      const int cell = way.back(), straight = came.back();
      std::vector<int> directions;
      for (int d = 0; d < 4; ++d) {
        const int next = neighbour(cell, d);
        if (next >= 0 && !at(next).dug) directions.push_back(d);
      }
      if (directions.empty()) {
        way.pop_back();
        came.pop_back();
        continue;
      }
      const bool ahead =
          std::find(directions.begin(), directions.end(), straight) != directions.end();
      int d = straight;
      if (!ahead || random.uniform() < 0.5) {
        d = directions[random.index(static_cast<std::uint32_t>(directions.size()))];
      }
      const int next = neighbour(cell, d);
      at(cell).open[d] = at(next).open[(d + 2) % 4] = at(next).dug = true;
      way.push_back(next);
      came.push_back(d);
    }
  }

  // The walls between the cells, each in one piece where it goes on.
  std::vector<Wall> walls(double cell) const {
    std::vector<Wall> walls;
    for (const bool upright : {true, false}) {
      for (int line = 1; line < size_; ++line) {
        for (int begin = 0; begin < size_;) {
          int end = begin;
          while (end < size_ && closed(upright, line, end)) ++end;
          if (end > begin) {
            // Half a thickness more on both sides fills the corners.
            walls.push_back({upright, line * cell, begin * cell - 0.5 * kThickness,
                             end * cell + 0.5 * kThickness});
          }
          begin = end + 1;
        }
      }
    }
    return walls;
  }

 private:
  static constexpr int kFirst = 0;  // directions: along x, along y, and back
  struct Passages {
    bool dug = false;
    bool open[4] = {};
  };

  const Passages& at(int cell) const { return passages_[static_cast<std::size_t>(cell)]; }
  Passages& at(int cell) { return passages_[static_cast<std::size_t>(cell)]; }
  int neighbour(int cell, int d) const {
    const int column = cell % size_ + (d == 0) - (d == 2), row = cell / size_ + (d == 1) - (d == 3);
    const bool inside = column >= 0 && column < size_ && row >= 0 && row < size_;
    return inside ? row * size_ + column : -1;
  }
  // Whether a wall stands on a line between cells, beside the cells of that number along it.
  bool closed(bool upright, int line, int along) const {
    return upright ? !at(along * size_ + line - 1).open[0]
                   : !at((line - 1) * size_ + along).open[1];
  }

  int size_;
  std::vector<Passages> passages_;
};

WorldDef corridors(Random& random, double difficulty) {
  const int size = graded(4, 8, difficulty);
  const double cell = kSide / size;
  WorldDef def;
  def.description = "Corridors without a loop, " + std::to_string(size) + " side by side.";
  def.start = {0.5 * cell, 0.5 * cell, 0.0};
  def.target = {kSide - 0.5 * cell, kSide - 0.5 * cell};
  for (const Wall& wall : Maze(random, size).walls(cell)) {
    def.obstacles.push_back(wall.rectangle());
  }
  return def;
}

// Where a door of that width can be in a wall: off its ends and off the walls that end at it.
double door_in(Random& random, const Wall& wall, const std::vector<Wall>& walls, double width) {
  const double room = 0.5 * (width + kThickness) + 0.01;
  double middle = 0.0;
  for (int tries = 0; tries < 1000; ++tries) {
    middle = between(random, wall.from + room, wall.to - room);
    const bool free = std::all_of(walls.begin(), walls.end(), [&](const Wall& other) {
      const bool ends_here =
          other.upright != wall.upright && (other.from == wall.at || other.to == wall.at);
      return !ends_here || std::abs(other.at - middle) >= room;
    });
    if (free) break;
  }
  return middle;
}

// Divides the largest room in two until there are enough, then puts a door into every wall: so all
// rooms hang together, whichever way round.
WorldDef rooms(Random& random, double difficulty) {
  struct Room {
    Point low, high;
    double area() const { return (high.x - low.x) * (high.y - low.y); }
    Point middle() const { return {0.5 * (low.x + high.x), 0.5 * (low.y + high.y)}; }
  };
  const int count = graded(4, 12, difficulty);
  const double door = graded(0.8, 0.4, difficulty);
  std::vector<Room> rooms{{{0.0, 0.0}, {kSide, kSide}}};
  std::vector<Wall> walls;
  while (rooms.size() < static_cast<std::size_t>(count)) {
    const auto largest =
        std::max_element(rooms.begin(), rooms.end(),
                         [](const Room& a, const Room& b) { return a.area() < b.area(); });
    const auto [low, high] = *largest;
    Room beyond = *largest;
    const double part = between(random, 0.35, 0.65);
    if (high.x - low.x > high.y - low.y) {
      const double x = low.x + part * (high.x - low.x);
      walls.push_back({true, x, low.y, high.y});
      largest->high.x = beyond.low.x = x;
    } else {
      const double y = low.y + part * (high.y - low.y);
      walls.push_back({false, y, low.x, high.x});
      largest->high.y = beyond.low.y = y;
    }
    rooms.push_back(beyond);
  }

  WorldDef def;
  def.description = std::to_string(count) + " rooms, one door in every wall.";
  for (const Room& room : rooms) {
    if (room.low == Point{0.0, 0.0}) def.start = {room.middle().x, room.middle().y, 0.0};
    if (room.high == Point{kSide, kSide}) def.target = room.middle();
  }
  for (const Wall& wall : walls) {
    const double middle = door_in(random, wall, walls, door);
    Wall before = wall, after = wall;
    before.to = middle - 0.5 * door;
    after.from = middle + 0.5 * door;
    def.obstacles.push_back(before.rectangle());
    def.obstacles.push_back(after.rectangle());
  }
  return def;
}

struct Kind {
  const char* name;
  WorldDef (*draw)(Random&, double difficulty);
};
constexpr Kind kKinds[] = {{"similar", similar},
                           {"clutter", clutter},
                           {"corridors", corridors},
                           {"rooms", rooms},
                           {"traps", traps}};

const Kind& kind_of(const std::string& name) {
  std::string known;
  for (const Kind& kind : kKinds) {
    if (name == kind.name) return kind;
    known.append(known.empty() ? "one of " : ", ").append(kind.name);
  }
  throw InvalidValue("kind", excerpt(name), known);
}

}  // namespace

World World::random(const std::string& kind, std::uint64_t seed, double difficulty) {
  const Kind& drawn = kind_of(kind);
  require_in("difficulty", difficulty, 0.0, 1.0);
  Random random(seed, kind + " world");
  WorldDef def = drawn.draw(random, difficulty);
  def.name = kind + " " + std::to_string(seed);
  if (difficulty != kMiddling) def.name += ", difficulty " + to_text(difficulty);
  keep_a_way(def);
  return World(std::move(def));
}

}  // namespace devlearn
