#include "devlearn/record.hpp"

namespace devlearn {

void Record::begin_round(std::int32_t number, const Pose& pose) {
  rounds.push_back({number, 0, false});
  x.push_back(pose.x);
  y.push_back(pose.y);
  heading.push_back(pose.heading);
}

void Record::append(const StepRecord& step) {
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
