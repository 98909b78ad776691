#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "devlearn/choice.hpp"
#include "devlearn/detail/fields.hpp"
#include "devlearn/detail/situation_store.hpp"
#include "devlearn/explanation.hpp"
#include "devlearn/motor_memory.hpp"
#include "devlearn/random.hpp"
#include "devlearn/situation.hpp"

namespace devlearn {
namespace detail {

template <typename T, typename Result>
using IfFloating = std::enable_if_t<std::is_floating_point_v<T>, Result>;

}  // namespace detail

/// What becomes of an effective motion that was exploited and met SMF < 0. The paper says both.
enum class OnNegative : std::uint8_t {
  kAbandon,  ///< step 4: it moves to M-bar_i
  kWeaken,   ///< step 5: only its orientation falls, by Eq. 9
};

/// What is done where every motion was tried and none is effective. The paper is silent.
enum class WhenExhausted : std::uint8_t {
  kRetry,   ///< any motion; one that proves effective enters M_i by extension development
  kWander,  ///< any motion; nothing is learned
};

/// The learner's parameters; the defaults are the paper's.
struct LearnerConfig {
  int motion_count = 5;
  double eta = 0.05;
  double sigma = 0.3;
  double c1 = 0.5;
  double c2 = 1.0;
  OnNegative on_negative = OnNegative::kAbandon;
  WhenExhausted when_exhausted = WhenExhausted::kRetry;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using C = LearnerConfig;
    return described(
        "LearnerConfig",
        field("motion_count", &C::motion_count, "N_M", whole(1, 65535), "number of motions"),
        field("eta", &C::eta, "eta", open(0.0, 1.0), "orientation parameter of Eq. 9"),
        field("sigma", &C::sigma, "sigma", open(0.0, 1.0),
              "weight of orientation against curiosity in Eq. 7"),
        field("c1", &C::c1, "c_1", closed(0.0, 1e6), "how fast curiosity wanes, Eq. 5"),
        field("c2", &C::c2, "c_2", closed(-1e6, 1e6),
              "times learned at which curiosity is 1/2, Eq. 5"),
        field("on_negative", &C::on_negative, "", names("abandon", "weaken"),
              "what becomes of an exploited motion that met SMF < 0: it moves to the ineffective "
              "list (step 4), or its orientation falls by Eq. 9 (step 5)"),
        field("when_exhausted", &C::when_exhausted, "", names("retry", "wander"),
              "what is done where every motion was tried and none is effective: any motion, and "
              "one that proves effective enters M_i again, or any motion, and nothing is learned"));
  }

  /// The default: step 4's reading (abandon, retry), under which the paper's results come out.
  static LearnerConfig paper() { return {}; }
  /// Step 5's reading, for comparison (weaken, wander).
  static LearnerConfig step5();

  /// Throws InvalidValue unless every parameter lies in its range.
  void validate() const;
};

bool operator==(const LearnerConfig& a, const LearnerConfig& b) noexcept;
inline bool operator!=(const LearnerConfig& a, const LearnerConfig& b) noexcept {
  return !(a == b);
}

/// What one outcome changed.
enum class Event : std::uint8_t {
  kNothing = 0,      ///< an ineffective motion stayed so
  kExtension = 1,    ///< the motion entered M_i (Eq. 10-13)
  kRejection = 2,    ///< an explored motion moved to M-bar_i
  kOrientation = 3,  ///< Eq. 9 was applied to the orientations
  kAbandonment = 4,  ///< an exploited motion met SMF < 0 and moved to M-bar_i
};

/// The outcome of one learning step.
struct Development {
  SituationId situation = -1;     ///< learned in
  int motion = -1;                ///< learned about
  Event event = Event::kNothing;  ///< what became of it
  int reduced = 0;  ///< motions that reduction development (Eq. 14-17) moved to M-bar_i
  std::int64_t explored_count = 0;   ///< NUM_RM, after it
  std::int64_t effective_count = 0;  ///< NUM_M, after it
  std::optional<double> value;  ///< what the agent expects to spend from there on, where it says so
};

