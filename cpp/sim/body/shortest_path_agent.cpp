#include "devlearn/shortest_path_agent.hpp"

#include <algorithm>
#include <utility>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "devlearn/shortest_path.hpp"
#include "excerpt.hpp"
#include "learner_snapshot.hpp"
#include "made_of.hpp"

namespace devlearn {
namespace {

constexpr const char* kRobot = "robot.";

void require_plannable(const RobotDef& def, double goal_radius) {
  require_above("goal_radius", goal_radius, 0.0, 100.0, "m");
  if (def.safety_margin) {
    throw InvalidValue("RobotDef.safety_margin", to_text(*def.safety_margin),
                       "none: a shortest path knows of none");
  }
}

Robot robot_in(const AgentState& state, const std::string& source) {
  if (state.kind != ShortestPathAgent::kKind) {
    throw FileError(source, "kind", excerpt(state.kind), ShortestPathAgent::kKind);
  }
  RobotDef def;
  const safetensors::Contents contents{state.texts, state.arrays};
  const EntryReader entries(contents, source);
  each_entry(def, kRobot, entries);
  return made_of(source,
                 [&] { return Robot(World::parse(state.text("world"), source).standing(), def); });
}

}  // namespace

ShortestPathAgent::ShortestPathAgent(const Robot& robot, double goal_radius)
    : robot_(robot.world().standing(), robot.def()), goal_radius_(goal_radius) {
  require_plannable(robot.def(), goal_radius);
}

Choice ShortestPathAgent::choose(const Observation& observation) {
  const auto motions = static_cast<int>(robot_.def().steering_angles.size());
  require_count("motion_count", observation.motion_count, motions, motions);
  observation.allowed.validate(motions);
  const Pose& here = observation.pose;

  auto place = std::find(way_.begin(), way_.end(), here);
  if (place == way_.end()) {
    ShortestPath path = shortest_path(robot_, here, goal_radius_);
    if (!path.found()) {
      throw InvalidValue("pose",
                         to_text(here.x) + ", " + to_text(here.y) + ", " + to_text(here.heading),
                         "one from which shortest_path finds a way");
    }
    way_ = std::move(path.poses);
    place = way_.begin();
  }
  const auto next = place + 1;
  const int motion = motion_to(here, next == way_.end() ? nullptr : &*next);
  if (!observation.allowed(motion)) {
    throw InvalidValue("allowed", "not motion " + std::to_string(motion),
                       "the motion that the way takes");
  }
  return {motion, Kind::kUnstated};
}

// The motion that leads to a pose of the way or, beyond its end, the first that touches nothing.
int ShortestPathAgent::motion_to(const Pose& from, const Pose* to) const {
  const auto motions = static_cast<int>(robot_.def().steering_angles.size());
  for (int motion = 0; motion < motions; ++motion) {
    const Robot::Move move = robot_.step(from, motion);
    if (!move.collided && (to == nullptr || move.pose == *to)) return motion;
  }
  return 0;  // shut in at the target
}

std::optional<AgentState> ShortestPathAgent::state() const {
  const RobotDef& def = robot_.def();
  safetensors::Contents contents;
  EntryWriter entries(contents);
  each_entry(def, kRobot, entries);
  entries("goal_radius", goal_radius_);
  entries("way_poses", std::uint64_t{way_.size()});
  contents.metadata["world"] = robot_.world().to_json();
  contents.arrays["steering_angles"] = array_of(def.steering_angles);  // a copy
  std::vector<double> poses;
  for (const Pose& pose : way_) poses.insert(poses.end(), {pose.x, pose.y, pose.heading});
  contents.arrays["way"] = array_of(std::move(poses), {way_.size(), 3});
  return AgentState{kKind, std::move(contents.metadata), std::move(contents.arrays)};
}

ShortestPathAgent::ShortestPathAgent(const AgentState& state, const std::string& source)
    : robot_(robot_in(state, source)), goal_radius_(0.0) {
  const safetensors::Contents contents{state.texts, state.arrays};
  const EntryReader entries(contents, source);
  std::uint64_t count = 0;
  entries("goal_radius", goal_radius_);
  entries("way_poses", count);
  made_of(source, [&] { require_plannable(robot_.def(), goal_radius_); });
  const auto poses = safetensors::values<double>(contents, "way", {count, 3}, source);
  for (std::size_t i = 0; i < poses.size(); i += 3) {
    way_.push_back({poses[i], poses[i + 1], poses[i + 2]});
    const bool leads_on = i == 0 || made_of(source, [&] {
                            const Pose& before = way_[way_.size() - 2];
                            const int motion = motion_to(before, &way_.back());
                            return robot_.step(before, motion).pose == way_.back();
                          });
    if (!leads_on) {
      throw FileError(source, "way[" + std::to_string(i / 3) + "]", to_text(poses[i]),
                      "a pose to which a motion leads from the one before");
    }
  }
}

std::shared_ptr<Agent> ShortestPathAgent::maker(const AgentState& state) {
  if (state.kind != kKind) return nullptr;
  return std::make_shared<ShortestPathAgent>(state);
}

}  // namespace devlearn
