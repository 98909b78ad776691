#include "devlearn/dyna_q.hpp"

#include <algorithm>
#include <cmath>

#include "agent_snapshot.hpp"
#include "candidates.hpp"

namespace devlearn {

using detail::Row;

DynaQ::DynaQ(const Config& config, std::uint64_t seed)
    : config_((config.validate(), config)), table_(detail::ValueTable::rules(config), seed) {}

Choice DynaQ::choose(const Observation& observation) {
  return table_.choose(observation, config_.epsilon);
}

// (d) to (f) of Tabular Dyna-Q.
Development DynaQ::observe(const Outcome& outcome) {
  const auto [row, motion, reward, next] = table_.observe(outcome);
  const std::size_t pair = table_.pair(row, motion);
  table_.learn(pair, config_.alpha, reward + config_.gamma * table_.max(next));

  model_.fit(table_);
  last_tried_.resize(table_.pairs());
  const auto first = last_tried_.begin() + static_cast<std::ptrdiff_t>(table_.pair(row, 0));
  const bool new_row = std::all_of(first, first + table_.motion_count(),
                                   [](std::uint64_t step) { return step == 0; });
  if (new_row) tried_rows_.push_back(row);
  last_tried_[pair] = ++steps_;
  model_.learn(pair, reward, next);

  for (int i = 0; i < config_.planning_steps; ++i) plan();
  return {};
}

bool DynaQ::may_be_planned(Row row, int motion) const noexcept {
  return model_.tried(table_.pair(row, motion)) ||
         (config_.kappa > 0.0 && table_.allowed(row, motion));
}

void DynaQ::plan() {
  Random& random = table_.random();
  const Row row = tried_rows_[random.index(static_cast<std::uint32_t>(tried_rows_.size()))];
  const auto candidate = [&](int each) { return may_be_planned(row, each); };
  const std::uint32_t candidates = count_candidates(table_.motion_count(), candidate);
  const int motion = nth_candidate(random.index(candidates), candidate);

  const std::size_t pair = table_.pair(row, motion);
  const bool tried = model_.tried(pair);
  const double bonus =
      config_.kappa > 0.0
          ? config_.kappa * std::sqrt(static_cast<double>(steps_ - last_tried_[pair]))
          : 0.0;
  const double reward = (tried ? model_.reward(pair) : 0.0) + bonus;
  const Row next = tried ? model_.next(pair) : row;
  table_.learn(pair, config_.alpha, reward + config_.gamma * table_.max(next));
}

std::optional<AgentState> DynaQ::state() const {
  AgentState state = state_of(kKind, config_);
  table_.describe(state);
  model_.describe(table_, state);
  std::vector<std::uint64_t> last_tried = last_tried_;
  last_tried.resize(table_.pairs());
  add_entry(state, "steps", steps_);
  add_entry(state, "tried_situations", std::uint64_t{tried_rows_.size()});
  state.arrays["last_tried"] = array_of(
      std::move(last_tried), {table_.rows(), static_cast<std::uint64_t>(table_.motion_count())});
  state.arrays["tried_row"] = array_of(tried_rows_);
  return state;
}

DynaQ::DynaQ(const AgentState& state, const std::string& source)
    : config_(config_of<Config>(kKind, state, source)),
      table_(detail::ValueTable::rules(config_), state, source),
      model_(table_, state, source),
      steps_(entry_of<std::uint64_t>(state, "steps", source)) {
  const Shape shape{table_.rows(), static_cast<std::uint64_t>(table_.motion_count())};
  std::size_t pair = 0;
  std::vector<bool> tried(table_.rows());
  last_tried_ = values_of<std::uint64_t>(
      state, "last_tried", shape, source, [&](const char* name, std::uint64_t step) {
        if (step > steps_ || (step > 0) != model_.tried(pair)) {
          throw InvalidValue(name, std::to_string(step),
                             "up to steps, and 0 for what was never tried");
        }
        if (step > 0) tried[pair / static_cast<std::size_t>(table_.motion_count())] = true;
        ++pair;
      });
  const auto count = entry_of<std::uint64_t>(state, "tried_situations", source);
  if (count != static_cast<std::uint64_t>(std::count(tried.begin(), tried.end(), true))) {
    throw FileError(source, "tried_situations", std::to_string(count),
                    "as many as there are with a motion tried");
  }
  tried_rows_ = values_of<Row>(state, "tried_row", {count}, source, [&](const char* name, Row row) {
    if (row >= tried.size() || !tried[row]) {
      throw InvalidValue(name, std::to_string(row), "each row in which a motion was tried once");
    }
    tried[row] = false;
  });
}

}  // namespace devlearn
