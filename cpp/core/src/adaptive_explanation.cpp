// What an adaptive learner says of itself.
#include <algorithm>
#include <cstdio>

#include "devlearn/adaptive.hpp"
#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "lines.hpp"

namespace devlearn {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kAbsent = detail::SituationIndex::kAbsent;

// Of each to be chosen by values: the last one so chosen, while it is among the best; else any of
// these.
std::vector<double> probabilities(const AdaptiveMemory& memory, const std::vector<bool>& allowed,
                                  int last) {
  double least = kInfinity;
  for (std::size_t m = 0; m < allowed.size(); ++m) {
    if (allowed[m]) least = std::min(least, memory.losses[m]);
  }
  const auto among = [&](std::size_t m) {
    return allowed[m] && memory.losses[m] <= least + detail::kSameLoss;
  };
  const bool again = last >= 0 && among(static_cast<std::size_t>(last));
  std::vector<double> probability(allowed.size());
  for (std::size_t m = 0; m < allowed.size(); ++m) {
    probability[m] = among(m) && (!again || m == static_cast<std::size_t>(last)) ? 1.0 : 0.0;
  }
  const auto count = static_cast<double>(std::count(probability.begin(), probability.end(), 1.0));
  for (double& each : probability) each /= count;
  return probability;
}

// What a draw by values goes by, as far as that is sure.
Kind kind_of_draw(const AdaptiveExplanation& why) {
  bool tried = false, untried = false;
  for (std::size_t m = 0; m < why.probability.size(); ++m) {
    if (why.probability[m] > 0.0) (why.memory.times[m] > 0 ? tried : untried) = true;
  }
  return tried && untried ? Kind::kUnstated : tried ? Kind::kExploit : Kind::kExplore;
}

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::kExplore:
      return "by values, not yet tried";
    case Kind::kHabit:
      return "by habit";
    case Kind::kDeviation:
      return "to deviate from the habit";
    case Kind::kHeld:
      return "held";
    default:
      return "by values";
  }
}

}  // namespace

std::optional<double> AdaptiveLearner::expected_loss(SituationId situation) const noexcept {
  const Number here = ids_.find(situation);
  if (here == kAbsent) return std::nullopt;
  return at_[here].loss;
}

std::optional<double> AdaptiveLearner::habit_cost() const noexcept {
  if (habit_.cost == kInfinity) return std::nullopt;
  return habit_.cost;
}

std::optional<Choice> AdaptiveLearner::pending() const noexcept {
  if (!decision_.waiting) return std::nullopt;
  return Choice{decision_.motion, decision_.steps > 0 ? Kind::kHeld : decision_.kind};
}

// A situation's lists follow from its losses.
AdaptiveMemory AdaptiveLearner::memory_of(double first_estimate, double loss, const double* losses,
                                          const std::uint32_t* times) const {
  const std::size_t n = motions();
  AdaptiveMemory memory{first_estimate, loss, {losses, losses + n}, {times, times + n}, {}, {}, {}};
  for (int m = 0; m < config_.motion_count; ++m) {
    auto& list = times[m] == 0       ? memory.unexplored
                 : losses[m] <= loss ? memory.effective
                                     : memory.ineffective;
    list.push_back(m);
  }
  return memory;
}

AdaptiveMemory AdaptiveLearner::situation(SituationId situation) const {
  require_situation(situation);
  const Number here = ids_.find(situation);
  std::vector<std::uint32_t> times(motions());
  if (here == kAbsent) {
    return memory_of(0.0, 0.0, std::vector<double>(motions()).data(), times.data());
  }
  for (int m = 0; m < config_.motion_count; ++m) times[m] = outcomes_.times(mapping(here, m));
  return memory_of(at_[here].first_estimate, at_[here].loss, &q_[mapping(here, 0)], times.data());
}

