#include "devlearn/prioritized_sweeping.hpp"

#include <cmath>

#include "agent_snapshot.hpp"

namespace devlearn {

using detail::kNoRow;
using detail::Row;

PrioritizedSweeping::PrioritizedSweeping(const Config& config, std::uint64_t seed)
    : config_((config.validate(), config)), table_(detail::ValueTable::rules(config), seed) {}

Choice PrioritizedSweeping::choose(const Observation& observation) {
  return table_.choose(observation, config_.epsilon);
}

// (d) to (g) of prioritized sweeping for a deterministic environment.
Development PrioritizedSweeping::observe(const Outcome& outcome) {
  const auto [row, motion, reward, next] = table_.observe(outcome);
  const std::size_t pair = table_.pair(row, motion);
  fit();
  if (model_.tried(pair) && model_.next(pair) != kNoRow) leading_[model_.next(pair)].erase(pair);
  if (next != kNoRow) leading_[next].insert(pair);
  model_.learn(pair, reward, next);
  queue(pair);

  for (int i = 0; i < config_.planning_steps && !queue_.empty(); ++i) {
    const std::size_t first = queue_.begin()->second;
    queue_.erase(queue_.begin());
    priority_[first] = 0.0;
    table_.learn(first, config_.alpha, target(first));
    ++updates_;
    const auto changed = first / static_cast<std::size_t>(table_.motion_count());
    for (const std::size_t before : leading_[changed]) queue(before);
  }
  return {};
}

// What the model says of a pair that was tried.
double PrioritizedSweeping::target(std::size_t pair) const noexcept {
  return model_.reward(pair) + config_.gamma * table_.max(model_.next(pair));
}

// By how much its value would change, if that is more than it is queued by.
void PrioritizedSweeping::queue(std::size_t pair) {
  const double priority = std::abs(target(pair) - table_.q(pair));
  if (!(priority > config_.theta && priority > priority_[pair])) return;
  if (priority_[pair] > 0.0) queue_.erase({-priority_[pair], pair});
  queue_.emplace(-priority, pair);
  priority_[pair] = priority;
}

void PrioritizedSweeping::fit() {
  model_.fit(table_);
  leading_.resize(table_.rows());
  priority_.resize(table_.pairs());
}

std::optional<AgentState> PrioritizedSweeping::state() const {
  AgentState state = state_of(kKind, config_);
  table_.describe(state);
  model_.describe(table_, state);
  std::vector<double> priority = priority_;
  priority.resize(table_.pairs());
  add_entry(state, "updates", updates_);
  state.arrays["priority"] = array_of(
      std::move(priority), {table_.rows(), static_cast<std::uint64_t>(table_.motion_count())});
  return state;
}

PrioritizedSweeping::PrioritizedSweeping(const AgentState& state, const std::string& source)
    : config_(config_of<Config>(kKind, state, source)),
      table_(detail::ValueTable::rules(config_), state, source),
      model_(table_, state, source),
      updates_(entry_of<std::uint64_t>(state, "updates", source)) {
  const Shape shape{table_.rows(), static_cast<std::uint64_t>(table_.motion_count())};
  std::size_t pair = 0;
  priority_ =
      values_of<double>(state, "priority", shape, source, [&](const char* name, double priority) {
        const bool queued = priority > config_.theta && std::isfinite(priority);
        if (!(priority == 0.0 || (queued && model_.tried(pair)))) {
          throw InvalidValue(name, to_text(priority),
                             "above theta for a motion that was tried and is queued, else 0");
        }
        ++pair;
      });
  leading_.resize(table_.rows());
  for (pair = 0; pair < table_.pairs(); ++pair) {
    if (priority_[pair] > 0.0) queue_.emplace(-priority_[pair], pair);
    if (model_.tried(pair) && model_.next(pair) != kNoRow) leading_[model_.next(pair)].insert(pair);
  }
}

}  // namespace devlearn
