#include "devlearn/shortest_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <utility>

#include "body/kinematics.hpp"
#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "devlearn/math.hpp"
#include "world/geometry.hpp"
#include "world/surfaces.hpp"

namespace devlearn {
namespace {

using Interrupt = std::function<bool()>;

// Of what has so many poses or cells a search gives up, or the flood has no more.
constexpr std::size_t kMost = std::size_t{1} << 22;
constexpr std::size_t kBetweenInterrupts = 4096;

// How far it is to the goal, at the least and whatever stands in the way.
class Goal {
 public:
  Goal(const Robot& robot, double start_heading, double radius)
      : target_(robot.world().def().target), radius_(radius), length_(step_length(robot.def())) {
    // Headings are the start's and turns of 360 / n degrees from it, if all motions are. A step
    // then leads to a corner of a regular polygon, several no further than its sides.
    for (int n = 1; n <= kMostHeadings; ++n) {
      const auto is_turn = [n](double angle) {
        return std::abs(angle * n / 360.0 - std::round(angle * n / 360.0)) < 1e-9;
      };
      const auto& angles = robot.def().steering_angles;
      if (!std::all_of(angles.begin(), angles.end(), is_turn)) continue;
      if (n < 3) return;
      const double half = 180.0 / n;
      inradius_ = direction(half).x;
      for (int side = 0; side < n; ++side) {
        const Direction out = direction(start_heading + (2 * side + 1) * half);
        sides_.push_back({out.x / inradius_, out.y / inradius_});
      }
      return;
    }
  }

  bool holds(const Pose& pose) const noexcept { return crow_flies(pose) <= 0.0; }

  // What steps along the headings there are make of a way, at the least [m].
  double driven(Point way) const noexcept {
    double least = std::sqrt(squared_length(way));
    for (const Point& side : sides_) least = std::max(least, dot(way, side));
    return least;
  }

  // Never more steps than there are. The hair is for rounding.
  std::int32_t least_steps(const Pose& pose) const noexcept {
    const Point way = target_ - Point{pose.x, pose.y};
    const double least = std::max(crow_flies(pose), driven(way) - radius_ / inradius_);
    return static_cast<std::int32_t>(std::max(0.0, std::ceil(least / length_ - 1e-9)));
  }

 private:
  static constexpr int kMostHeadings = 36;  // with more the polygon is as good as round

  double crow_flies(const Pose& pose) const noexcept {
    return distance({pose.x, pose.y}, target_) - radius_;
  }

  Point target_;
  double radius_, length_;
  double inradius_ = 1.0;
  std::vector<Point> sides_;  // normals, as long as a step to the corners is further than the sides
};

// Ways to the goal's disc over a grid: through every cell that may hold a place where the body
// fits, at a price through those where it does not fit in the middle.
class Flood {
 public:
  Flood(const Robot& robot, const Goal& goal, double goal_radius)
      : world_(robot.world()), length_(step_length(robot.def())), goal_radius_(goal_radius) {
    const WorldDef& def = world_.def();
    cell_ = std::max(0.5 * length_, std::sqrt(def.width * def.height / static_cast<double>(kMost)));
    columns_ = static_cast<std::int64_t>(def.width / cell_) + 1;
    rows_ = static_cast<std::int64_t>(def.height / cell_) + 1;
    room_ = free_room(robot.def());
    far_.assign(static_cast<std::size_t>(columns_ * rows_), kDry);
    for (int dy = -2; dy <= 2; ++dy) {
      for (int dx = -2; dx <= 2; ++dx) {
        const int long_side = std::max(std::abs(dx), std::abs(dy));
        const int short_side = std::min(std::abs(dx), std::abs(dy));
        if (long_side != 1 && (long_side != 2 || short_side != 1)) continue;
        // Back from the goal.
        const double way = goal.driven({-static_cast<double>(dx), -static_cast<double>(dy)});
        moves_.push_back({dx, dy, static_cast<std::int32_t>(std::lround(kUnit * way))});
      }
    }
  }