AdaptiveExplanation AdaptiveLearner::explain(SituationId situation, AllowedMotions allowed) const {
  allowed.validate(config_.motion_count);
  AdaptiveExplanation why;
  why.situation = situation;
  why.memory = this->situation(situation);
  for (int m = 0; m < config_.motion_count; ++m) why.allowed.push_back(allowed(m));
  const Number here = ids_.find(situation);
  const bool met = here != kAbsent;
  why.probability = probabilities(why.memory, why.allowed, met ? at_[here].by_values : -1);
  why.homeward = homeward();
  if (met) {
    if (decision_.situation == static_cast<int>(here)) why.held = decision_.motion;
    why.deviation = deviation_here(here);
    if (goes_by_habit()) why.habit = habit_motion(here);
  }
  // What can be told without a draw.
  const auto sure = std::find(why.probability.begin(), why.probability.end(), 1.0);
  std::optional<Choice> choice;
  if (why.held >= 0 && allowed(why.held)) {
    choice = {why.held, Kind::kHeld};
  } else if (met) {
    choice = settled_choice(here, allowed);
  }
  if (!choice && !why.homeward && sure != why.probability.end()) {
    choice = {static_cast<int>(sure - why.probability.begin()), kind_of_draw(why)};
  }
  if (choice) {
    why.motion = choice->motion;
    why.kind = choice->kind;
  } else {
    why.kind = why.homeward ? Kind::kUnstated : kind_of_draw(why);
  }
  why.recollections = recollected_;
  return why;
}

std::optional<AdaptiveExplanation> AdaptiveLearner::last_choice() const {
  if (last_.choice.motion < 0) return std::nullopt;
  AdaptiveExplanation why;
  why.situation = ids_.id(last_.situation);
  why.memory = memory_of(at_[last_.situation].first_estimate, last_.loss, last_.losses.data(),
                         last_.times.data());
  why.allowed.assign(last_.allowed.begin(), last_.allowed.end());
  why.probability = probabilities(why.memory, why.allowed, last_.by_values);
  why.deviation = last_.deviation;
  why.habit = last_.habit;
  why.homeward = last_.homeward;
  why.kind = last_.choice.kind;
  why.motion = last_.choice.motion;
  why.recollections = recollected_;
  return why;
}

MemoryUse AdaptiveLearner::memory_use() const noexcept {
  MemoryUse use;
  std::size_t held = 0;
  const auto count = [&](const auto& values) {
    use.used += values.size() * sizeof values[0];
    held += values.capacity() * sizeof values[0];
  };
  count(at_);
  count(known_);
  count(hoped_);
  count(q_);
  count(allowed_);
  count(on_trial_);
  count(trial_loss_);
  count(interrupted_);
  count(habit_path_);
  count(path_);
  use.used += ids_.bytes_used() + outcomes_.bytes_used() + priorities_.bytes_used();
  held += ids_.bytes() + outcomes_.bytes() + priorities_.bytes();
  use.spare = held - use.used;
  return use;
}

std::string to_text(const AdaptiveExplanation& why) {
  std::string text = "situation " + std::to_string(why.situation);
  append(text, ": E %.4g, estimate at the first meeting %.4g\n", why.memory.expected_loss,
         why.memory.first_estimate);
  if (why.motion >= 0) {
    append(text, "motion %d, %s", why.motion, name_of(why.kind));
  } else {
    append(text, "a motion %s", name_of(why.kind));
  }
  text += why.homeward ? ", on the way home by what is known\n" : "\n";
  text += "motion  list         loss q     tried  by values\n";
  for (std::size_t m = 0; m < why.allowed.size(); ++m) {
    const int motion = static_cast<int>(m);
    const bool tried = why.memory.times[m] > 0;
    const bool effective = tried && why.memory.losses[m] <= why.memory.expected_loss;
    append(text, "%6d  %-11s  %-9.4g  %-5u  %.4g%s%s%s%s\n", motion,
           !tried      ? "unexplored"
           : effective ? "effective"
                       : "ineffective",
           why.memory.losses[m], why.memory.times[m], why.probability[m],
           motion == why.held ? "  (held)" : "", motion == why.habit ? "  (habit)" : "",
           motion == why.deviation ? "  (deviation)" : "", why.allowed[m] ? "" : "  (not allowed)");
  }
  return text;
}

}  // namespace devlearn
