#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devlearn/choice.hpp"
#include "devlearn/learner.hpp"
#include "devlearn/situation.hpp"
#include "devlearn/state.hpp"

namespace devlearn {

/// What is sensed, as numbers: a view.
class Readings {
 public:
  /// None.
  Readings() = default;
  /// values: count of them.
  Readings(const double* values, std::size_t count) noexcept : values_(values), count_(count) {}

  bool empty() const noexcept { return count_ == 0; }              ///< whether there are none
  std::size_t size() const noexcept { return count_; }             ///< how many
  const double* begin() const noexcept { return values_; }         ///< the first
  const double* end() const noexcept { return values_ + count_; }  ///< behind the last
  double operator[](std::size_t i) const noexcept { return values_[i]; }  ///< one of them

 private:
  const double* values_ = nullptr;
  std::size_t count_ = 0;
};

/// Salient events have numbers from 0 to below this one.
constexpr int kEventCount = 64;
///@{
/// Those of a trial: it arrived; it touched something.
constexpr int kArrivalEvent = 0;
constexpr int kTouchEvent = 1;
///@}

/// What an agent knows when it chooses.
struct Observation {
  SituationId situation = -1;  ///< S_i
  Pose pose;                   ///< [m, m, degrees]
  double sef = 0.0;            ///< SEF here
  double goal_distance = 0.0;  ///< d_g [m]
  double clearance = 0.0;      ///< d_o [m]
  double estimate = 0.0;   ///< cost to go at the least, in steps: d_g / (v t_s), 0 at the target
  int motion_count = 0;    ///< choose one in 0 ... motion_count - 1
  AllowedMotions allowed;  ///< of these; valid during the call
  Readings senses;         ///< what a task senses; none in a trial; valid during the call
};

/// What an agent is told about the motion it chose.
struct Outcome {
  SituationId situation = -1;  ///< the next situation
  double sef = 0.0;            ///< SEF in it
  double smf = 0.0;            ///< as learned from: min(SMF, -1) for a collision
  bool collided = false;       ///< the body touched something
  bool arrived = false;        ///< d_g <= goal_radius
  double estimate = 0.0;       ///< cost to go from there, as in Observation
  double cost = 1.0;           ///< what the step cost: 1, and touch_cost more if collided
  int event = -1;              ///< the salient event that it was, below kEventCount; -1: none
  /// -cost
  double reward() const noexcept { return -cost; }
};

/// What an agent goes on from: texts and arrays by name, in UTF-8.
struct AgentState {
  std::string kind;                          ///< what it is, so that its maker knows it
  std::map<std::string, std::string> texts;  ///< by name
  StateArrays arrays;                        ///< by name; see array_of

  /// A text that must be there. Throws InvalidValue, naming it.
  const std::string& text(const std::string& name) const;
  /// The values of an array that must be there, with this shape. Throws InvalidValue, naming it.
  template <typename T>
  std::vector<T> values(const std::string& name, const Shape& shape) const {
    return values_of<T>(arrays, name, shape);
  }
};

/// Whoever chooses motions in a trial. What is called when:
///
///     begin_round, then choose and observe once a step, then end_round
///
/// A round ends where path learning arrives (arrived = true), or when the next one begins (false):
/// that a phase is over, a limit reached or a trial saved ends none. Steps after an arrival begin
/// another. Where an agent throws, the trial is left as it was.
class Agent {
 public:
  virtual ~Agent() = default;
  /// A round begins.
  virtual void begin_round() {}
  /// Step 3: a motion for what is observed.
  virtual Choice choose(const Observation& observation) = 0;
  /// Steps 4-5: what came of it. What it returns goes into the record; an agent without such lists
  /// returns {}.
  virtual Development observe(const Outcome& outcome) = 0;
  /// The choice just made was refused, and not executed.
  virtual void cancel() {}
  /// The round has ended, at the target or not.
  virtual void end_round(bool arrived) { static_cast<void>(arrived); }
  /// All that it goes on from, so that a trial can be saved with it; nothing where it cannot.
  virtual std::optional<AgentState> state() const { return std::nullopt; }
};

/// Makes the agent of a state, or null where the kind is none of its own. Throws InvalidValue for a
/// state that does not fit. The arrays are those of a file that is being read: take what is to
/// stay.
using AgentMaker = std::function<std::shared_ptr<Agent>(const AgentState&)>;

/// That of devlearn's own agents, by their kKind. Throws FileError, naming `source`, for a state
/// that does not fit.
std::shared_ptr<Agent> make_agent(const AgentState& state, const std::string& source = "state");

}  // namespace devlearn
