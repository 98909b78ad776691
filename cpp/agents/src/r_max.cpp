#include "devlearn/r_max.hpp"

#include <algorithm>
#include <cmath>

#include "agent_snapshot.hpp"

namespace devlearn {

using detail::kNoRow;
using detail::Row;
using detail::ValueTable;

RMax::RMax(const Config& config, std::uint64_t seed)
    : config_((config.validate(), config)), table_(rules(config), seed) {}

Choice RMax::choose(const Observation& observation) { return table_.choose(observation, 0.0); }

Development RMax::observe(const Outcome& outcome) {
  const auto [row, motion, reward, next] = table_.observe(outcome);
  const std::size_t pair = table_.pair(row, motion);
  fit();
  if (!known(pair)) {
    next_[pair * static_cast<std::size_t>(config_.m) + visits_[pair]] = next;
    reward_[pair] = ValueTable::bounded(reward_[pair] + reward);
    ++visits_[pair];
    if (known(pair)) add_leading(pair);
  }
  plan_from(row);  // also where other motions are allowed than before
  return {};
}

double RMax::worth(Row row) const noexcept { return row == kNoRow ? 0.0 : worth_[row]; }

// Room for all situations met; new ones are worth their first value.
void RMax::fit() {
  visits_.resize(table_.pairs());
  reward_.resize(table_.pairs());
  next_.resize(table_.pairs() * static_cast<std::size_t>(config_.m));
  leading_.resize(table_.rows());
  while (worth_.size() < table_.rows()) {
    worth_.push_back(table_.max(static_cast<Row>(worth_.size())));
  }
}

void RMax::add_leading(std::size_t pair) {
  const auto m = static_cast<std::size_t>(config_.m);
  const auto row = static_cast<Row>(pair / static_cast<std::size_t>(table_.motion_count()));
  for (std::size_t i = pair * m; i < (pair + 1) * m; ++i) {
    if (next_[i] != kNoRow) leading_[next_[i]].insert(row);
  }
}

// Value iteration from a row backwards, as far as values change.
void RMax::plan_from(Row row) {
  std::deque<Row> queue{row};
  std::set<Row> queued{row};
  while (!queue.empty()) {
    const Row first = queue.front();
    queue.pop_front();
    queued.erase(first);
    if (!plan(first)) continue;
    for (const Row before : leading_[first]) {
      if (queued.insert(before).second) queue.push_back(before);
    }
  }
}

// The known motions' values in a row; whether the row's own changed.
bool RMax::plan(Row row) {
  const auto m = static_cast<std::size_t>(config_.m);
  for (int motion = 0; motion < table_.motion_count(); ++motion) {
    const std::size_t pair = table_.pair(row, motion);
    if (!known(pair)) continue;
    double future = 0.0;
    for (std::size_t i = pair * m; i < (pair + 1) * m; ++i) future += worth(next_[i]);
    const double value = (reward_[pair] + config_.gamma * future) / config_.m;
    table_.set(pair, std::max(value, config_.least_value));
  }
  const double value = table_.max(row);
  if (!(std::abs(value - worth_[row]) > config_.theta)) return false;
  worth_[row] = value;
  return true;
}

int RMax::visits(SituationId situation, int motion) const {
  const std::optional<std::size_t> pair = table_.find(situation, motion);
  return pair && *pair < visits_.size() ? static_cast<int>(visits_[*pair]) : 0;
}

std::optional<AgentState> RMax::state() const {
  RMax all = *this;  // also of situations met since the last outcome
  all.fit();
  AgentState state = state_of(kKind, config_);
  table_.describe(state);
  const std::uint64_t rows = table_.rows();
  const auto motions = static_cast<std::uint64_t>(table_.motion_count());
  const auto m = static_cast<std::uint64_t>(config_.m);
  state.arrays["visits"] = array_of(std::move(all.visits_), {rows, motions});
  state.arrays["reward"] = array_of(std::move(all.reward_), {rows, motions});
  state.arrays["next"] = array_of(std::move(all.next_), {rows, motions, m});
  state.arrays["worth"] = array_of(std::move(all.worth_), {rows});
  return state;
}

RMax::RMax(const AgentState& state, const std::string& source)
    : config_(config_of<Config>(kKind, state, source)), table_(rules(config_), state, source) {
  const std::uint64_t rows = table_.rows();
  const auto motions = static_cast<std::uint64_t>(table_.motion_count());
  const auto m = static_cast<std::uint64_t>(config_.m);
  visits_ = values_of<std::uint32_t>(
      state, "visits", {rows, motions}, source,
      [&](const char* name, std::uint32_t visits) { require_count(name, visits, 0, config_.m); });
  reward_ =
      values_of<double>(state, "reward", {rows, motions}, source, ValueTable::require_bounded);
  next_ = values_of<Row>(state, "next", {rows, motions, m}, source, [&](const char* name, Row row) {
    if (row < rows || row == kNoRow) return;
    throw InvalidValue(name, std::to_string(row), "a row of the table, or an arrival");
  });
  worth_ = values_of<double>(state, "worth", {rows}, source, ValueTable::require_bounded);
  leading_.resize(table_.rows());
  for (std::size_t pair = 0; pair < table_.pairs(); ++pair) {
    if (known(pair)) add_leading(pair);
  }
}

}  // namespace devlearn