  // Until it has reached everything or, where given, a pose; false where it was interrupted.
  bool run(const Interrupt& interrupt, const Pose* until = nullptr) {
    const Point target = world_.def().target;
    const auto reach = static_cast<std::int64_t>(goal_radius_ / cell_) + 2;
    const std::int64_t middle = of(target), sought = until ? of({until->x, until->y}) : -1;
    for (std::int64_t row = middle / columns_ - reach; row <= middle / columns_ + reach; ++row) {
      for (std::int64_t column = middle % columns_ - reach; column <= middle % columns_ + reach;
           ++column) {
        if (!inside(column, row)) continue;
        if (distance(centre(column, row), target) > goal_radius_ + kHalfDiagonal * cell_) continue;
        wet(column, row, 0);
      }
    }
    std::size_t looked = 0;
    for (std::int32_t cost = 0; waiting_count_ > 0; ++cost) {
      std::vector<std::int64_t> now;
      now.swap(waiting_at(cost));
      waiting_count_ -= now.size();
      for (const std::int64_t cell : now) {
        if (far_[static_cast<std::size_t>(cell)] != cost) continue;  // reached at less cost since
        if (cell == sought) return true;
        if (++looked % kBetweenInterrupts == 0 && interrupt && interrupt()) return false;
        flow_from(cell % columns_, cell / columns_, cost);
      }
    }
    return true;
  }

  bool reaches(const Pose& pose) const noexcept { return far_at(pose) < kClosed; }

  // The corners of least x and y of the cells that it has reached, where in their middle the body
  // fits outside the goal.
  std::vector<Point> corners() const {
    std::vector<Point> corners;
    for (std::size_t i = 0; i < far_.size(); ++i) {
      const auto cell = static_cast<std::int64_t>(i);
      const Point middle = centre(cell % columns_, cell / columns_);
      if (far_[i] >= kClosed || room_at(middle) < room_) continue;
      if (distance(middle, world_.def().target) <= goal_radius_) continue;
      corners.push_back({middle.x - 0.5 * cell_, middle.y - 0.5 * cell_});
    }
    return corners;
  }
  double cell() const noexcept { return cell_; }

  // About so many steps from a pose along the flood: between the middles of four cells, where all
  // are reached.
  double steps(const Pose& pose) const noexcept {
    const Point origin = world_.def().origin;
    const double x = (pose.x - origin.x) / cell_ - 0.5, y = (pose.y - origin.y) / cell_ - 0.5;
    const auto column = static_cast<std::int64_t>(std::floor(x));
    const auto row = static_cast<std::int64_t>(std::floor(y));
    double cost = far_at(pose);
    if (inside(column, row) && inside(column + 1, row + 1)) {
      const std::int32_t* const low = &far_[static_cast<std::size_t>(row * columns_ + column)];
      const std::int32_t* const high = low + columns_;
      if (std::max({low[0], low[1], high[0], high[1]}) < kClosed) {
        const double u = x - static_cast<double>(column), v = y - static_cast<double>(row);
        cost =
            (1.0 - v) * (low[0] + u * (low[1] - low[0])) + v * (high[0] + u * (high[1] - high[0]));
      }
    }
    return cost * (cell_ / kUnit / length_);
  }

 private:
  struct Move {
    std::int32_t dx, dy, cost;
  };
  static constexpr std::int32_t kUnit = 20;          // of costs, a cell
  static constexpr std::int32_t kPrice = 2 * kUnit;  // of a cell where the body hardly fits
  static constexpr std::int32_t kMostCost = 3 * kUnit + kPrice;
  static constexpr double kHalfDiagonal = 0.7072;
  static constexpr std::int32_t kDry = std::numeric_limits<std::int32_t>::max();
  static constexpr std::int32_t kClosed = kDry - 1;  // no place there

