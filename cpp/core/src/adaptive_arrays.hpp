#pragma once

#include <cstdint>

#include "devlearn/adaptive.hpp"
#include "devlearn/state.hpp"

namespace devlearn {

/// How long the arrays are: situations, motions, outcomes, waypoints of the habit and of the round;
/// those of curious rounds are empty where there are none.
struct AdaptiveSizes {
  std::uint64_t situations = 0, motions = 0, outcomes = 0, habit = 0, path = 0;
  bool curious = false;
};

inline AdaptiveSizes sizes_of(const AdaptiveState& state) {
  const AdaptiveArrays& all = state.arrays;
  return {all.situation.size(),      static_cast<std::uint64_t>(state.config.motion_count),
          all.next.size(),           all.habit.situation.size(),
          all.path.situation.size(), state.config.curious_every > 0};
}

/// visit(name, values, shape) of every one.
template <typename Arrays, typename Visit>
void each_array(Arrays& all, const AdaptiveSizes& sizes, const Visit& visit) {
  const Shape situations{sizes.situations}, outcomes{sizes.outcomes};
  const Shape mappings{sizes.situations, sizes.motions};
  const Shape hoped{sizes.curious ? sizes.situations : 0};
  const Shape trials{sizes.curious ? sizes.situations : 0, sizes.motions};
  visit("situation", all.situation, situations);
  visit("first_estimate", all.first_estimate, situations);
  visit("by_values", all.by_values, situations);
  visit("known", all.known, situations);
  visit("hoped", all.hoped, hoped);
  visit("loss", all.loss, mappings);
  visit("allowed", all.allowed, mappings);
  visit("priority", all.priority, mappings);
  visit("on_trial", all.on_trial, mappings);
  visit("trial_loss", all.trial_loss, trials);
  visit("interrupted", all.interrupted, mappings);
  visit("outcome_count", all.outcome_count, mappings);
  visit("next", all.next, outcomes);
  visit("times", all.times, outcomes);
  visit("loss_sum", all.loss_sum, outcomes);
  visit("habit.situation", all.habit.situation, Shape{sizes.habit});
  visit("habit.motion", all.habit.motion, Shape{sizes.habit});
  visit("habit.before", all.habit.before, Shape{sizes.habit});
  visit("habit.estimate", all.habit.estimate, Shape{sizes.habit});
  visit("habit.interrupted", all.habit.interrupted, Shape{sizes.habit});
  visit("path.situation", all.path.situation, Shape{sizes.path});
  visit("path.motion", all.path.motion, Shape{sizes.path});
  visit("path.before", all.path.before, Shape{sizes.path});
  visit("path.estimate", all.path.estimate, Shape{sizes.path});
  visit("path.interrupted", all.path.interrupted, Shape{sizes.path});
}

}  // namespace devlearn
