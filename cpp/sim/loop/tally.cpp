#include "devlearn/tally.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"

namespace devlearn {
namespace {

constexpr int kMostMotions = 65535;

bool is_update(Event event) {
  return event == Event::kExtension || event == Event::kOrientation || event == Event::kAbandonment;
}

// Of the motions so far and one more. Multiplied by an odd number, no two values become one.
std::uint64_t fingerprint(std::uint64_t path, std::int32_t motion) {
  path = (path ^ (static_cast<std::uint64_t>(motion) + 1)) * 0x9e3779b97f4a7c15U;
  return path ^ (path >> 32);
}

// What of a step its record tells a tally.
Step step_of(const Record& record, std::size_t i) {
  Step step;
  step.situation = record.situation[i];
  step.motion = record.motion[i];
  step.kind = static_cast<Kind>(record.kind[i]);
  step.smf_used = record.smf_used[i];
  step.collided = record.collided[i] != 0;
  step.arrived = record.arrived[i] != 0;
  step.cost = record.cost[i];
  step.event = static_cast<Event>(record.event[i]);
  step.explored_count = record.explored_count[i];
  step.effective_count = record.effective_count[i];
  return step;
}

}  // namespace

Tally Tally::of(const Record& record) {
  if (record.rounds_only()) throw InvalidValue("record", "rounds only", "one that holds steps");
  record.validate();
  for (std::size_t i = 0; i < record.steps(); ++i) {
    if (record.motion[i] < kMostMotions) continue;
    require_count("record.motion[" + std::to_string(i) + "]", record.motion[i], 0,
                  kMostMotions - 1);
  }
  Tally tally;
  std::size_t step = 0, pose = 0;
  const auto pose_at = [&](std::size_t k) {
    return Pose{record.x[k], record.y[k], record.heading[k]};
  };
  for (const Round& round : record.rounds) {
    tally.begin_round(round.round, pose_at(pose++));
    for (std::int64_t n = 0; n < round.steps; ++n) {
      Step now = step_of(record, step++);
      now.pose = pose_at(pose++);
      tally.count(now);
    }
    if (round.arrived) tally.arrive();
  }
  return tally;
}

std::int64_t Tally::steps() const noexcept {
  std::int64_t sum = 0;
  for (const RoundTally& round : rounds_) sum += round.steps;
  return sum;
}

void Tally::begin_round(std::int32_t number, const Pose& pose) {
  RoundTally round;
  if (!rounds_.empty()) {
    const RoundTally& last = rounds_.back();
    if (last.round == number && here_ == pose) return;
    round.mappings = last.mappings;
    round.explored_count = last.explored_count;
    round.effective_count = last.effective_count;
  }
  round.round = number;
  rounds_.push_back(round);
  here_ = pose;
}

void Tally::count(const Step& step) {
  // It alone may ask for memory: where there is none, the step is not counted at all.
  First& first = first_of(step.situation, step.motion);
  const bool ineffective = step.smf_used < 0.0;
  const bool update = is_update(step.event);
  RoundTally& round = rounds_.back();
  round.steps += 1;
  if (step.arrived && round.first_arrival == 0) round.first_arrival = round.steps;
  round.arrived |= step.arrived;
  round.touches += step.collided;
  round.cost += step.cost;
  round.path = fingerprint(round.path, step.motion);
  round.explored += step.kind == Kind::kExplore;
  round.known_ineffective += first == First::kIneffective;
  if (first == First::kNone) {
    first = ineffective ? First::kIneffective : First::kEffective;
    ++mappings_;
  }
  round.ineffective += ineffective;
  round.updates += update;
  round.ineffective_updates += update && ineffective;
  round.mappings = mappings_;
  round.explored_count = step.explored_count;
  round.effective_count = step.effective_count;
  here_ = step.pose;
}

Tally::First& Tally::first_of(SituationId situation, std::int32_t motion) {
  if (static_cast<std::size_t>(motion) >= width_) widen(motion);
  std::uint32_t row = situations_.find(situation);
  if (row == detail::SituationIndex::kAbsent) {
    first_.resize((situations_.size() + 1) * width_, First::kNone);
    row = situations_.add(situation);
  }
  return first_[row * width_ + static_cast<std::size_t>(motion)];
}

// Makes room for a motion in every row.
void Tally::widen(std::int32_t motion) {
  std::size_t width = width_;
  while (width <= static_cast<std::size_t>(motion)) width *= 2;
  std::vector<First> wider(situations_.size() * width, First::kNone);
  for (std::size_t row = 0; row < situations_.size(); ++row) {
    std::copy_n(&first_[row * width_], width_, &wider[row * width]);
  }
  first_.swap(wider);
  width_ = width;
}

}  // namespace devlearn
