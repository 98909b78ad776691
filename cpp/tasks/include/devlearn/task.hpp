#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "devlearn/agent.hpp"

namespace devlearn {

/// An environment that is no world of the robot's: in episodes, with as many motions as it says.
/// What is called when:
///
///     begin, then observation and step once a step until one of them arrived or the caller stops
///
/// All that is by chance in an episode follows from its seed.
class Task {
 public:
  virtual ~Task() = default;
  /// M: motions are 0 ... motion_count - 1.
  virtual int motion_count() const noexcept = 0;
  /// Situations are 0 ... situation_count - 1.
  virtual SituationId situation_count() const noexcept = 0;
  /// An episode begins, whatever was before.
  virtual void begin(std::uint64_t seed) = 0;
  /// What is observed now; views in it are valid until the next call of the task. Throws
  /// InvalidValue where no episode is under way.
  virtual Observation observation() const = 0;
  /// Executes a motion. Where the episode has ended, well or not, the outcome has arrived, and its
  /// estimate is 0. Throws InvalidValue for a motion that is none, or not allowed, and where no
  /// episode is under way.
  virtual Outcome step(int motion) = 0;
  /// Whether the episode that has ended ended well.
  virtual bool succeeded() const noexcept = 0;
};

/// What became of an episode.
struct Episode {
  double reward = 0.0;     ///< the sum of all steps'
  std::int64_t steps = 0;  ///< how many
  bool ended = false;      ///< by the task, not by the limit
  bool succeeded = false;  ///< ended well
};

/// Which episodes are run, and how.
struct EpisodesOptions {
  std::int64_t count = 1;            ///< how many, >= 0
  std::uint64_t seed = 0;            ///< of the task
  std::int64_t first = 0;            ///< the first one's number, >= 0
  std::int64_t step_limit = 10'000;  ///< steps after which an episode is cut off, >= 1
  /// Asked between steps; true ends the run. An episode that is broken off is not counted.
  std::function<bool()> interrupt;
};

/// An agent lives through episodes of a task, each a round, and goes on learning. Episode i begins
/// with a seed drawn from the stream "episode i" of the seed: runs in pieces equal one in one call.
/// What is finished is appended to `episodes` one by one, so that it is there where something
/// throws. Throws InvalidValue for options outside their range.
void run_episodes(Task& task, Agent& agent, const EpisodesOptions& options,
                  std::vector<Episode>& episodes);

}  // namespace devlearn
