#include "devlearn/random_agent.hpp"

#include <vector>

#include "candidates.hpp"
#include "learner_snapshot.hpp"

namespace devlearn {

RandomAgent::RandomAgent(const AgentState& state, const std::string& source)
    : random_(random_of({state.texts, state.arrays}, source)) {}

Choice RandomAgent::choose(const Observation& observation) {
  const AllowedMotions allowed = observation.allowed;
  const std::uint32_t motions = count_candidates(observation.motion_count, allowed);
  return {nth_candidate(random_.index(motions), allowed), Kind::kUnstated};
}

Development RandomAgent::observe(const Outcome&) { return {}; }

std::optional<AgentState> RandomAgent::state() const {
  const Random::State words = random_.state();
  const std::vector<std::uint64_t> values(words.begin(), words.end());
  return AgentState{kKind, {}, {{"random", array_of(values)}}};
}

}  // namespace devlearn
