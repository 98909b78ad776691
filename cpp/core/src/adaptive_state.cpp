// What an adaptive learner goes on from, and the laws that a state must keep to be gone on from.
#include <cmath>
#include <string>

#include "adaptive_arrays.hpp"
#include "devlearn/adaptive.hpp"
#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"

namespace devlearn {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kGoal = detail::OutcomeStore::kGoal;

[[noreturn]] void refuse_entry(const std::string& name, std::size_t i, const std::string& value,
                               const char* allowed) {
  throw InvalidValue(name + "[" + std::to_string(i) + "]", value, allowed);
}

// allows(value) of every one.
template <typename T, typename Allows>
void require_all(const std::string& name, const std::vector<T>& values, const Allows& allows,
                 const char* allowed) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (allows(values[i])) continue;
    if constexpr (std::is_same_v<T, double>) {
      refuse_entry(name, i, to_text(values[i]), allowed);
    } else {
      refuse_entry(name, i, std::to_string(values[i]), allowed);
    }
  }
}

// No history of costs and estimates up to 1e12 comes near it; sums of so many cannot overflow.
constexpr double kMost = 1e30;
bool is_bounded(double value) { return std::abs(value) <= kMost; }
bool is_bounded_or_infinite(double value) {
  return value >= -kMost && !(value > kMost && value < kInfinity);
}
bool is_cost(double value) { return value >= 0.0 && value <= kMost; }
bool is_truth(std::uint8_t value) { return value <= 1; }

void require_path(const std::string& name, const AdaptivePath& path, std::size_t situations,
                  int motion_count) {
  const auto in = [&](const char* field) { return name + "." + field; };
  std::vector<bool> seen(situations);
  for (std::size_t i = 0; i < path.situation.size(); ++i) {
    const std::uint32_t situation = path.situation[i];
    if (situation >= situations || seen[situation]) {
      refuse_entry(in("situation"), i, std::to_string(situation),
                   "numbers of situations, each once");
    }
    seen[situation] = true;
  }
  const auto is_motion = [=](std::int32_t motion) { return motion >= 0 && motion < motion_count; };
  require_all(in("motion"), path.motion, is_motion, "a motion of M");
  require_all(in("before"), path.before, is_cost, "in [0, 1e30]");
  require_all(in("estimate"), path.estimate, is_cost, "in [0, 1e30]");
  require_all(in("interrupted"), path.interrupted, is_truth, "0 or 1");
}

void require_number(const char* name, int number, std::size_t situations) {
  if (number >= 0 && static_cast<std::size_t>(number) >= situations) {
    throw InvalidValue(name, std::to_string(number), "-1, or the number of a situation");
  }
}

void require_law(bool kept, const char* name, const std::string& value, const char* allowed) {
  if (!kept) throw InvalidValue(name, value, allowed);
}

// The laws that hold within each array, and between it and the sizes.
void require_arrays(const AdaptiveState& state) {
  const AdaptiveArrays& all = state.arrays;
  const std::size_t situations = all.situation.size();
  const int n = state.config.motion_count;
  each_array(all, sizes_of(state), [](const char* name, const auto& values, const Shape& shape) {
    std::uint64_t size = 1;
    for (const std::uint64_t length : shape) size *= length;
    require_size(name, values.size(), size);
  });
  require_all(
      "situation", all.situation, [](SituationId id) { return id >= 0; }, "at least 0");
  require_all("first_estimate", all.first_estimate, is_cost, "in [0, 1e30]");
  require_all(
      "by_values", all.by_values, [=](int m) { return m >= -1 && m < n; }, "-1, or a motion of M");
  require_all("known", all.known, is_bounded_or_infinite, "in [-1e30, 1e30], or inf");
  require_all("hoped", all.hoped, is_bounded, "in [-1e30, 1e30]");
  require_all("loss", all.loss, is_bounded, "in [-1e30, 1e30]");
  require_all("allowed", all.allowed, is_truth, "0 or 1");
  require_all(
      "priority", all.priority, [](double p) { return p >= 0.0; }, "at least 0");
  require_all("on_trial", all.on_trial, is_truth, "0 or 1");
  require_all("trial_loss", all.trial_loss, is_bounded_or_infinite, "in [-1e30, 1e30], or inf");
  require_all(
      "times", all.times, [](std::uint32_t times) { return times >= 1; }, "at least 1");
  require_all("loss_sum", all.loss_sum, is_bounded, "in [-1e30, 1e30]");
  require_all(
      "next", all.next,
      [=](int next) { return next >= -1 && next < static_cast<long long>(situations); },
      "-1, or the number of a situation");
  std::uint64_t outcomes = 0;
  const double untried = state.optimism - 1.0;
  for (std::size_t i = 0; i < all.outcome_count.size(); ++i) {
    const std::uint32_t count = all.outcome_count[i];
    outcomes += count;
    if (count > 0) continue;
    if (all.priority[i] > 0.0) {
      refuse_entry("priority", i, to_text(all.priority[i]), "0 where nothing was tried");
    }
    if (all.interrupted[i] != 0) {
      refuse_entry("interrupted", i, std::to_string(all.interrupted[i]),
                   "0 where nothing was tried");
    }
    const double loss = untried * all.first_estimate[i / static_cast<std::size_t>(n)];
    if (!state.falling.under_way() && all.loss[i] != loss) {
      refuse_entry("loss", i, to_text(all.loss[i]), "w - 1 times the first estimate, untried");
    }
  }
  require_law(outcomes == all.next.size(), "outcome_count", "a sum of " + std::to_string(outcomes),
              "as many as there are outcomes");
  for (std::size_t i = 0; i < situations; ++i) {
    bool any = false;
    for (int m = 0; m < n; ++m) any = any || all.allowed[i * static_cast<std::size_t>(n) + m] == 1;
    if (!any) refuse_entry("allowed", i, "no motion of a situation", "at least one");
  }
  require_path("habit", all.habit, situations, n);
  require_path("path", all.path, situations, n);
}

