#include "devlearn/random_agent.hpp"

#include <vector>

#include "learner_snapshot.hpp"

namespace devlearn {

RandomAgent::RandomAgent(const AgentState& state, const std::string& source)
    : random_(random_of({state.texts, state.arrays}, source)) {}

Choice RandomAgent::choose(const Observation& observation) {
  const AllowedMotions allowed = observation.allowed;
  int motions = 0;
  for (int motion = 0; motion < observation.motion_count; ++motion) motions += allowed(motion);
  auto draw = random_.index(static_cast<std::uint32_t>(motions));
  int motion = 0;
  while (!allowed(motion) || draw-- > 0) ++motion;
  return {motion, Kind::kUnstated};
}

Development RandomAgent::observe(const Outcome&) { return {}; }

std::optional<AgentState> RandomAgent::state() const {
  const Random::State words = random_.state();
  const std::vector<std::uint64_t> values(words.begin(), words.end());
  return AgentState{kKind, {}, {{"random", array_of(values)}}};
}

}  // namespace devlearn
