#include "devlearn/lrta_star.hpp"

#include "agent_snapshot.hpp"

namespace devlearn {

LrtaStar::LrtaStar(const Config& config, std::uint64_t seed)
    : config_((config.validate(), config)), table_(rules(config), seed) {}

Choice LrtaStar::choose(const Observation& observation) {
  const detail::Row row = table_.meet(observation);
  model_.fit(table_);
  const double here = table_.max(row);  // for what led back
  for (int motion = 0; motion < table_.motion_count(); ++motion) {
    const std::size_t pair = table_.pair(row, motion);
    if (!model_.tried(pair)) continue;
    const detail::Row next = model_.next(pair);
    table_.set(pair, model_.reward(pair) + (next == row ? here : table_.max(next)));
  }
  return table_.choose(row, 0.0);
}

Development LrtaStar::observe(const Outcome& outcome) {
  if (!(outcome.cost > 0.0)) throw InvalidValue("cost", to_text(outcome.cost), "above 0");
  const auto [row, motion, reward, next] = table_.observe(outcome);
  const std::size_t pair = table_.pair(row, motion);
  model_.fit(table_);
  model_.learn(pair, reward, next);
  table_.set(pair, reward + table_.max(next));
  return {};
}

std::optional<AgentState> LrtaStar::state() const {
  AgentState state = state_of(kKind, config_);
  table_.describe(state);
  model_.describe(table_, state);
  return state;
}

LrtaStar::LrtaStar(const AgentState& state, const std::string& source)
    : config_(config_of<Config>(kKind, state, source)),
      table_(rules(config_), state, source),
      model_(table_, state, source) {}

}  // namespace devlearn
