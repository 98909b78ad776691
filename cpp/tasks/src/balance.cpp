#include "devlearn/balance.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "devlearn/random.hpp"

namespace devlearn {
namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;
constexpr double kEstimate = 1.0;

void require_rising(const char* name, const std::vector<double>& edges) {
  for (std::size_t i = 1; i < edges.size(); ++i) {
    if (edges[i] > edges[i - 1]) continue;
    throw InvalidValue(detail::quantity("BalanceConfig", name),
                       to_text(edges[i]) + " after " + to_text(edges[i - 1]), "rising numbers");
  }
}

// The number of the interval that a value lies in; an edge belongs to the one above it.
SituationId interval(const std::vector<double>& edges, double value) noexcept {
  return std::upper_bound(edges.begin(), edges.end(), value) - edges.begin();
}

void require_few(const char* name, double times, const char* of) {
  constexpr double kMost = 1e9;
  if (times <= kMost) return;
  throw InvalidValue(detail::quantity("BalanceConfig", name), to_text(times) + " times " + of,
                     "at most 1e9 times");
}

void require_fitting(const BalanceConfig& config) {
  config.validate();
  require_rising("angle_edges", config.angle_edges);
  require_rising("rate_edges", config.rate_edges);
  require_rising("wheel_rate_edges", config.wheel_rate_edges);
  if (!(config.start_angle < config.angle_limit)) {
    throw InvalidValue("BalanceConfig.start_angle", to_text(config.start_angle),
                       "below angle_limit, " + to_text(config.angle_limit));
  }
  require_few("duration", config.duration / config.sample_time, "sample_time");
  require_few("sample_time", config.sample_time / config.substep, "substep");
}

}  // namespace

Balance::Balance(const Config& config)
    : config_((require_fitting(config), config)),
      robot_(config.robot),
      substeps_(static_cast<int>(std::ceil(config.sample_time / config.substep))),
      limit_(std::max<std::int64_t>(std::llround(config.duration / config.sample_time), 1)) {}

void Balance::begin(std::uint64_t seed) {
  const double drawn = Random(seed, "balance").uniform();
  begin_at({config_.start_angle * (2.0 * drawn - 1.0), 0.0, 0.0, 0.0});
}

void Balance::begin_at(const BalanceState& state) {
  require_in("angle", state.angle, -config_.angle_limit, config_.angle_limit, "degrees");
  require_finite("rate", state.rate);
  require_finite("wheel", state.wheel);
  require_finite("wheel_rate", state.wheel_rate);
  state_ = {state.angle / kDegrees, state.rate / kDegrees, state.wheel / kDegrees,
            state.wheel_rate / kDegrees};
  steps_ = 0;
  begun_ = true;
  ended_ = false;
  sense();
}

BalanceState Balance::state() const noexcept {
  return {state_.angle * kDegrees, state_.rate * kDegrees, state_.wheel * kDegrees,
          state_.wheel_rate * kDegrees};
}

void Balance::sense() noexcept {
  const BalanceState now = state();
  const double sensed[] = {now.angle, now.rate, now.wheel, now.wheel_rate};
  std::copy(std::begin(sensed), std::end(sensed), senses_);
}

bool Balance::stands() const noexcept {
  return std::abs(state_.angle) * kDegrees <= config_.angle_limit;
}

SituationId Balance::situation_count() const noexcept {
  return static_cast<SituationId>((config_.angle_edges.size() + 1) *
                                  (config_.rate_edges.size() + 1) *
                                  (config_.wheel_rate_edges.size() + 1));
}

SituationId Balance::situation_of(const BalanceState& state) const noexcept {
  const auto rates = static_cast<SituationId>(config_.rate_edges.size() + 1);
  const auto wheel_rates = static_cast<SituationId>(config_.wheel_rate_edges.size() + 1);
  return (interval(config_.angle_edges, state.angle) * rates +
          interval(config_.rate_edges, state.rate)) *
             wheel_rates +
         interval(config_.wheel_rate_edges, state.wheel_rate);
}

double Balance::sef_of(const BalanceState& state) const noexcept {
  const double lean =
      (state.angle + config_.sef_rate * state.rate + config_.sef_wheel_rate * state.wheel_rate) /
      config_.angle_limit;
  return -config_.sef_scale * lean * lean;
}

Observation Balance::observation() const {
  if (!begun_ || ended_) {
    throw InvalidValue("observation", "asked for where no episode is under way", "begin first");
  }
  const BalanceState now = state();
  Observation seen;
  seen.situation = situation_of(now);
  seen.sef = sef_of(now);
  seen.estimate = kEstimate;
  seen.motion_count = motion_count();
  seen.senses = {senses_, 4};
  return seen;
}

Outcome Balance::step(int motion) {
  if (!begun_ || ended_) {
    throw InvalidValue("step", "called where no episode is under way", "begin first");
  }
  require_count("motion", motion, 0, motion_count() - 1);
  const double before = sef_of(state());
  const double torque = config_.torques[static_cast<std::size_t>(motion)];
  state_ = robot_.after(state_, torque, config_.sample_time, substeps_);
  ++steps_;
  const bool fell = !stands();
  ended_ = fell || steps_ == limit_;
  sense();

  const BalanceState now = state();
  Outcome outcome;
  outcome.situation = situation_of(now);
  outcome.sef = sef_of(now);
  outcome.smf = outcome.sef - before;
  if (fell) outcome.smf = std::min(outcome.smf, -1.0);
  outcome.collided = fell;
  outcome.arrived = ended_;
  outcome.estimate = ended_ ? 0.0 : kEstimate;
  outcome.cost = fell ? config_.fall_cost : 0.0;
  if (ended_) outcome.event = fell ? kTouchEvent : kArrivalEvent;
  return outcome;
}

}  // namespace devlearn
