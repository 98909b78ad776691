#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "devlearn/choice.hpp"
#include "devlearn/detail/fields.hpp"
#include "devlearn/detail/outcome_store.hpp"
#include "devlearn/detail/priorities.hpp"
#include "devlearn/detail/situation_index.hpp"
#include "devlearn/detail/sweep.hpp"
#include "devlearn/learner.hpp"
#include "devlearn/random.hpp"
#include "devlearn/situation.hpp"

namespace devlearn {
namespace detail {

/// Losses that differ by no more count as equal.
inline constexpr double kSameLoss = 1e-9;

}  // namespace detail

/// The adaptive learner's parameters. Costs are in the caller's unit; in a trial a step costs 1.
struct AdaptiveConfig {
  int motion_count = 5;
  double optimism = 1.1;
  int hold_limit = 20;
  int recollections = 20;
  int patience = 10;
  double gain = 0.5;
  double tolerance = 0.0;
  double detour = 20.0;
  double enough = 3.0;
  bool refine = true;
  int curious_every = 0;
  int stale_after = 100;
  int sweep_limit = 0;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using C = AdaptiveConfig;
    return described(
        "AdaptiveConfig",
        field("motion_count", &C::motion_count, "N_M", whole(1, 65535), "number of motions"),
        field("optimism", &C::optimism, "w", closed(1.0, 10.0),
              "what an untried motion promises: the goal at w times the estimate"),
        field("hold_limit", &C::hold_limit, "", whole(1, 1'000'000),
              "steps after which a held motion is chosen anew though the situation is the same; 1: "
              "motions are not held"),
        field("recollections", &C::recollections, "", whole(0, 1'000'000),
              "mappings that are recalled after each decision"),
        field("patience", &C::patience, "", whole(0, 1'000'000),
              "rounds that bring nothing better until the best one is a habit"),
        field("gain", &C::gain, "", closed(0.0, 1e6), "what a deviation from the habit must save"),
        field("tolerance", &C::tolerance, "", closed(0.0, 1e6),
              "share by which a round by habit may cost more before the habit is given up; where "
              "there is noise, above 0"),
        field("detour", &C::detour, "", closed(0.0, 1e9),
              "what a deviation may cost beyond the habit before the round goes on by values"),
        field("enough", &C::enough, "", closed(1.0, 1e9),
              "times the least cost of a round, after which a round goes home by what is known"),
        field("refine", &C::refine, "", Truth{},
              "whether optimism falls where no deviation from the habit promises more, and a round "
              "that deviated goes on by values, not by habit"),
        field("curious_every", &C::curious_every, "", whole(0, 1'000'000),
              "rounds by habit between two looks for what has opened; 0: never"),
        field("stale_after", &C::stale_after, "", whole(1, 1'000'000'000),
              "rounds after which a motion that was interrupted may be worth another trial"),
        field("sweep_limit", &C::sweep_limit, "", whole(0, 2'147'483'647),
              "mappings that a call visits at most in a sweep over all that are known, which then "
              "takes several calls; 0: no limit"));
  }

  /// Throws InvalidValue unless every parameter lies in its range.
  void validate() const;
};

bool operator==(const AdaptiveConfig& a, const AdaptiveConfig& b) noexcept;
inline bool operator!=(const AdaptiveConfig& a, const AdaptiveConfig& b) noexcept {
  return !(a == b);
}

/// What one situation holds, as a copy. N motions; the three lists are views of the losses: no
/// outcome yet, expected loss at most E, more than E.
struct AdaptiveMemory {
  double first_estimate = 0.0;       ///< h: the estimate at the first meeting
  double expected_loss = 0.0;        ///< E: on the way to the goal, beyond the estimate
  std::vector<double> losses;        ///< N: q of each motion
  std::vector<std::uint32_t> times;  ///< N: outcomes remembered of each
  std::vector<int> effective;        ///< M_i
  std::vector<int> ineffective;      ///< M-bar_i
  std::vector<int> unexplored;       ///< RM_i
};

/// What one recollection changed.
struct Recollection {
  SituationId situation = -1;    ///< of the mapping recalled
  int motion = -1;               ///< of the mapping recalled
  double loss_before = 0.0;      ///< q of the mapping
  double loss = 0.0;             ///< q, after it
  double expected_before = 0.0;  ///< E of the situation
  double expected = 0.0;         ///< E, after it
};

/// Why a motion is chosen in a situation. Motions are -1 where there is none.
struct AdaptiveExplanation {
  SituationId situation = -1;       ///< which
  AdaptiveMemory memory;            ///< lists and losses
  std::vector<bool> allowed;        ///< N: whether each motion may be chosen
  std::vector<double> probability;  ///< N: of each to be chosen by values
  int held = -1;                    ///< the motion that is held here
  int deviation = -1;     ///< the one by which this round is to deviate from the habit here
  int habit = -1;         ///< the habit's here, where this round goes by habit
  bool homeward = false;  ///< whether this round goes home by what is known
  /// What the choice goes by, or went by; unstated where a draw is to decide that.
  Kind kind = Kind::kExploit;
  int motion = -1;                          ///< what it was, where it was made
  std::vector<Recollection> recollections;  ///< what those of the last decision changed
};
/// A table for people, a line a motion.
std::string to_text(const AdaptiveExplanation& explanation);

/// The first decisions in the situations on a round's way, in their order, as arrays.
struct AdaptivePath {
  std::vector<std::uint32_t> situation;   ///< numbers, see AdaptiveArrays; each once
  std::vector<std::int32_t> motion;       ///< chosen
  std::vector<double> before;             ///< what the round had cost
  std::vector<double> estimate;           ///< Phi there
  std::vector<std::uint8_t> interrupted;  ///< whether it was, there or at a later decision there
};

/// The habit, and the rounds that led to it.
struct AdaptiveHabit {
  double cost = std::numeric_limits<double>::infinity();
  double least = std::numeric_limits<double>::infinity();
  int start = -1;
  std::int64_t since = 0;
  std::int64_t since_look = 0;
  bool looking = false;

