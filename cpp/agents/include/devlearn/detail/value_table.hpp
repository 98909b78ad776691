#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "devlearn/agent.hpp"
#include "devlearn/detail/situation_index.hpp"
#include "devlearn/random.hpp"
#include "devlearn/value_settings.hpp"

namespace devlearn::detail {

/// A situation's place in a ValueTable.
using Row = std::uint32_t;
/// None: an arrival, as the row that comes next.
constexpr Row kNoRow = SituationIndex::kAbsent;

/// What came of a motion.
struct Transition {
  Row row;
  int motion;
  double reward;  ///< shaped
  Row next;       ///< kNoRow where it arrived
};

/// Q(S, A) of the situations met, in the order they are first met, and the choice that waits for
/// its outcome: what value learners share. Of each situation it remembers which motions were
/// allowed at the last choice there; maxima are over these. All that it holds is finite.
class ValueTable {
 public:
  /// What Q is first, and what is learned from.
  struct Rules {
    FirstValue first_value = FirstValue::kConstant;
    double initial_value = 0.0;
    Shaping shaping = Shaping::kNone;
    double gamma = 1.0;
  };
  /// Those of a configuration.
  template <typename Config>
  static Rules rules(const Config& config) {
    return {config.first_value, config.initial_value, config.shaping, config.gamma};
  }

  /// seed: of the stream "agent".
  ValueTable(const Rules& rules, std::uint64_t seed) : rules_(rules), random_(seed, "agent") {}
  /// One that goes on from a state. Throws FileError, naming `source`.
  ValueTable(const Rules& rules, const AgentState& state, const std::string& source);
  /// Adds to a state all that it goes on from, but for the rules.
  void describe(AgentState& state) const;

  // --- a step: meet, choose, observe ---

  /// The observed situation, and which motions are allowed there now. Throws InvalidValue for what
  /// no observation may hold, or while a choice waits.
  Row meet(const Observation& observation);
  /// Chooses in the row just met: with probability epsilon any motion, else one of the highest Q,
  /// each as likely; of those allowed. The choice waits for its outcome.
  Choice choose(Row row, double epsilon);
  Choice choose(const Observation& observation, double epsilon) {
    return choose(meet(observation), epsilon);
  }
  /// A choice made otherwise, of an allowed motion; it waits, too.
  Choice wait(Row row, int motion) noexcept {
    waiting_row_ = row;
    waiting_motion_ = motion;
    return {motion, Kind::kUnstated};
  }
  /// What came of the choice that waited. Throws InvalidValue where none waits, or for what no
  /// outcome may hold.
  Transition observe(const Outcome& outcome);
  /// The waiting choice was not executed. Throws InvalidValue where none waits.
  void cancel();

  // --- values ---

  /// 0 before the first choice.
  int motion_count() const noexcept { return motion_count_; }
  std::size_t rows() const noexcept { return index_.size(); }
  SituationId situation(Row row) const noexcept { return index_.id(row); }
  /// How many values there are: a pair is a row and a motion.
  std::size_t pairs() const noexcept { return rows() * static_cast<std::size_t>(motion_count_); }
  std::size_t pair(Row row, int motion) const noexcept {
    return std::size_t{row} * static_cast<std::size_t>(motion_count_) +
           static_cast<std::size_t>(motion);
  }

  bool allowed(Row row, int motion) const noexcept { return allowed_[pair(row, motion)] != 0; }
  double q(std::size_t pair) const noexcept { return q_[pair]; }
  /// The highest Q; 0 for kNoRow.
  double max(Row row) const noexcept;
  /// The mean Q under the epsilon-greedy policy; 0 for kNoRow.
  double expected(Row row, double epsilon) const noexcept;
  void set(std::size_t pair, double value) noexcept { q_[pair] = bounded(value); }
  /// Q <- Q + alpha (target - Q)
  void learn(std::size_t pair, double alpha, double target) noexcept {
    set(pair, q_[pair] + alpha * (target - q_[pair]));
  }

  /// The pair of a situation and motion; nothing for a situation never met. Throws as value does.
  std::optional<std::size_t> find(SituationId situation, int motion) const;
  /// Q of a situation and motion; nothing for a situation never met. Throws InvalidValue for a
  /// negative situation, or a motion outside M.
  std::optional<double> value(SituationId situation, int motion) const;

  Random& random() noexcept { return random_; }

  /// A value within +-1e100: what diverges stays finite.
  static double bounded(double value) noexcept;
  /// Throws InvalidValue unless it is one.
  static void require_bounded(const char* quantity, double value);

 private:
  Row find_or_add(SituationId situation, double estimate);
  double potential(double sef, double estimate) const noexcept;

  Rules rules_;
  Random random_;
  int motion_count_ = 0;
  SituationIndex index_;
  std::vector<double> q_;
  std::vector<std::uint8_t> allowed_;
  double potential_ = 0.0;  // of what was last met
  Row waiting_row_ = kNoRow;
  int waiting_motion_ = -1;
};

}  // namespace devlearn::detail
