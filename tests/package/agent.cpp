// A program with an agent of its own, which needs no simulation: it goes on as before until it is
// stopped, then draws another motion. It prints its history.
#include "devlearn/agent.hpp"

#include <cstdio>
#include <cstdlib>

namespace {

class Stubborn final : public devlearn::Agent {
 public:
  devlearn::Choice choose(const devlearn::Observation& observation) override {
    if (stopped_) motion_ = static_cast<int>(random_.index(observation.motion_count));
    return {motion_, devlearn::Kind::kUnstated};
  }
  devlearn::Development observe(const devlearn::Outcome& outcome) override {
    stopped_ = outcome.collided;
    return {};
  }

 private:
  devlearn::Random random_{1, "agent"};
  int motion_ = 0;
  bool stopped_ = true;
};

// A corridor of ten places whose ends stop whoever walks it.
int walked(devlearn::Agent& agent, int steps) {
  devlearn::Observation seen;
  seen.motion_count = 2;
  seen.situation = 5;
  int stops = 0;
  for (int step = 0; step < steps; ++step) {
    const int motion = agent.choose(seen).motion;
    std::printf("%d %d\n", static_cast<int>(seen.situation), motion);
    const devlearn::SituationId next = seen.situation + (motion == 0 ? -1 : 1);
    devlearn::Outcome outcome;
    outcome.collided = next < 0 || next > 9;
    outcome.situation = outcome.collided ? seen.situation : next;
    agent.observe(outcome);
    seen.situation = outcome.situation;
    stops += outcome.collided;
  }
  return stops;
}

}  // namespace

int main() {
  Stubborn agent;
  return walked(agent, 200) > 10 ? EXIT_SUCCESS : EXIT_FAILURE;
}