// The laws of habit, round and decision.
void require_course(const AdaptiveState& state) {
  const AdaptiveArrays& all = state.arrays;
  const std::size_t situations = all.situation.size();
  const AdaptiveHabit& habit = state.habit;
  detail::require_fields(habit);
  require_number("habit.start", habit.start, situations);
  const bool any_habit = habit.cost < kInfinity;
  require_law(any_habit == (habit.start >= 0), "habit.start", std::to_string(habit.start),
              "-1 where there is no habit, and only there");
  const bool from_start =
      !all.habit.situation.empty() && static_cast<long long>(all.habit.situation[0]) == habit.start;
  require_law(any_habit ? from_start : all.habit.situation.empty(), "habit.situation",
              std::to_string(all.habit.situation.size()) + " situations",
              "those of the habit, from its start");
  require_law(habit.least <= habit.cost, "habit.least", to_text(habit.least),
              "no more than the habit's cost");

  const AdaptiveRound& round = state.round;
  detail::require_fields(round);
  require_number("round.start", round.start, situations);
  require_number("round.target_situation", round.target_situation, situations);
  require_count("round.target_motion", round.target_motion, -1, state.config.motion_count - 1);
  require_law((round.target_situation < 0) == (round.target_motion < 0), "round.target_motion",
              std::to_string(round.target_motion), "-1 where there is no target, and only there");
  const auto& way = all.path.situation;
  require_law(way.empty() || (round.begun && static_cast<long long>(way[0]) == round.start),
              "path.situation", std::to_string(way.size()) + " situations",
              "those of the round, from its start");
  require_law(
      !round.by_habit || (round.begun && !round.over && any_habit && round.start == habit.start),
      "round.by_habit", "true", "false but in a round from where the habit begins");
  require_law(!round.curious || state.config.curious_every > 0, "round.curious", "true",
              "false without curious rounds");

  const AdaptiveDecision& decision = state.decision;
  detail::require_fields(decision);
  require_number("decision.situation", decision.situation, situations);
  const bool open = decision.situation >= 0;
  require_count("decision.motion", decision.motion, open ? 0 : -1,
                open ? state.config.motion_count - 1 : -1);
  require_law(open || !decision.waiting, "decision.waiting", "true", "false without a decision");
  require_law(!open || decision.waiting || decision.steps > 0, "decision.steps", "0",
              "at least 1, or a choice that waits");
  require_law(decision.steps == 0 || decision.steps < state.config.hold_limit, "decision.steps",
              std::to_string(decision.steps), "below hold_limit");
  if (open && decision.steps > 0 && round.begun && !round.over) {
    const auto here = static_cast<std::uint32_t>(decision.situation);
    require_law(std::find(way.begin(), way.end(), here) != way.end(), "decision.situation",
                std::to_string(decision.situation), "one on the round's path");
  }

  for (const auto* sweep : {&state.home, &state.falling, &state.hope}) {
    detail::require_fields(*sweep);
    require_number("sweep.next", sweep->next, situations);
  }
}

}  // namespace