/// All that a learner remembers, as arrays: S situations in the order they were first experienced,
/// N motions. E is the number of effective mappings, NUM_M.
struct LearnerMemory {
  std::vector<SituationId> situation;            ///< S ids
  std::vector<std::uint16_t> effective_count;    ///< S: n_i
  std::vector<std::uint16_t> ineffective_count;  ///< S: n-bar_i
  std::vector<std::uint16_t> motions;  ///< S x N: of each situation M_i, then M-bar_i, then RM_i
  std::vector<double> orientation;     ///< E: of each effective motion, situation by situation
  std::vector<std::uint32_t> times_learned;  ///< E: likewise
};

/// A choice that waits for its outcome, and where it was made.
struct PendingChoice {
  SituationId situation = -1;  ///< in which it was made
  Choice choice;               ///< what was chosen
};

/// Everything that a learner goes on from.
struct LearnerState {
  LearnerConfig config;                  ///< its parameters
  std::uint64_t seed = 0;                ///< that it began with
  Random::State random{};                ///< of the stream "agent"
  std::optional<PendingChoice> pending;  ///< the choice that waits for its outcome
  LearnerMemory memory;                  ///< all that it remembers
};

/// The sensorimotor developmental learner: a situation in, a motion out; how good it was in, the
/// lists develop. It knows no robot, grid or task.
///
///     Learner learner(LearnerConfig{}, seed);
///     for (;;) {
///       const int motion = learner.choose(situation).motion;
///       ...execute it...
///       learner.learn(smf);  // SMF = SEF after - SEF before, Eq. 8
///     }
///
/// Situations come into being when first chosen for, so memory follows experience. The same
/// configuration, seed and outcomes give the same history on every machine. A learner is for one
/// thread; two learners share nothing. Copies are independent and go on alike. One that was moved
/// from can be assigned to or destroyed, nothing else.
class Learner {
 public:
  /// seed: of the stream "agent". Throws InvalidValue.
  explicit Learner(const LearnerConfig& config = {}, std::uint64_t seed = 0);

  /// A learner that goes on from a state. Throws InvalidValue where the state breaks a law: lists
  /// that do not partition M, unexplored motions out of order, orientations outside [1e-12, 1] or
  /// whose sum is not 1 within 1e-9, counts below 1, a situation twice, sizes that do not fit.
  explicit Learner(const LearnerState& state);

  Learner(const Learner&) = default;      ///< independent, and goes on alike
  Learner(Learner&&) noexcept = default;  ///< leaves one to assign to or destroy, nothing else
  /// A copy into one of as many motions that has room for the other's situations allocates nothing.
  /// Where memory for it does not suffice, this learner is left as it was. It keeps its room.
  Learner& operator=(const Learner& other);
  Learner& operator=(Learner&&) noexcept = default;  ///< likewise
  ~Learner() = default;

  /// Step 3: chooses a motion for a situation >= 0. Throws InvalidValue for a negative situation,
  /// while an earlier choice waits for learn or cancel, or for a situation that refuse_growth
  /// refuses.
  Choice choose(SituationId situation) { return choose(situation, {}); }

  /// The same among the motions that are allowed now: by a safety layer, by what the robot can do
  /// here. The others are neither drawn nor explored nor won by, and stay where they are in their
  /// lists. Of allowed motions alone, n, n_R and the draw are counted; where they all are known as
  /// ineffective, any of them. Throws InvalidValue, too, unless there is a bool for each motion and
  /// at least one is true. With every motion allowed, it is choose(situation) to the bit.
  Choice choose(SituationId situation, AllowedMotions allowed);

  /// The effective motion of highest orientation, the first in M_i among equals: what was learned,
  /// without curiosity. Nothing where no motion is effective. Draws and changes nothing.
  std::optional<int> best(SituationId situation) const noexcept;

  /// Steps 4-5: learns from the chosen motion's SMF, any finite number (Eq. 8). SMF >= 0 means
  /// effective. Throws InvalidValue for a non-finite smf or where no choice waits.
  Development learn(double smf);

  /// The same where another motion really ran, 0 <= motion < motion_count (a safety layer's, say).
  Development learn(double smf, int motion);

  /// The waiting choice was not executed: nothing is learned. Throws InvalidValue where none waits.
  void cancel();

