#include "devlearn/attention.hpp"

#include <algorithm>
#include <cmath>

#include "devlearn/detail/require.hpp"
#include "devlearn/math.hpp"

namespace devlearn {

Attention::Attention(const Config& config) : config_((config.validate(), config)) {
  motors_.columns = 3;
  const auto speed = [&](int i) { return 2.0 * i / (config.speeds - 1) - 1.0; };
  for (int left = 0; left < config.speeds; ++left) {
    for (int right = 0; right < config.speeds; ++right) {
      for (int f = 0; f < config.frequencies; ++f) {
        for (const double one : {speed(left), speed(right), (f + 0.5) / config.frequencies}) {
          motors_.values.push_back(one);
        }
      }
    }
  }
}

void Attention::begin(std::uint64_t seed) {
  random_ = Random(seed, "task");
  const Point place = anywhere();
  robot_ = {place.x, place.y, 360.0 * random_.uniform()};
  toy_ = anywhere();
  sense();
  left_ = config_.steps;
}

Observation Attention::observation() const {
  require_under_way("observation");
  Observation seen;
  seen.situation = static_cast<SituationId>(
      std::clamp(10.0 * distance_ / config_.side, 0.0, static_cast<double>(situation_count() - 1)));
  seen.motion_count = motion_count();
  seen.senses = {&distance_, 1};
  return seen;
}

Outcome Attention::step(int motion) {
  require_under_way("step");
  require_motion(motion);
  const double left = motors_.row(motion)[0], right = motors_.row(motion)[1];

  // A turn about the middle of the axle, and a way along its mean heading, as far as the walls.
  constexpr double kDegrees = 57.295779513082323;
  const double way = config_.speed * (left + right) / 2.0;
  const double turn = config_.speed * (right - left) / config_.axle * kDegrees;
  const Direction along = direction(robot_.heading + turn / 2.0);
  robot_.x = std::clamp(robot_.x + way * along.x, 0.0, config_.side);
  robot_.y = std::clamp(robot_.y + way * along.y, 0.0, config_.side);
  robot_.heading = wrapped_heading(robot_.heading + turn);

  const Zone what = zone(motion);
  if (what == Zone::kRandom) toy_ = anywhere();
  if (what == Zone::kJumps) toy_ = {robot_.x, robot_.y};
  sense();
  const Observation next = observation();
  --left_;
  Outcome outcome;
  outcome.situation = next.situation;
  outcome.cost = 0.0;
  outcome.arrived = left_ == 0;
  return outcome;
}

Attention::Zone Attention::zone(int motion) const {
  require_motion(motion);
  const double f = motors_.row(motion)[2];
  return f < 1.0 / 3.0 ? Zone::kRandom : f < 2.0 / 3.0 ? Zone::kStays : Zone::kJumps;
}

Point Attention::anywhere() noexcept {
  const double x = config_.side * random_.uniform();
  return {x, config_.side * random_.uniform()};
}

void Attention::sense() noexcept {
  const double x = robot_.x - toy_.x, y = robot_.y - toy_.y;
  distance_ = std::sqrt(x * x + y * y) + config_.noise * random_.normal();
}

void Attention::require_motion(int motion) const {
  require_count("motion", motion, 0, motion_count() - 1);
}

void Attention::require_under_way(const char* call) const {
  if (left_ > 0) return;
  throw InvalidValue(call, left_ < 0 ? "called before begin" : "called after the end",
                     "a call while an episode is under way");
}

}  // namespace devlearn