AdaptiveLearner::AdaptiveLearner(const AdaptiveState& state)
    : AdaptiveLearner(state.config, state.seed) {
  require_in("optimism", state.optimism, 1.0, config_.optimism);
  if (state.random == Random::State{}) {
    throw InvalidValue("random", "all zeros", "a state of the generator");
  }
  require_arrays(state);
  require_course(state);
  random_ = Random(state.random);
  rounds_ = state.rounds;
  optimism_ = state.optimism;
  const AdaptiveArrays& all = state.arrays;
  reserve(all.situation.size(), all.next.size());
  for (std::size_t i = 0; i < all.situation.size(); ++i) {
    if (meet(all.situation[i], all.first_estimate[i]) != i) {
      refuse_entry("situation", i, std::to_string(all.situation[i]), "each id once");
    }
    at_[i].by_values = all.by_values[i];
  }
  known_.assign(all.known.begin(), all.known.end());
  hoped_.assign(all.hoped.begin(), all.hoped.end());
  q_.assign(all.loss.begin(), all.loss.end());
  allowed_.assign(all.allowed.begin(), all.allowed.end());
  on_trial_.assign(all.on_trial.begin(), all.on_trial.end());
  trial_loss_.assign(all.trial_loss.begin(), all.trial_loss.end());
  interrupted_.assign(all.interrupted.begin(), all.interrupted.end());
  std::size_t outcome = 0;
  for (Number each = 0; each < all.outcome_count.size(); ++each) {
    const std::size_t end = outcome + all.outcome_count[each];
    for (; outcome < end; ++outcome) {
      const Number next = all.next[outcome] < 0 ? kGoal : static_cast<Number>(all.next[outcome]);
      const std::size_t before = outcomes_.size();
      outcomes_.add(each, next, all.loss_sum[outcome], all.times[outcome]);
      if (outcomes_.size() == before) {
        refuse_entry("next", outcome, std::to_string(all.next[outcome]), "each once of a mapping");
      }
    }
    explored_count_ += all.outcome_count[each] > 0 ? 1 : 0;
  }
  for (Number i = 0; i < at_.size(); ++i) settle(i);
  // Settling tells of changes that are none: only what the state says has a priority.
  while (!priorities_.empty()) priorities_.pop();
  for (Number each = 0; each < all.priority.size(); ++each) {
    if (all.priority[each] > 0.0) priorities_.raise(each, all.priority[each]);
  }
  take(all.habit, habit_path_, &Situation::habit);
  take(all.path, path_, &Situation::decided);
  habit_ = state.habit;
  round_ = state.round;
  decision_ = state.decision;
  home_ = state.home;
  falling_ = state.falling;
  hope_ = state.hope;
}

void AdaptiveLearner::take(const AdaptivePath& from, std::vector<Waypoint>& path,
                           std::int32_t Situation::*place) {
  for (std::size_t i = 0; i < from.situation.size(); ++i) {
    at_[from.situation[i]].*place = static_cast<std::int32_t>(i);
    path.push_back({from.situation[i], from.motion[i], from.before[i], from.estimate[i],
                    from.interrupted[i] != 0});
  }
}

AdaptivePath AdaptiveLearner::arrays_of(const std::vector<Waypoint>& path) {
  AdaptivePath arrays;
  for (const Waypoint& waypoint : path) {
    arrays.situation.push_back(waypoint.situation);
    arrays.motion.push_back(waypoint.motion);
    arrays.before.push_back(waypoint.before);
    arrays.estimate.push_back(waypoint.estimate);
    arrays.interrupted.push_back(waypoint.interrupted ? 1 : 0);
  }
  return arrays;
}

AdaptiveState AdaptiveLearner::state() const {
  AdaptiveState state;
  state.config = config_;
  state.seed = seed_;
  state.random = random_.state();
  state.rounds = rounds_;
  state.optimism = optimism_;
  state.habit = habit_;
  state.round = round_;
  state.decision = decision_;
  state.home = home_;
  state.falling = falling_;
  state.hope = hope_;
  AdaptiveArrays& all = state.arrays;
  all.situation = ids_.ids();
  for (const Situation& situation : at_) {
    all.first_estimate.push_back(situation.first_estimate);
    all.by_values.push_back(situation.by_values);
  }
  all.known = known_;
  all.hoped = hoped_;
  all.loss = q_;
  all.allowed = allowed_;
  all.on_trial = on_trial_;
  all.trial_loss = trial_loss_;
  all.interrupted = interrupted_;
  for (Number each = 0; each < q_.size(); ++each) {
    all.priority.push_back(priorities_.priority(each));
    const std::size_t before = all.next.size();
    outcomes_.each_of(each, [&](const detail::OutcomeStore::Outcome& outcome) {
      all.next.push_back(outcome.next == kGoal ? -1 : static_cast<std::int32_t>(outcome.next));
      all.times.push_back(outcome.times);
      all.loss_sum.push_back(outcome.sum);
    });
    all.outcome_count.push_back(static_cast<std::uint32_t>(all.next.size() - before));
  }
  all.habit = arrays_of(habit_path_);
  all.path = arrays_of(path_);
  return state;
}

}  // namespace devlearn