  bool inside(std::int64_t column, std::int64_t row) const noexcept {
    return column >= 0 && column < columns_ && row >= 0 && row < rows_;
  }
  std::int64_t of(Point p) const noexcept {
    const Point origin = world_.def().origin;
    const auto along = [&](double x, std::int64_t count) {
      return std::clamp<std::int64_t>(static_cast<std::int64_t>(x / cell_), 0, count - 1);
    };
    return along(p.y - origin.y, rows_) * columns_ + along(p.x - origin.x, columns_);
  }
  Point centre(std::int64_t column, std::int64_t row) const noexcept {
    const Point origin = world_.def().origin;
    return {origin.x + (static_cast<double>(column) + 0.5) * cell_,
            origin.y + (static_cast<double>(row) + 0.5) * cell_};
  }
  std::int32_t& far(std::int64_t column, std::int64_t row) noexcept {
    return far_[static_cast<std::size_t>(row * columns_ + column)];
  }
  std::int32_t far_at(const Pose& pose) const noexcept {
    return far_[static_cast<std::size_t>(of({pose.x, pose.y}))];
  }
  std::vector<std::int64_t>& waiting_at(std::int32_t cost) {
    return waiting_[static_cast<std::size_t>(cost) % waiting_.size()];
  }

  void flow_from(std::int64_t column, std::int64_t row, std::int32_t cost) {
    for (const Move& move : moves_) {
      const std::int64_t c = column + move.dx, r = row + move.dy;
      if (!inside(c, r)) continue;
      // A knight's move passes between two cells, which have to be reached themselves.
      if (std::abs(move.dx) + std::abs(move.dy) == 3) {
        const std::int64_t x = move.dx / 2, y = move.dy / 2;
        if (far(column + x, row + y) >= kClosed ||
            far(column + move.dx - x, row + move.dy - y) >= kClosed) {
          continue;
        }
      }
      wet(c, r, cost + move.cost);
    }
  }
  void wet(std::int64_t column, std::int64_t row, std::int32_t cost) {
    std::int32_t& far = this->far(column, row);
    if (far == kClosed || far <= cost) return;
    // No point of the cell is further from everything than its centre by more than half of its
    // diagonal.
    const double room = room_at(centre(column, row));
    if (room < room_ - kHalfDiagonal * cell_) {
      far = kClosed;
      return;
    }
    if (room < room_) cost += kPrice;
    if (far <= cost) return;
    far = cost;
    waiting_at(cost).push_back(row * columns_ + column);
    ++waiting_count_;
  }
  // Below 0 beyond the walls, where the last cells reach.
  double room_at(Point p) const noexcept {
    const Point low = world_.def().origin, high = world_.def().far_corner();
    return std::min(
        {world_.surfaces().distance(p), p.x - low.x, p.y - low.y, high.x - p.x, high.y - p.y});
  }

  const World& world_;
  double length_, goal_radius_, cell_, room_;
  std::int64_t columns_, rows_;
  std::vector<Move> moves_;
  std::vector<std::int32_t> far_;
  // Cells by their cost, as far as costs can lie apart.
  std::vector<std::vector<std::int64_t>> waiting_ =
      std::vector<std::vector<std::int64_t>>(kMostCost + 1);
  std::size_t waiting_count_ = 0;
};

// Which poses count as one, and which of them were there.
class Closed {
 public:
  explicit Closed(const Robot& robot)
      : origin_(robot.world().def().origin), cell_(step_length(robot.def()) / 4.0) {
    const WorldDef& def = robot.world().def();
    const double cells = (def.width / cell_) * (def.height / cell_);
    if (!(cells <= 1e15)) {
      throw InvalidValue("shortest_path's cells", to_text(cells),
                         "at most 1e15: a smaller arena, or longer steps");
    }
    columns_ = static_cast<std::int64_t>(def.width / cell_) + 1;
  }

  bool holds(const Pose& pose) const noexcept {
    const std::int64_t key = of(pose);
    return slots_[slot(key)] == key;
  }
  // False where it was there already.
  bool insert(const Pose& pose) {
    const std::int64_t key = of(pose);
    std::int64_t& place = slots_[slot(key)];
    if (place == key) return false;
    place = key;
    if (2 * ++count_ > slots_.size()) grow();
    return true;
  }

 private:
  static constexpr std::int64_t kFree = -1;

