#include "devlearn/detail/transition_counts.hpp"

#include <algorithm>

#include "agent_snapshot.hpp"

namespace devlearn::detail {
namespace {

constexpr std::uint32_t kMost = 0x7fffffff;  // of a pair

}  // namespace

bool TransitionCounts::learn(std::size_t pair, Row next) {
  if (visits_[pair] == kMost) return false;
  ++visits_[pair];
  const bool first = ++next_[pair][next] == 1;
  if (first) lead(pair, next);
  return first;
}

void TransitionCounts::lead(std::size_t pair, Row next) {
  if (next == kNoRow) return;
  std::vector<std::size_t>& pairs = leading_[next];
  pairs.insert(std::lower_bound(pairs.begin(), pairs.end(), pair), pair);
}

Row TransitionCounts::draw(std::size_t pair, Random& random) const {
  const auto& next = next_[pair];
  if (next.size() == 1) return next.begin()->first;
  std::uint32_t left = random.index(visits_[pair]);
  auto one = next.begin();
  while (left >= one->second) left -= (one++)->second;
  return one->first;
}

void TransitionCounts::describe(AgentState& state) const {
  std::vector<std::uint64_t> pairs;
  std::vector<Row> rows;
  std::vector<std::uint32_t> counts;
  for (std::size_t pair = 0; pair < next_.size(); ++pair) {
    for (const auto& [row, count] : next_[pair]) {
      pairs.push_back(pair);
      rows.push_back(row);
      counts.push_back(count);
    }
  }
  add_entry(state, "transitions", std::uint64_t{pairs.size()});
  state.arrays["transition_pair"] = array_of(std::move(pairs));
  state.arrays["transition_next"] = array_of(std::move(rows));
  state.arrays["transition_count"] = array_of(std::move(counts));
}

TransitionCounts::TransitionCounts(const ValueTable& table, const AgentState& state,
                                   const std::string& source) {
  fit(table);
  const Shape shape{entry_of<std::uint64_t>(state, "transitions", source)};
  const auto pairs = values_of<std::uint64_t>(
      state, "transition_pair", shape, source, [&](const char* name, std::uint64_t pair) {
        if (pair < table.pairs()) return;
        throw InvalidValue(name, std::to_string(pair), "below " + std::to_string(table.pairs()));
      });
  const auto rows =
      values_of<Row>(state, "transition_next", shape, source, [&](const char* name, Row row) {
        if (row < table.rows() || row == kNoRow) return;
        throw InvalidValue(name, std::to_string(row), "a row of the table, or an arrival");
      });
  std::size_t i = 0;
  values_of<std::uint32_t>(
      state, "transition_count", shape, source, [&](const char* name, std::uint32_t count) {
        const std::size_t pair = pairs[i];
        if (count == 0 || count > kMost - visits_[pair] ||
            !next_[pair].emplace(rows[i], count).second) {
          throw InvalidValue(name, std::to_string(count),
                             "at least 1, once for where a pair led, and below 2^31 in all");
        }
        visits_[pair] += count;
        lead(pair, rows[i]);
        ++i;
      });
}

}  // namespace devlearn::detail
