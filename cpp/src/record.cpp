#include "devlearn/record.hpp"

#include <algorithm>

namespace devlearn {
namespace {

// Room for one more in every column before the first grows, so that they stay of one length where
// memory ends.
template <typename... Columns>
void make_room(Columns&... columns) {
  const auto grow = [](auto& column) {
    if (column.size() < column.capacity()) return;
    column.reserve(std::max<std::size_t>(64, 2 * column.size()));
  };
  (grow(columns), ...);
}

}  // namespace

void Record::begin_round(std::int32_t number, const Pose& pose) {
  make_room(rounds, x, y, heading);
  rounds.push_back({number, 0, false});
  x.push_back(pose.x);
  y.push_back(pose.y);
  heading.push_back(pose.heading);
}

void Record::append(const StepRecord& step) {
  make_room(round, situation, motion, kind, sef, smf, smf_used, collided, arrived, goal_distance,
            clearance, event, reduced, explored_count, effective_count, x, y, heading);
  round.push_back(step.round);
  situation.push_back(step.situation);
  motion.push_back(step.motion);
  kind.push_back(static_cast<std::uint8_t>(step.kind));
  sef.push_back(step.sef);
  smf.push_back(step.smf);
  smf_used.push_back(step.smf_used);
  collided.push_back(step.collided);
  arrived.push_back(step.arrived);
  goal_distance.push_back(step.goal_distance);
  clearance.push_back(step.clearance);
  event.push_back(static_cast<std::uint8_t>(step.event));
  reduced.push_back(step.reduced);
  explored_count.push_back(step.explored_count);
  effective_count.push_back(step.effective_count);
  x.push_back(step.pose.x);
  y.push_back(step.pose.y);
  heading.push_back(step.pose.heading);
  rounds.back().steps += 1;
  rounds.back().arrived |= step.arrived;
}

}  // namespace devlearn