  std::int64_t of(const Pose& pose) const noexcept {
    constexpr std::int64_t kHeadings = 360;
    const std::int64_t heading = std::llround(pose.heading) % kHeadings;
    const auto column = static_cast<std::int64_t>((pose.x - origin_.x) / cell_);
    const auto row = static_cast<std::int64_t>((pose.y - origin_.y) / cell_);
    return (row * columns_ + column) * kHeadings + heading;
  }
  // Where a key is, or would be.
  std::size_t slot(std::int64_t key) const noexcept {
    auto hash = static_cast<std::uint64_t>(key) * 0x9E3779B97F4A7C15U;
    std::size_t at = (hash ^ (hash >> 32)) & (slots_.size() - 1);
    while (slots_[at] != kFree && slots_[at] != key) at = (at + 1) & (slots_.size() - 1);
    return at;
  }
  void grow() {
    const std::vector<std::int64_t> before =
        std::exchange(slots_, std::vector<std::int64_t>(2 * slots_.size(), kFree));
    for (const std::int64_t key : before) {
      if (key != kFree) slots_[slot(key)] = key;
    }
  }

  Point origin_;
  double cell_;
  std::int64_t columns_ = 0;
  std::size_t count_ = 0;
  std::vector<std::int64_t> slots_ = std::vector<std::int64_t>(1024, kFree);
};

struct Node {
  Pose pose;
  std::int32_t parent;
  std::int32_t steps;
};

std::vector<Pose> way_to(std::int32_t index, const std::vector<Node>& nodes) {
  std::vector<Pose> way;
  for (std::int32_t i = index; i >= 0; i = nodes[static_cast<std::size_t>(i)].parent) {
    way.push_back(nodes[static_cast<std::size_t>(i)].pose);
  }
  std::reverse(way.begin(), way.end());
  return way;
}

// Nodes by the least number of steps that a way through them has; the last found go first.
class ByLeastSteps {
 public:
  explicit ByLeastSteps(const Goal& goal) : goal_(goal) {}

  void push(const Node& node, std::int32_t index) {
    const auto least = static_cast<std::size_t>(node.steps) +
                       static_cast<std::size_t>(goal_.least_steps(node.pose));
    // Rounding may put a step's bound below its parent's by one.
    const std::size_t at = std::max(least, least_);
    if (at >= open_.size()) open_.resize(at + 1);
    open_[at].push_back(index);
  }
  std::optional<std::int32_t> pop() {
    while (least_ < open_.size() && open_[least_].empty()) ++least_;
    if (least_ >= open_.size()) return std::nullopt;
    const std::int32_t index = open_[least_].back();
    open_[least_].pop_back();
    return index;
  }
  // No way that is still to be found is shorter.
  std::int64_t least() const noexcept { return static_cast<std::int64_t>(least_); }

 private:
  const Goal& goal_;
  std::vector<std::vector<std::int32_t>> open_;
  std::size_t least_ = 0;
};

// Nodes by where the flood says that they lead, with more weight than the way there.
class AlongFlood {
 public:
  AlongFlood(const Flood& flood, double weight) : flood_(flood), weight_(weight) {}

  void push(const Node& node, std::int32_t index) {
    if (!flood_.reaches(node.pose)) return;
    open_.emplace(-(node.steps + weight_ * flood_.steps(node.pose)), index);
  }
  std::optional<std::int32_t> pop() {
    if (open_.empty()) return std::nullopt;
    const std::int32_t index = open_.top().second;
    open_.pop();
    return index;
  }

