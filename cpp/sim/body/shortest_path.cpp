#include "devlearn/shortest_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_set>

#include "body/kinematics.hpp"
#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "world/geometry.hpp"

namespace devlearn {
namespace {

struct Node {
  Pose pose;
  std::int32_t parent;
  std::int32_t steps;
};

// Which poses count as one.
class Cells {
 public:
  Cells(const World& world, double cell)
      : origin_(world.def().origin),
        cell_(cell),
        columns_(static_cast<std::int64_t>(world.def().width / cell) + 1) {
    const double cells = (world.def().width / cell) * (world.def().height / cell);
    if (!(cells <= 1e9)) {
      throw InvalidValue("shortest_path's cells", to_text(cells),
                         "at most 1e9: a smaller arena, or longer steps");
    }
  }

  std::int64_t of(const Pose& pose) const noexcept {
    constexpr std::int64_t kHeadings = 360;
    const std::int64_t heading = std::llround(pose.heading) % kHeadings;
    const auto column = static_cast<std::int64_t>((pose.x - origin_.x) / cell_);
    const auto row = static_cast<std::int64_t>((pose.y - origin_.y) / cell_);
    return (row * columns_ + column) * kHeadings + heading;
  }

 private:
  Point origin_;
  double cell_;
  std::int64_t columns_;
};

}  // namespace

std::vector<Pose> shortest_path(const Robot& robot, const Pose& start, double goal_radius) {
  require_above("goal_radius", goal_radius, 0.0, 100.0, "m");
  robot.require_place(start, "start");
  const Point target = robot.world().def().target;
  const double length = step_length(robot.def());
  const auto motions = static_cast<int>(robot.def().steering_angles.size());
  const Cells cells(robot.world(), length / 4.0);

  const auto remaining = [&](const Pose& pose) {
    return distance({pose.x, pose.y}, target) - goal_radius;
  };
  // Steps to the target as the crow flies: never too many. The hair is for rounding.
  const auto least_steps = [&](const Pose& pose) {
    return static_cast<std::int32_t>(std::max(0.0, std::ceil(remaining(pose) / length - 1e-9)));
  };

  // open[f] holds the nodes whose way is at least f steps long; the last found go first.
  std::vector<Node> nodes{{start, -1, 0}};
  std::vector<std::vector<std::int32_t>> open(static_cast<std::size_t>(least_steps(start)) + 1);
  std::unordered_set<std::int64_t> closed;
  open.back().push_back(0);
  for (std::size_t f = 0; f < open.size(); ++f) {
    while (!open[f].empty()) {
      const std::int32_t index = open[f].back();
      open[f].pop_back();
      const Node node = nodes[static_cast<std::size_t>(index)];
      if (remaining(node.pose) <= 0.0) {
        std::vector<Pose> way;
        for (std::int32_t i = index; i >= 0; i = nodes[static_cast<std::size_t>(i)].parent) {
          way.push_back(nodes[static_cast<std::size_t>(i)].pose);
        }
        std::reverse(way.begin(), way.end());
        return way;
      }
      if (!closed.insert(cells.of(node.pose)).second) continue;
      for (int motion = 0; motion < motions; ++motion) {
        const std::optional<Pose> next = free_step(robot.world(), robot.def(), node.pose, motion);
        if (!next || closed.count(cells.of(*next)) > 0) continue;
        const std::int32_t steps = node.steps + 1;
        const auto bound =
            static_cast<std::size_t>(steps) + static_cast<std::size_t>(least_steps(*next));
        if (bound >= open.size()) open.resize(bound + 1);
        // Rounding may put a step's bound below its parent's by one.
        open[std::max(bound, f)].push_back(static_cast<std::int32_t>(nodes.size()));
        nodes.push_back({*next, index, steps});
      }
    }
  }
  return {};
}

}  // namespace devlearn
