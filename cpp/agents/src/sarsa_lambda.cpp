#include "devlearn/sarsa_lambda.hpp"

#include <algorithm>
#include <limits>

#include "agent_snapshot.hpp"

namespace devlearn {
namespace {

constexpr double kLeastTrace = 1e-10;

}  // namespace

SarsaLambda::SarsaLambda(const Config& config, std::uint64_t seed)
    : config_((config.validate(), config)), table_(detail::ValueTable::rules(config), seed) {}

Choice SarsaLambda::choose(const Observation& observation) {
  const detail::Row row = table_.meet(observation);
  if (last_ && last_->next != row) forget_round();
  return table_.choose(row, config_.epsilon);
}

Development SarsaLambda::observe(const Outcome& outcome) {
  const detail::Transition now = table_.observe(outcome);
  const std::size_t pair = table_.pair(now.row, now.motion);
  if (last_) {
    learn(table_.pair(last_->row, last_->motion), last_->reward + config_.gamma * table_.q(pair));
  }
  last_ = now;
  if (outcome.arrived) {
    learn(pair, now.reward);
    forget_round();
  }
  return {};
}

// One step of 12.7 for the pair that was visited.
void SarsaLambda::learn(std::size_t pair, double target) {
  const double delta = target - table_.q(pair);
  const auto found = std::find(traced_.begin(), traced_.end(), pair);
  const auto visited = static_cast<std::size_t>(found - traced_.begin());
  if (found == traced_.end()) {
    traced_.push_back(pair);
    traces_.push_back(0.0);
  }
  traces_[visited] = config_.traces == Traces::kReplacing ? 1.0 : traces_[visited] + 1.0;

  const double decay = config_.gamma * config_.trace_decay;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < traced_.size(); ++i) {
    const auto at = static_cast<std::size_t>(traced_[i]);
    table_.set(at, table_.q(at) + config_.alpha * delta * traces_[i]);
    const double trace = traces_[i] * decay;
    if (trace < kLeastTrace) continue;
    traced_[kept] = traced_[i];
    traces_[kept++] = trace;
  }
  traced_.resize(kept);
  traces_.resize(kept);
}

void SarsaLambda::forget_round() {
  last_.reset();
  traced_.clear();
  traces_.clear();
}

std::optional<AgentState> SarsaLambda::state() const {
  AgentState state = state_of(kKind, config_);
  table_.describe(state);
  if (last_) {
    add_entry(state, "last_row", std::uint64_t{last_->row});
    add_entry(state, "last_motion", last_->motion);
    add_entry(state, "last_reward", last_->reward);
    add_entry(state, "last_next", std::uint64_t{last_->next});
  }
  add_entry(state, "traced", std::uint64_t{traced_.size()});
  state.arrays["traced_pair"] = array_of(traced_);
  state.arrays["trace"] = array_of(traces_);
  return state;
}

SarsaLambda::SarsaLambda(const AgentState& state, const std::string& source)
    : config_(config_of<Config>(kKind, state, source)),
      table_(detail::ValueTable::rules(config_), state, source) {
  if (state.texts.count("last_row") > 0) {
    const auto rows = std::uint64_t{table_.rows()};
    const auto row = static_cast<detail::Row>(place_of(state, "last_row", rows, source));
    const auto next = static_cast<detail::Row>(place_of(state, "last_next", rows, source));
    const auto motion = entry_of<int>(state, "last_motion", source);
    const auto reward = entry_of<double>(state, "last_reward", source);
    made_of(source, [&] {
      require_count("last_motion", motion, 0, table_.motion_count() - 1);
      detail::ValueTable::require_bounded("last_reward", reward);
    });
    last_ = {row, motion, reward, next};
  }
  const auto traced = entry_of<std::uint64_t>(state, "traced", source);
  std::vector<bool> seen(table_.pairs());
  traced_ = values_of<std::uint64_t>(
      state, "traced_pair", {traced}, source, [&](const char* name, std::uint64_t pair) {
        if (pair >= seen.size() || seen[static_cast<std::size_t>(pair)]) {
          throw InvalidValue(name, std::to_string(pair), "each pair of the table at most once");
        }
        seen[static_cast<std::size_t>(pair)] = true;
      });
  traces_ = values_of<double>(state, "trace", {traced}, source, [](const char* name, double trace) {
    require_in(name, trace, kLeastTrace, std::numeric_limits<double>::max());
  });
}

}  // namespace devlearn