  /// Steps 4-5 for any situation and motion, whoever chose: delayed outcomes, several robots,
  /// replay. A waiting choice goes on waiting. Throws InvalidValue.
  ///
  /// Where the motion stands decides what it means: unexplored, it is explored; effective, it is
  /// exploited; ineffective, it is retried.
  Development update(SituationId situation, int motion, double smf);

  /// Forgets a situation, as if it had never been experienced, in a time that does not grow with
  /// their number; whether there was anything to forget. In the order of situations the last one
  /// takes its place; NUM_RM and NUM_M are counted without it. Throws InvalidValue for a negative
  /// situation, or while a choice waits in it.
  bool forget(SituationId situation);

  ///@{
  /// A situation is a whole number. What a fraction or NaN would be cut off to, nobody means: it
  /// does not compile.
  template <typename T, typename... Rest>
  detail::IfFloating<T, Choice> choose(T, Rest...) = delete;
  template <typename T>
  detail::IfFloating<T, std::optional<int>> best(T) const = delete;
  template <typename T>
  detail::IfFloating<T, bool> forget(T) = delete;
  template <typename T>
  detail::IfFloating<T, Development> update(T, int, double) = delete;
  template <typename T>
  detail::IfFloating<T, SituationMemory> situation(T) const = delete;
  template <typename T, typename... Rest>
  detail::IfFloating<T, Explanation> explain(T, Rest...) const = delete;
  ///@}

  /// A situation's lists, as a copy; of one never experienced, every motion unexplored. Creates
  /// nothing. Throws InvalidValue for a negative situation.
  SituationMemory situation(SituationId situation) const;

  /// Ids of the situations experienced, in the order they were first experienced.
  std::vector<SituationId> situations() const;

  /// Everything it would go on from, as copies.
  LearnerState state() const;

  /// Why motions are chosen in a situation as it is now, of all or of those allowed; changes
  /// nothing. Throws InvalidValue for a negative situation, or as choose does for what is allowed.
  Explanation explain(SituationId situation, AllowedMotions allowed = {}) const;

  /// Why the last choice came out as it did, learned from or not; nothing before the first one
  /// since the learner was made or loaded.
  std::optional<ChoiceTrace> last_choice() const;

  /// Makes room for `situations` in all, so that up to then nothing is allocated. kTouched: and
  /// takes the memory from the system now, so that no later call waits for it. Throws InvalidValue
  /// for more than 2^32 - 2, std::bad_alloc where memory does not suffice.
  void reserve(std::size_t situations, Pages pages = Pages::kUntouched) {
    store_.reserve(situations, pages);
  }
  /// For how many situations there is room.
  std::size_t room() const noexcept { return store_.room(); }

  /// Whether situations beyond the room are refused (by choose and update, with InvalidValue; the
  /// learner is left as it was) instead of room being made, which for a million of them takes a
  /// fifth of a second. best, forget and what was experienced go on. Not part of a snapshot.
  void refuse_growth(bool refuse = true) noexcept { store_.refuse_growth(refuse); }

  std::int64_t explored_count() const noexcept { return explored_count_; }    ///< NUM_RM
  std::int64_t effective_count() const noexcept { return effective_count_; }  ///< NUM_M
  /// How many they are.
  std::size_t situations_experienced() const noexcept { return store_.size(); }
  /// What its memory takes.
  MemoryUse memory_use() const noexcept { return store_.memory_use(); }

  const LearnerConfig& config() const noexcept { return config_; }  ///< its parameters
  std::uint64_t seed() const noexcept { return seed_; }             ///< that it began with
  /// The choice that waits for its outcome, if any.
  std::optional<Choice> pending() const noexcept;

 private:
  using Slot = SituationStore::Slot;

  Development develop(Slot slot, int place, double smf) noexcept;
  Slot require_pending(const char* call) const;

  LearnerConfig config_;
  std::uint64_t seed_;
  Random random_;
  Curiosity curiosity_;
  SituationStore store_;

  Slot pending_slot_ = SituationStore::kAbsent;
  Choice pending_choice_;
  int pending_place_ = -1;  // where its motion stands
  // The last choice: the block as it was, then a bool for each motion, and what was drawn.
  std::vector<std::byte> last_block_;
  bool last_every_ = true;  // motion was allowed
  int last_draw_ = -1;

  std::int64_t explored_count_ = 0;
  std::int64_t effective_count_ = 0;
};

}  // namespace devlearn