 private:
  const Flood& flood_;
  double weight_;
  std::priority_queue<std::pair<double, std::int32_t>> open_;
};

enum class End { kFound, kNoWay, kGivenUp };

// From a pose through ever new cells, in the order of `open`.
template <typename Open>
End search(const Robot& robot, const Pose& start, const Goal& goal, const Interrupt& interrupt,
           Open& open, std::vector<Pose>& way) {
  const auto motions = static_cast<int>(robot.def().steering_angles.size());
  std::vector<Node> nodes{{start, -1, 0}};
  Closed closed(robot);
  open.push(nodes.front(), 0);
  for (std::size_t looked = 1;; ++looked) {
    const std::optional<std::int32_t> index = open.pop();
    if (!index) return End::kNoWay;
    const Node node = nodes[static_cast<std::size_t>(*index)];
    if (goal.holds(node.pose)) {
      way = way_to(*index, nodes);
      return End::kFound;
    }
    if (nodes.size() >= kMost) return End::kGivenUp;
    if (looked % kBetweenInterrupts == 0 && interrupt && interrupt()) return End::kGivenUp;
    if (!closed.insert(node.pose)) continue;
    for (int motion = 0; motion < motions; ++motion) {
      const std::optional<Pose> next = free_step(robot.world(), robot.def(), node.pose, motion);
      if (!next || closed.holds(*next)) continue;
      nodes.push_back({*next, *index, node.steps + 1});
      open.push(nodes.back(), static_cast<std::int32_t>(nodes.size()) - 1);
    }
  }
}

void require_search(const Robot& robot, const Pose& start, double goal_radius) {
  require_above("goal_radius", goal_radius, 0.0, 100.0, "m");
  robot.require_place(start, "start");
}

}  // namespace

ShortestPath shortest_path(const Robot& robot, const Pose& start, double goal_radius,
                           const std::function<bool()>& interrupt) {
  require_search(robot, start, goal_radius);
  const Goal goal(robot, start.heading, goal_radius);
  if (goal.holds(start)) return {{start}, 0};
  Flood flood(robot, goal, goal_radius);
  if (!flood.run(interrupt)) return {{}, goal.least_steps(start)};
  if (!flood.reaches(start)) return {{}, ShortestPath::kNoWay};

  ShortestPath path;
  ByLeastSteps by_least_steps(goal);
  const End end = search(robot, start, goal, interrupt, by_least_steps, path.poses);
  path.lower_bound = end == End::kNoWay ? ShortestPath::kNoWay : by_least_steps.least();
  // The more weight, the less is looked at, and the longer the way.
  for (const double weight : {1.03, 1.2, 2.0}) {
    if (end != End::kGivenUp || path.found() || (interrupt && interrupt())) break;
    AlongFlood along_flood(flood, weight);
    search(robot, start, goal, interrupt, along_flood, path.poses);
  }
  return path;
}

bool may_reach_target(const Robot& robot, const Pose& start, double goal_radius) {
  require_search(robot, start, goal_radius);
  const Goal goal(robot, start.heading, goal_radius);
  if (goal.holds(start)) return true;
  Flood flood(robot, goal, goal_radius);
  flood.run({}, &start);
  return flood.reaches(start);
}

StartPlaces::StartPlaces(const Robot& robot, double goal_radius)
    : world_(robot.world()), goal_radius_(goal_radius), room_(free_room(robot.def())) {
  require_above("goal_radius", goal_radius, 0.0, 100.0, "m");
  Flood flood(robot, Goal(robot, 0.0, goal_radius), goal_radius);
  flood.run({});
  cell_ = flood.cell();
  corners_ = flood.corners();
  if (corners_.empty()) {
    throw InvalidValue("World.target", "one that no place leads to",
                       "one that the robot's body can get to from somewhere");
  }
}

// Where the body fits in a cell's middle it does so round it, so that a few draws suffice, unless
// movers are nearly everywhere.
Pose StartPlaces::draw(Random& random, double time) const {
  constexpr int kMostDraws = 10000;
  for (int i = 0; i < kMostDraws; ++i) {
    const Point corner = corners_[random.index(static_cast<std::uint32_t>(corners_.size()))];
    const Point place{corner.x + cell_ * random.uniform(), corner.y + cell_ * random.uniform()};
    if (world_.clearance(place, true, time) < room_) continue;
    if (distance(place, world_.def().target) <= goal_radius_) continue;
    return {place.x, place.y, 360.0 * random.uniform()};
  }
  return world_.def().start;
}

}  // namespace devlearn
