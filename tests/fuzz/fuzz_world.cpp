#include <algorithm>
#include <optional>

#include "devlearn/math.hpp"
#include "devlearn/trial.hpp"
#include "devlearn/world.hpp"
#include "law.hpp"
#include "world/surfaces.hpp"

// Any text is refused with a FileError, or makes a world that is written to what reads equal, and
// in which a robot drives wherever it fits: no assert of Box2D's is reached.
using namespace devlearn;

namespace {

std::optional<World> parsed(const std::string& text) {
  try {
    return World::parse(text);
  } catch (const FileError& error) {
    fuzz::require_fit(error);
    return std::nullopt;
  }
}

// Drives into what stands at `target` from a little way off, if there is room.
void drive_at(const Trial& trial, Point target, double heading) {
  const RobotDef& def = trial.config().robot;
  const Direction ahead = direction(heading);
  const double gap = def.radius + 0.02;
  const Pose pose{target.x - gap * ahead.x, target.y - gap * ahead.y, heading};
  try {
    trial.robot().require_place(pose);
  } catch (const InvalidValue&) {
    return;
  }
  for (const double echo : trial.robot().sonar(pose)) {
    fuzz::require(echo >= 0.0 && echo <= def.sonar_range, "echoes lie in the sonars' range");
  }
  for (std::size_t motion = 0; motion < def.steering_angles.size(); ++motion) {
    const Robot::Move step = trial.robot().step(pose, static_cast<int>(motion));
    fuzz::require(std::isfinite(step.pose.x) && std::isfinite(step.pose.y), "poses are finite");
  }
}

void drive(const World& world) {
  TrialConfig config;
  config.robot.radius = 0.05;
  std::optional<Trial> trial;
  try {
    trial.emplace(world, config, 1);
  } catch (const InvalidValue&) {  // no room at the start, or too many situations
    return;
  }
  Record record;
  trial->run(record, 16);
  fuzz::require_laws(*trial->learner());

  constexpr std::size_t kMost = 12;
  for (std::size_t i = 0; i < std::min(kMost, world.surfaces().edges().size()); ++i) {
    const Edge& edge = world.surfaces().edges()[world.surfaces().edges().size() - 1 - i];
    const double heading = 30.0 * static_cast<double>(i);
    drive_at(*trial, {0.5 * (edge.a.x + edge.b.x), 0.5 * (edge.a.y + edge.b.y)}, heading);
    drive_at(*trial, edge.a, heading);
  }
  for (std::size_t i = 0; i < std::min(kMost, world.surfaces().circles().size()); ++i) {
    const Circle& circle = world.surfaces().circles()[i];
    drive_at(*trial, {circle.center.x - circle.radius, circle.center.y}, 0.0);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::optional<World> world = parsed({reinterpret_cast<const char*>(data), size});
  if (!world) return 0;

  const std::string text = world->to_json();
  const std::optional<World> again = parsed(text);
  fuzz::require(again.has_value(), "what was written reads");
  fuzz::require(again->to_json() == text, "what was written reads equal");

  const Point start{world->def().start.x, world->def().start.y}, target = world->def().target;
  fuzz::require(world->clearance(start) > 0.0, "the start is outside every obstacle");
  fuzz::require(world->clearance(target) > 0.0, "the target is outside every obstacle");
  drive(*world);
  return 0;
}
