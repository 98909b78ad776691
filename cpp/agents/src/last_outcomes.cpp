#include "devlearn/detail/last_outcomes.hpp"

#include "agent_snapshot.hpp"

namespace devlearn::detail {

void LastOutcomes::describe(const ValueTable& table, AgentState& state) const {
  LastOutcomes all = *this;  // also of situations met since the last outcome
  all.fit(table);
  const Shape shape{table.rows(), static_cast<std::uint64_t>(table.motion_count())};
  state.arrays["last_reward"] = array_of(std::move(all.reward_), shape);
  state.arrays["last_next"] = array_of(std::move(all.next_), shape);
}

LastOutcomes::LastOutcomes(const ValueTable& table, const AgentState& state,
                           const std::string& source) {
  const Shape shape{table.rows(), static_cast<std::uint64_t>(table.motion_count())};
  reward_ = values_of<double>(state, "last_reward", shape, source, ValueTable::require_bounded);
  next_ = values_of<Row>(state, "last_next", shape, source, [&](const char* name, Row row) {
    if (row >= table.rows() && row != kUntried && row != kNoRow) {
      throw InvalidValue(name, std::to_string(row), "a row of the table, untried, or an arrival");
    }
  });
}

}  // namespace devlearn::detail
