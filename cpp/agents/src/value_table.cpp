#include "devlearn/detail/value_table.hpp"

#include <algorithm>
#include <limits>

#include "agent_snapshot.hpp"
#include "candidates.hpp"
#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"

namespace devlearn::detail {
namespace {

constexpr double kBound = 1e100;
constexpr int kMostMotions = 65535;
constexpr std::size_t kMostRows = kNoRow - 1;  // the last number is one of kNoRow's kind

void require_situation(SituationId situation) {
  require_count("situation", situation, 0, std::numeric_limits<SituationId>::max());
}
void require_estimate(double estimate) {
  if (!(estimate >= 0.0 && estimate <= std::numeric_limits<double>::max())) {
    throw InvalidValue("estimate", to_text(estimate), "a finite number, at least 0");
  }
}

}  // namespace

double ValueTable::bounded(double value) noexcept { return std::clamp(value, -kBound, kBound); }

void ValueTable::require_bounded(const char* quantity, double value) {
  require_in(quantity, value, -kBound, kBound);
}

// --- a step --------------------------------------------------------------------------------------

Row ValueTable::meet(const Observation& observation) {
  if (waiting_row_ != kNoRow) {
    throw InvalidValue("choose", "called while a choice waits for its outcome",
                       "observe or cancel first");
  }
  require_situation(observation.situation);
  require_count("motion_count", observation.motion_count, 1, kMostMotions);
  if (motion_count_ != 0) {
    require_count("motion_count", observation.motion_count, motion_count_, motion_count_);
  }
  require_finite("sef", observation.sef);
  require_estimate(observation.estimate);
  observation.allowed.validate(observation.motion_count);

  motion_count_ = observation.motion_count;
  const Row row = find_or_add(observation.situation, observation.estimate);
  for (int motion = 0; motion < motion_count_; ++motion) {
    allowed_[pair(row, motion)] = observation.allowed(motion) ? 1 : 0;
  }
  potential_ = potential(observation.sef, observation.estimate);
  return row;
}

Choice ValueTable::choose(Row row, double epsilon) {
  const bool any = epsilon > 0.0 && random_.uniform() < epsilon;
  const double least = any ? -kBound : max(row);
  const auto candidate = [&](int motion) {
    return allowed(row, motion) && q_[pair(row, motion)] >= least;
  };
  const std::uint32_t candidates = count_candidates(motion_count_, candidate);
  return wait(row, nth_candidate(candidates == 1 ? 0 : random_.index(candidates), candidate));
}

Transition ValueTable::observe(const Outcome& outcome) {
  if (waiting_row_ == kNoRow) {
    throw InvalidValue("observe", "called where no choice waits", "choose first");
  }
  require_situation(outcome.situation);
  require_finite("cost", outcome.cost);
  require_finite("sef", outcome.sef);
  require_estimate(outcome.estimate);

  const Row next = outcome.arrived ? kNoRow : find_or_add(outcome.situation, outcome.estimate);
  const double there = outcome.arrived ? 0.0 : potential(outcome.sef, outcome.estimate);
  const double reward = bounded(bounded(outcome.reward()) + (rules_.gamma * there - potential_));
  const Transition transition{waiting_row_, waiting_motion_, reward, next};
  waiting_row_ = kNoRow;
  return transition;
}

void ValueTable::cancel() {
  if (waiting_row_ == kNoRow) {
    throw InvalidValue("cancel", "called where no choice waits", "choose first");
  }
  waiting_row_ = kNoRow;
}

// --- values --------------------------------------------------------------------------------------

double ValueTable::max(Row row) const noexcept {
  if (row == kNoRow) return 0.0;
  double highest = -kBound;
  for (int motion = 0; motion < motion_count_; ++motion) {
    if (allowed(row, motion)) highest = std::max(highest, q_[pair(row, motion)]);
  }
  return highest;
}

double ValueTable::expected(Row row, double epsilon) const noexcept {
  if (row == kNoRow) return 0.0;
  double sum = 0.0;
  int count = 0;
  for (int motion = 0; motion < motion_count_; ++motion) {
    if (!allowed(row, motion)) continue;
    sum += q_[pair(row, motion)];
    ++count;
  }
  return (1.0 - epsilon) * max(row) + epsilon * (sum / count);
}

std::optional<std::size_t> ValueTable::find(SituationId situation, int motion) const {
  require_situation(situation);
  require_count("motion", motion, 0, (motion_count_ == 0 ? kMostMotions : motion_count_) - 1);
  const Row row = index_.find(situation);
  if (row == kNoRow) return std::nullopt;
  return pair(row, motion);
}

std::optional<double> ValueTable::value(SituationId situation, int motion) const {
  const std::optional<std::size_t> found = find(situation, motion);
  return found ? std::optional(q_[*found]) : std::nullopt;
}

Row ValueTable::find_or_add(SituationId situation, double estimate) {
  const Row found = index_.find(situation);
  if (found != kNoRow) return found;
  if (rows() == kMostRows) {
    throw InvalidValue("situations", "one more than " + std::to_string(kMostRows),
                       "as many as a table holds");
  }
  const auto motions = static_cast<std::size_t>(motion_count_);
  allowed_.resize(pairs() + motions, 1);
  q_.resize(pairs() + motions);
  const double first =
      rules_.first_value == FirstValue::kConstant ? rules_.initial_value : bounded(-estimate);
  std::fill_n(q_.end() - motion_count_, motions, first);
  return index_.add(situation);
}

double ValueTable::potential(double sef, double estimate) const noexcept {
  switch (rules_.shaping) {
    case Shaping::kSef:
      return bounded(sef);
    case Shaping::kEstimate:
      return bounded(-estimate);
    default:
      return 0.0;
  }
}

// --- states --------------------------------------------------------------------------------------

void ValueTable::describe(AgentState& state) const {
  const std::uint64_t count = rows(), motions = static_cast<std::uint64_t>(motion_count_);
  add_entry(state, "motion_count", motion_count_);
  add_entry(state, "situations", count);
  if (waiting_row_ != kNoRow) {
    add_entry(state, "waiting_row", std::uint64_t{waiting_row_});
    add_entry(state, "waiting_motion", waiting_motion_);
    add_entry(state, "waiting_potential", potential_);
  }

  std::vector<SituationId> situations(rows());
  for (Row row = 0; row < rows(); ++row) situations[row] = index_.id(row);
  const Random::State words = random_.state();
  state.arrays["situation"] = array_of(std::move(situations));
  state.arrays["q"] = array_of(q_, {count, motions});
  state.arrays["allowed"] = array_of(allowed_, {count, motions});
  state.arrays["random"] = array_of(std::vector<std::uint64_t>(words.begin(), words.end()));
}

ValueTable::ValueTable(const Rules& rules, const AgentState& state, const std::string& source)
    : rules_(rules), random_(random_of({state.texts, state.arrays}, source)) {
  const auto count = entry_of<std::uint64_t>(state, "situations", source);
  const auto motions = entry_of<int>(state, "motion_count", source);
  made_of(source,
          [&] { require_count("motion_count", motions, count == 0 ? 0 : 1, kMostMotions); });
  motion_count_ = motions;
  const Shape shape{count, static_cast<std::uint64_t>(motions)};
  const auto situations = values_of<SituationId>(
      state, "situation", {count}, source, [&](const char* name, SituationId situation) {
        require_count(name, situation, 0, std::numeric_limits<SituationId>::max());
        if (index_.find(situation) != kNoRow) {
          throw InvalidValue(name, std::to_string(situation), "each id once");
        }
        index_.add(situation);
      });
  q_ = values_of<double>(state, "q", shape, source, require_bounded);
  allowed_ = values_of<std::uint8_t>(
      state, "allowed", shape, source,
      [](const char* name, std::uint8_t value) { require_count(name, value, 0, 1); });
  for (auto row = allowed_.begin(); row != allowed_.end(); row += motions) {
    if (std::all_of(row, row + motions, [](std::uint8_t one) { return one == 0; })) {
      throw FileError(source, "allowed", "no motion", "at least one in each situation");
    }
  }
  if (state.texts.count("waiting_row") == 0) return;
  const auto row = static_cast<Row>(place_of(state, "waiting_row", count, source));
  waiting_motion_ = entry_of<int>(state, "waiting_motion", source);
  potential_ = entry_of<double>(state, "waiting_potential", source);
  made_of(source, [&] {
    require_count("waiting_motion", waiting_motion_, 0, motions - 1);
    require_bounded("waiting_potential", potential_);
  });
  waiting_row_ = row;
  if (!allowed(waiting_row_, waiting_motion_)) {
    throw FileError(source, "waiting_motion", std::to_string(waiting_motion_),
                    "a motion that is allowed there");
  }
}

}  // namespace devlearn::detail
