#include "devlearn/trial_config.hpp"

#include <string>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"

namespace devlearn {

TrialConfig TrialConfig::step5() {
  TrialConfig config;
  config.learner = LearnerConfig::step5();
  return config;
}

TrialConfig TrialConfig::adaptive() {
  TrialConfig config;
  config.learner = AdaptiveConfig{};
  return config;
}

int TrialConfig::motion_count() const {
  return std::visit([](const auto& def) { return def.motion_count; }, learner);
}

void TrialConfig::validate() const {
  detail::require_fields(*this);
  if (clearance_source == ClearanceSource::kSonar) {
    if (!walls_count) {
      throw InvalidValue("TrialConfig.walls_count", "false with clearance_source sonar",
                         "true: an echo does not say whether it came from a wall");
    }
    require_count("TrialConfig.robot.sonar_count with clearance_source sonar", robot.sonar_count, 1,
                  720);
  }
  const auto motions = static_cast<long long>(robot.steering_angles.size());
  if (motion_count() != motions) {
    throw InvalidValue("TrialConfig.learner.motion_count", std::to_string(motion_count()),
                       std::to_string(motions) + ", the number of robot.steering_angles");
  }
}

bool operator==(const TrialConfig& a, const TrialConfig& b) { return detail::same_fields(a, b); }

}  // namespace devlearn
