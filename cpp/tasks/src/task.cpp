#include "devlearn/task.hpp"

#include <limits>
#include <optional>
#include <string>

#include "devlearn/detail/require.hpp"
#include "devlearn/random.hpp"

namespace devlearn {
namespace {

// As environments of others take seeds, too: in [0, 2^31).
std::uint64_t seed_of(std::uint64_t seed, std::int64_t episode) {
  return Random(seed, "episode " + std::to_string(episode)).next() % (std::uint64_t{1} << 31U);
}

// An episode that has begun; nothing where it is interrupted.
std::optional<Episode> live(Task& task, Agent& agent, const EpisodesOptions& options) {
  Episode episode;
  while (!episode.ended && episode.steps < options.step_limit) {
    if (options.interrupt && options.interrupt()) return std::nullopt;
    const Choice choice = agent.choose(task.observation());
    const Outcome outcome = [&] {
      try {
        return task.step(choice.motion);
      } catch (...) {
        agent.cancel();
        throw;
      }
    }();
    agent.observe(outcome);
    episode.reward += outcome.reward();
    ++episode.steps;
    episode.ended = outcome.arrived;
  }
  episode.succeeded = episode.ended && task.succeeded();
  return episode;
}

}  // namespace

void run_episodes(Task& task, Agent& agent, const EpisodesOptions& options,
                  std::vector<Episode>& episodes) {
  constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
  require_count("episodes", options.count, 0, kMost);
  require_count("first", options.first, 0, kMost - options.count);
  require_count("step_limit", options.step_limit, 1, kMost);
  for (std::int64_t i = 0; i < options.count; ++i) {
    task.begin(seed_of(options.seed, options.first + i));
    agent.begin_round();
    const std::optional<Episode> episode = live(task, agent, options);
    agent.end_round(episode && episode->succeeded);
    if (!episode) return;
    episodes.push_back(*episode);
  }
}

}  // namespace devlearn