  /// See AdaptiveConfig::fields.
  static constexpr auto fields() {
    using namespace detail;
    using C = AdaptiveHabit;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    constexpr WholeNumbers kRounds = whole(0, 1'000'000'000'000'000'000);  // more can be counted
    return described(
        "habit", field("cost", &C::cost, "", closed(0.0, kInfinity), "of the habit; inf: none"),
        field("least", &C::least, "", closed(0.0, kInfinity), "cost of any round that arrived"),
        field("start", &C::start, "", whole(-1, 2'147'483'646), "situation it begins in"),
        field("since", &C::since, "", kRounds, "rounds without a better one"),
        field("since_look", &C::since_look, "", kRounds,
              "rounds by habit since the last look for what has opened"),
        field("looking", &C::looking, "", Truth{}, "whether such a look is under way"));
  }
};

/// The round under way.
struct AdaptiveRound {
  bool begun = false;
  bool arrived = false;
  bool over = false;
  bool by_habit = false;
  bool deviated = false;
  bool two_ways = false;
  bool curious = false;
  int start = -1;
  double cost = 0.0;
  int target_situation = -1;
  int target_motion = -1;
  int decisions_home = -1;

  /// See AdaptiveConfig::fields.
  static constexpr auto fields() {
    using namespace detail;
    using C = AdaptiveRound;
    constexpr WholeNumbers kNumber = whole(-1, 2'147'483'646);
    return described(
        "round", field("begun", &C::begun, "", Truth{}, "whether there is one"),
        field("arrived", &C::arrived, "", Truth{}, "whether the last step reached the goal"),
        field("over", &C::over, "", Truth{},
              "whether it went on from the goal: what follows belongs to no round"),
        field("by_habit", &C::by_habit, "", Truth{}, "whether it goes by habit"),
        field("deviated", &C::deviated, "", Truth{}, "whether it has left the habit's way"),
        field("two_ways", &C::two_ways, "", Truth{},
              "whether a situation was decided two ways in it"),
        field("curious", &C::curious, "", Truth{}, "whether it looks for what has opened"),
        field("start", &C::start, "", kNumber, "situation it begins in"),
        field("cost", &C::cost, "", closed(0.0, 1e30), "so far"),
        field("target_situation", &C::target_situation, "", kNumber, "where it is to deviate"),
        field("target_motion", &C::target_motion, "", whole(-1, 65534), "by which motion"),
        field("decisions_home", &C::decisions_home, "", kNumber,
              "since what is known was swept for the way home; -1: not in this round"));
  }
};

/// The decision that is open: a motion that is held.
struct AdaptiveDecision {
  int situation = -1;
  int motion = -1;
  Kind kind = Kind::kUnstated;
  bool waiting = false;
  int steps = 0;
  double before = 0.0;
  double estimate = 0.0;
  double spent = 0.0;
  double last_estimate = 0.0;

  /// See AdaptiveConfig::fields.
  static constexpr auto fields() {
    using namespace detail;
    using C = AdaptiveDecision;
    constexpr Interval kCost = closed(0.0, 1e30);
    return described(
        "decision",
        field("situation", &C::situation, "", whole(-1, 2'147'483'646), "-1: none is open"),
        field("motion", &C::motion, "", whole(-1, 65534), "chosen"),
        field("kind", &C::kind, "",
              names("explore", "exploit", "exhausted", "unstated", "habit", "deviation", "held"),
              "why"),
        field("waiting", &C::waiting, "", Truth{}, "whether a choice waits for its step"),
        field("steps", &C::steps, "", whole(0, 1'000'000), "so far"),
        field("before", &C::before, "", kCost, "what the round had cost"),
        field("estimate", &C::estimate, "", kCost, "Phi where it was made"),
        field("spent", &C::spent, "", kCost, "its cost so far"),
        field("last_estimate", &C::last_estimate, "", kCost, "Phi after its last step"));
  }
};

/// All that an adaptive learner remembers, as arrays: S situations in the order they were met, by
/// which they are numbered, N motions, O outcomes, H waypoints of the habit, P of this round.
struct AdaptiveArrays {
  std::vector<SituationId> situation;   ///< S ids
  std::vector<double> first_estimate;   ///< S: h
  std::vector<std::int32_t> by_values;  ///< S: the motion last chosen by values, or -1
  std::vector<double> known;            ///< S: expected loss by what is known
  std::vector<double> hoped;            ///< S, or none where there are no curious rounds: Ec
  std::vector<double> loss;             ///< S x N: q
  std::vector<std::uint8_t> allowed;    ///< S x N: at the last choice
  std::vector<double> priority;         ///< S x N: 0 where there is none
  std::vector<std::uint8_t> on_trial;   ///< S x N: whether a round deviated from this habit by it
  std::vector<double> trial_loss;       ///< S x N, or none: q at the beginning of the round after
  std::vector<std::uint32_t> interrupted;  ///< S x N: the round in which its last outcome was, or 0
  std::vector<std::uint32_t> outcome_count;  ///< S x N: of each mapping
  std::vector<std::int32_t> next;    ///< O, mapping by mapping: a situation's number, -1: goal
  std::vector<std::uint32_t> times;  ///< O: how often
  std::vector<double> loss_sum;      ///< O: of so many times
  AdaptivePath habit;                ///< H
  AdaptivePath path;                 ///< P
};

/// Everything that an adaptive learner goes on from.
struct AdaptiveState {
  AdaptiveConfig config;      ///< its parameters
  std::uint64_t seed = 0;     ///< that it began with
  Random::State random{};     ///< of the stream "agent"
  std::uint64_t rounds = 0;   ///< begun
  double optimism = 1.0;      ///< w, as it has fallen
  AdaptiveHabit habit;        ///< and the rounds that led to it
  AdaptiveRound round;        ///< that is under way
  AdaptiveDecision decision;  ///< that is open
  detail::Sweep home;         ///< of what is known, for the way home
  detail::Sweep falling;      ///< of untried motions, as optimism falls
  detail::Sweep hope;         ///< of what is hoped, in curious rounds
  AdaptiveArrays arrays;      ///< all that it remembers
};

/// A learner with an adaptive SEF, -(Phi + E): the estimate of the cost to go, corrected by what
/// was experienced. It remembers where motions led and at what loss (the cost, plus what the
/// estimate rose by: Eq. 8 with a linear SEF), recalls outcomes by prioritized sweeping (Moore &
/// Atkeson 1993) of values shaped by the estimate (Ng, Harada & Russell 1999), holds a motion until
/// the situation changes, and makes its best round a habit, from which it deviates where another
/// motion promises more.
///
///     AdaptiveLearner learner(AdaptiveConfig{}, seed);
///     learner.begin_round();
///     while (!arrived) {
///       const int motion = learner.choose(situation, estimate).motion;
///       ...make one step of it...
///       learner.learn(cost, next, next_estimate);  // estimate 0: the goal
///     }
///     learner.end_round(true);
///
/// The estimate is the caller's guess of the cost to go, linear in the distance, and 0 at the goal
/// and nowhere else. Without rounds there are no habits; everything else is as within them. What
/// follows an arrival without end_round belongs to no round.
///
/// The same configuration, seed and outcomes give the same history on every machine. A learner is
/// for one thread. Copies are independent and go on alike.
class AdaptiveLearner {
 public:
  /// seed: of the stream "agent". Throws InvalidValue.
  explicit AdaptiveLearner(const AdaptiveConfig& config = {}, std::uint64_t seed = 0);
  /// One that goes on from a state. Throws InvalidValue where the state breaks a law.
  explicit AdaptiveLearner(const AdaptiveState& state);

  /// A round begins, where its first step is made; an open decision is dropped.
  void begin_round();
  /// A round ends, at the goal or not; an open decision is dropped. One without a step counts for
  /// nothing. Throws InvalidValue where none has begun.
  void end_round(bool arrived);

  /// The motion for the next step: the one that is held, or a new decision. situation >= 0;
  /// estimate in [0, 1e12], of the cost to go; allowed as Learner::choose. Throws InvalidValue,
  /// likewise while a choice waits for learn or cancel.
  Choice choose(SituationId situation, double estimate, AllowedMotions allowed = {});

  /// What that step came to: its cost in [0, 1e12], and where it led. next_estimate 0 is the goal.
  /// interrupted: the motion cannot be held (the body touched something). An event is told at the
  /// end of a decision: extension or rejection where the motion was not yet tried here, else
  /// orientation. Throws InvalidValue.
  Development learn(double cost, SituationId next, double next_estimate, bool interrupted = false);

  /// The waiting choice is not made. As the first of its decision, nothing happened (but a draw);
  /// later, the decision ends as interrupted. Throws InvalidValue where none waits.
  void cancel();

  /// An outcome whoever made it: of a decision by `motion` in `situation` that cost so much and led
  /// to `next`. estimate: where the decision was made, or what it was at the first meeting. The
  /// open decision, round and habit stay as they are. Throws InvalidValue, likewise without an
  /// estimate for a situation never met.
  Development update(SituationId situation, int motion, double cost, SituationId next,
                     double next_estimate, std::optional<double> estimate = std::nullopt);

  /// Forgets the outcomes of a situation's motions, which then are as at the first meeting;
  /// whether it was ever met. Those that lead there stay; a habit through it is dropped. Throws
  /// InvalidValue for a negative situation, or while a decision is open in it.
  bool forget(SituationId situation);

  /// The tried motion of least expected loss, the first in M among equals; nothing where none was
  /// tried. Draws and changes nothing.
  std::optional<int> best(SituationId situation) const noexcept;

  /// E of a situation; nothing where it was never met.
  std::optional<double> expected_loss(SituationId situation) const noexcept;

  ///@{
  /// A situation is a whole number. What a fraction or NaN would be cut off to, nobody means: it
  /// does not compile.
  template <typename T, typename... Rest>
  detail::IfFloating<T, Choice> choose(T, Rest...) = delete;
  template <typename T>
  detail::IfFloating<T, std::optional<int>> best(T) const = delete;
  template <typename T>
  detail::IfFloating<T, bool> forget(T) = delete;
  template <typename T, typename... Rest>
  detail::IfFloating<T, Development> update(T, Rest...) = delete;
  template <typename T>
  detail::IfFloating<T, AdaptiveMemory> situation(T) const = delete;
  template <typename T, typename... Rest>
  detail::IfFloating<T, AdaptiveExplanation> explain(T, Rest...) const = delete;
  ///@}

  /// A situation's lists and losses, as a copy; of one never met, every motion unexplored, without
  /// loss. Creates nothing. Throws InvalidValue for a negative situation.
  AdaptiveMemory situation(SituationId situation) const;
  /// Ids of the situations met, in their order.
  std::vector<SituationId> situations() const { return ids_.ids(); }
  /// Everything it would go on from, as copies.
  AdaptiveState state() const;

  /// Why a motion would be chosen in a situation as it is now; changes nothing. Throws InvalidValue
  /// for a negative situation, or as choose does for what is allowed.
  AdaptiveExplanation explain(SituationId situation, AllowedMotions allowed = {}) const;
  /// Why the last decision came out as it did, as it found its situation; nothing before the first
  /// one since the learner was made or loaded.
  std::optional<AdaptiveExplanation> last_choice() const;

  /// Makes room for so many in all, so that up to then nothing is allocated. Throws InvalidValue
  /// for more than 2^31 - 2 situations, 2^32 - 2 mappings or outcomes, std::bad_alloc where memory
  /// does not suffice.
  void reserve(std::size_t situations, std::size_t outcomes);
  /// What its memory takes.
  MemoryUse memory_use() const noexcept;

  std::int64_t explored_count() const noexcept { return explored_count_; }     ///< NUM_RM
  std::int64_t effective_count() const noexcept { return effective_count_; }   ///< NUM_M
  std::size_t situations_experienced() const noexcept { return ids_.size(); }  ///< how many
  std::size_t outcomes() const noexcept { return outcomes_.size(); }           ///< remembered
  double optimism() const noexcept { return optimism_; }  ///< w, as it has fallen
  /// What the habit costs; nothing where there is none.
  std::optional<double> habit_cost() const noexcept;
  const AdaptiveConfig& config() const noexcept { return config_; }  ///< its parameters
  std::uint64_t seed() const noexcept { return seed_; }              ///< that it began with
  /// Whether a round is under way: begun, and neither ended nor gone on with from the goal.
  bool in_round() const noexcept { return round_.begun && !round_.over; }
  /// The choice that waits for its step, if any.
  std::optional<Choice> pending() const noexcept;

 private:
  using Number = std::uint32_t;  // of a situation, or of a mapping

  struct Situation {
    double first_estimate;        // h
    double loss;                  // E
    std::int32_t by_values = -1;  // the motion last chosen by values
    std::int32_t decided = -1;    // its place on path_, if that is of this situation
    std::int32_t habit = -1;      // its place on habit_path_, likewise
    std::int32_t effective_count = 0;
  };
  // A first decision in a situation.
  struct Waypoint {
    Number situation;
    std::int32_t motion;
    double before;
    double estimate;
    bool interrupted;
  };
  // The allowed motions whose loss is at most this.
  struct Among {
    const double* losses;
    double most;
    AllowedMotions allowed;
    bool operator()(int motion) const noexcept { return allowed(motion) && losses[motion] <= most; }
  };
  // What the last decision found.
  struct LastChoice {
    Choice choice;
    Number situation = 0;
    double loss = 0.0;
    int deviation = -1, habit = -1, by_values = -1;
    bool homeward = false;
    // Each motion's
    std::vector<double> losses;
    std::vector<std::uint32_t> times;
    std::vector<std::uint8_t> allowed;
  };

  // Situations and their values
  std::size_t most_situations() const noexcept;
  std::size_t most_told() const noexcept;
  Number meet(SituationId situation, double estimate);
  Number motions() const noexcept { return static_cast<Number>(config_.motion_count); }
  Number mapping(Number situation, int motion) const noexcept {
    return situation * motions() + static_cast<Number>(motion);
  }
  Number situation_of(Number mapping) const noexcept { return mapping / motions(); }
  double loss_at(Number next) const noexcept;
  double first_loss(Number situation) const noexcept;
  template <typename LossAt>
  double mean_loss(Number mapping, const LossAt& loss_at) const noexcept;
  void settle(Number situation);
  void recollect(int times);
  Event add_outcome(Number mapping, Number next, double loss, bool interrupted);
  void forget_outcomes(Number mapping) noexcept;

  // Decisions
  void allow(Number here, AllowedMotions allowed);
  Choice decide(Number here, double estimate, AllowedMotions allowed);
  Choice for_values(Number here, int motion) const noexcept;
  std::optional<Choice> settled_choice(Number here, AllowedMotions allowed) const;
  Among best_by_values(Number here, AllowedMotions allowed) const noexcept;
  template <typename Of>
  int drawn(const Of& among);
  template <typename Loss>
  int least_of(AllowedMotions allowed, const Loss& loss) const noexcept;
  void remember_choice(Number here, AllowedMotions allowed);
  void begin_decision();
  Event close_decision(Number next, double estimate, bool interrupted);
  Development development(Number situation, int motion, Event event, double value) const noexcept;

  // Rounds and the habit
  bool decided(Number here) const noexcept { return on(path_, at_[here].decided, here); }
  int habit_motion(Number here) const noexcept {
    const std::int32_t place = at_[here].habit;
    return on(habit_path_, place, here) ? habit_path_[static_cast<std::size_t>(place)].motion : -1;
  }
  static bool on(const std::vector<Waypoint>& path, std::int32_t place, Number here) noexcept {
    const auto i = static_cast<std::size_t>(place);
    return place >= 0 && i < path.size() && path[i].situation == here;
  }
  bool goes_by_habit() const noexcept {
    return round_.by_habit && !(round_.deviated && config_.refine) && !round_.curious;
  }
  int deviation_here(Number here) const noexcept;
  void start_round(Number here, double estimate);
  void count_round(const AdaptiveRound& round, bool arrived);
  bool look_for_target();
  template <typename F>
  void each_on_the_way(const F& f);
  void forget_trials();
  void reconsider_trials();
  void drop_habit();
  void watch_habit(const AdaptiveDecision& made, bool interrupted);

  // Sweeps over all that is known
  template <typename Visit>
  void go_on(detail::Sweep& sweep, std::size_t mappings, double small, const Visit& visit);
  template <typename Loss>
  double revalue(std::vector<double>& values, Number situation, const Loss& loss);
  void go_on_sweeping();
  void lower_optimism();
  void sweep_falling(std::size_t mappings);
  bool homeward() const noexcept;
  double unknown_loss() const noexcept;
  double loss_home(Number mapping) const noexcept;
  void sweep_home(std::size_t mappings);
  int towards_home(Number here, AllowedMotions allowed);
  bool stale(Number mapping) const noexcept;
  double hope(Number mapping) const noexcept;
  void sweep_hope(std::size_t mappings);
  bool look_for_openings(Number here, double estimate);
  int hopeful(Number here, AllowedMotions allowed) const noexcept;

  AdaptiveMemory memory_of(double first_estimate, double loss, const double* losses,
                           const std::uint32_t* times) const;
  static AdaptivePath arrays_of(const std::vector<Waypoint>& path);
  void take(const AdaptivePath& from, std::vector<Waypoint>& path, std::int32_t Situation::*place);

  AdaptiveConfig config_;
  std::uint64_t seed_;
  Random random_;
  double optimism_;
  std::uint64_t rounds_ = 0;

  detail::SituationIndex ids_;
  std::vector<Situation> at_;
  std::vector<double> known_;  // E where untried motions do not help
  std::vector<double> hoped_;  // E where stale ones do
  // Each mapping's
  std::vector<double> q_;
  std::vector<std::uint8_t> allowed_;
  std::vector<std::uint8_t> on_trial_;      // a round deviated from this habit by it
  std::vector<double> trial_loss_;          // q at the beginning of the round after, or infinite
  std::vector<std::uint32_t> interrupted_;  // the round of its last outcome, if that was; or 0
  detail::OutcomeStore outcomes_;
  detail::Priorities priorities_;
  std::int64_t explored_count_ = 0;
  std::int64_t effective_count_ = 0;

  AdaptiveHabit habit_;
  std::vector<Waypoint> habit_path_;

  AdaptiveRound round_;
  std::vector<Waypoint> path_;
  AdaptiveDecision decision_;
  detail::Sweep home_, falling_, hope_;

  std::vector<Recollection> recollected_;
  LastChoice last_;
};

}  // namespace devlearn
