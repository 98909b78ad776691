#include "devlearn/q_learning.hpp"

#include "agent_snapshot.hpp"

namespace devlearn {

QLearning::QLearning(const Config& config, std::uint64_t seed)
    : config_((config.validate(), config)), table_(detail::ValueTable::rules(config), seed) {}

QLearning::QLearning(const AgentState& state, const std::string& source)
    : config_(config_of<Config>(kKind, state, source)),
      table_(detail::ValueTable::rules(config_), state, source) {}

Choice QLearning::choose(const Observation& observation) {
  return table_.choose(observation, config_.epsilon);
}

Development QLearning::observe(const Outcome& outcome) {
  const auto [row, motion, reward, next] = table_.observe(outcome);
  table_.learn(table_.pair(row, motion), config_.alpha, reward + config_.gamma * table_.max(next));
  return {};
}

std::optional<AgentState> QLearning::state() const {
  AgentState state = state_of(kKind, config_);
  table_.describe(state);
  return state;
}

}  // namespace devlearn
