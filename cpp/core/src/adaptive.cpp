#include "devlearn/adaptive.hpp"

#include <algorithm>
#include <cmath>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"

namespace devlearn {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kAbsent = detail::SituationIndex::kAbsent;
constexpr std::uint32_t kGoal = detail::OutcomeStore::kGoal;
constexpr double kMostCost = 1e12;
constexpr std::size_t kMostMappings = 0xfffffffe;
constexpr std::size_t kMostSituations = 0x7ffffffe;

constexpr double kSmallChange = 0.05;  // of E, that those who lead there need not hear of

// Falling optimism: by how much, and how far the change is followed at once.
constexpr double kOptimismStep = 0.05;
constexpr int kFallingRecollections = 20'000;

// The way home: what an untried motion counts as, in least costs of a round; after how many
// decisions what is known is swept again, how often at most, and until which change; one decision
// in so many is drawn, for known losses, too, can lead round and round between joined poses.
constexpr double kUnknown = 10.0;
constexpr int kHomeDecisions = 50;
constexpr int kHomePasses = 3;
constexpr double kHomeChange = 0.5;
constexpr std::uint32_t kHomeDraws = 5;

// Curious rounds: what an opening must save, when the look for it is given up, and by how much a
// loss must have fallen to be tried again.
constexpr double kOpening = 0.5;
constexpr double kOpeningDetour = 50.0;
constexpr double kRetrial = 2.0;
constexpr int kHopePasses = 60;
constexpr int kHopePassesOnTheWay = 10;
constexpr double kHopeChange = 0.5;

constexpr std::size_t kEveryMapping = static_cast<std::size_t>(-1);

[[noreturn]] void refuse_outcome(const char* call) {
  throw InvalidValue(call, "no choice that waits for its step", "a choose() before it");
}

}  // namespace

void AdaptiveConfig::validate() const { detail::require_fields(*this); }

bool operator==(const AdaptiveConfig& a, const AdaptiveConfig& b) noexcept {
  return detail::same_fields(a, b);
}

AdaptiveLearner::AdaptiveLearner(const AdaptiveConfig& config, std::uint64_t seed)
    : config_((config.validate(), config)),
      seed_(seed),
      random_(seed, "agent"),
      optimism_(config.optimism) {
  last_.losses.resize(motions());
  last_.times.resize(motions());
  last_.allowed.resize(motions());
}

// --- situations and their values -----------------------------------------------------------------

std::size_t AdaptiveLearner::most_situations() const noexcept {
  return std::min(kMostSituations, kMostMappings / motions());
}

void AdaptiveLearner::reserve(std::size_t situations, std::size_t outcomes) {
  const std::size_t most = most_situations();
  if (situations > most) {
    throw InvalidValue("situations", std::to_string(situations),
                       "at most " + std::to_string(most) + " of so many motions");
  }
  if (outcomes > kMostMappings) {
    throw InvalidValue("outcomes", std::to_string(outcomes), "at most 2^32 - 2");
  }
  const std::size_t mappings = situations * motions();
  ids_.reserve(situations);
  at_.reserve(situations);
  known_.reserve(situations);
  if (config_.curious_every > 0) {
    hoped_.reserve(situations);
    trial_loss_.reserve(mappings);
  }
  habit_path_.reserve(situations);
  path_.reserve(situations);
  q_.reserve(mappings);
  allowed_.reserve(mappings);
  on_trial_.reserve(mappings);
  interrupted_.reserve(mappings);
  outcomes_.reserve_chains(mappings, situations);
  outcomes_.reserve(outcomes);
  priorities_.reserve(mappings);
  recollected_.reserve(most_told());
}

// How many recollections of a decision are told.
std::size_t AdaptiveLearner::most_told() const noexcept {
  return static_cast<std::size_t>(std::min(config_.recollections, 1000));
}

// The number of a situation; a new one is as Phi says.
AdaptiveLearner::Number AdaptiveLearner::meet(SituationId situation, double estimate) {
  const Number known = ids_.find(situation);
  if (known != kAbsent) return known;
  // Room everywhere before anything changes.
  if (at_.size() == at_.capacity()) {
    const std::size_t enough = std::max<std::size_t>(64, 2 * at_.size());
    reserve(at_.size() == most_situations() ? at_.size() + 1 : std::min(most_situations(), enough),
            0);
  }
  const Number added = ids_.add(situation);
  const double loss = (optimism_ - 1.0) * estimate;
  at_.push_back({estimate, loss});
  known_.push_back(unknown_loss());
  const std::size_t mappings = q_.size() + motions();
  if (config_.curious_every > 0) {
    hoped_.push_back(loss);
    trial_loss_.resize(mappings, kInfinity);
  }
  q_.resize(mappings, loss);
  allowed_.resize(mappings, 1);
  on_trial_.resize(mappings, 0);
  interrupted_.resize(mappings, 0);
  outcomes_.resize(mappings, at_.size());
  priorities_.resize(mappings);
  return added;
}

double AdaptiveLearner::loss_at(Number next) const noexcept {
  return next == kGoal ? 0.0 : at_[next].loss;
}

// q of a motion without outcomes.
double AdaptiveLearner::first_loss(Number situation) const noexcept {
  return (optimism_ - 1.0) * at_[situation].first_estimate;
}

// The mean over a mapping's outcomes of its loss and what is expected from there on.
template <typename LossAt>
double AdaptiveLearner::mean_loss(Number mapping, const LossAt& loss_at) const noexcept {
  double sum = 0.0;
  outcomes_.each_of(mapping, [&](const detail::OutcomeStore::Outcome& outcome) {
    sum += outcome.sum;
    if (outcome.next != kGoal) sum += outcome.times * loss_at(outcome.next);
  });
  return sum / outcomes_.times(mapping);
}

// E is the least q of what is allowed; those that lead here hear of a change.
void AdaptiveLearner::settle(Number situation) {
  Situation& here = at_[situation];
  const Number first = mapping(situation, 0);
  double least = kInfinity;
  for (Number i = first; i < first + motions(); ++i) {
    if (allowed_[i] != 0) least = std::min(least, q_[i]);
  }
  int effective = 0;
  for (Number i = first; i < first + motions(); ++i) {
    effective += q_[i] <= least && outcomes_.any(i) ? 1 : 0;
  }
  effective_count_ += effective - here.effective_count;
  here.effective_count = effective;
  const double change = std::abs(least - here.loss);
  here.loss = least;
  if (change > kSmallChange) {
    outcomes_.each_to(situation, [&](Number leading) { priorities_.raise(leading, change); });
  }
}

void AdaptiveLearner::recollect(int times) {
  for (int i = 0; i < times && !priorities_.empty(); ++i) {
    const Number first = priorities_.pop();
    const Number situation = situation_of(first);
    Recollection what{ids_.id(situation),  static_cast<int>(first - mapping(situation, 0)),
                      q_[first],           0.0,
                      at_[situation].loss, 0.0};
    q_[first] = mean_loss(first, [this](Number next) { return at_[next].loss; });
    settle(situation);
    what.loss = q_[first];
    what.expected = at_[situation].loss;
    if (recollected_.size() < most_told()) recollected_.push_back(what);
  }
}

Event AdaptiveLearner::add_outcome(Number mapping, Number next, double loss, bool interrupted) {
  const Number situation = situation_of(mapping);
  const bool first = !outcomes_.any(mapping);
  outcomes_.add(mapping, next, loss);
  interrupted_[mapping] = interrupted ? static_cast<std::uint32_t>(rounds_) : 0;
  if (first) {
    ++explored_count_;
    settle(situation);
  }
  priorities_.raise(mapping, kInfinity);
  recollected_.clear();
  recollect(config_.recollections);
  if (!first) return Event::kOrientation;
  return q_[mapping] <= at_[situation].loss ? Event::kExtension : Event::kRejection;
}

// --- choosing ------------------------------------------------------------------------------------

Choice AdaptiveLearner::choose(SituationId situation, double estimate, AllowedMotions allowed) {
  require_situation(situation);
  require_in("estimate", estimate, 0.0, kMostCost);
  allowed.validate(config_.motion_count);
  if (decision_.waiting) {
    throw InvalidValue("AdaptiveLearner.choose", "a second choice before the first met its step",
                       "learn() or cancel() between two choices");
  }
  outcomes_.make_room();
  const Number here = meet(situation, estimate);
  if (round_.arrived) {  // and no end_round: it goes on from the goal
    round_.over = true;
    round_.by_habit = round_.curious = false;
  }
  if (decision_.situation >= 0) {
    const bool same = decision_.situation == static_cast<int>(here);
    if (same && allowed(decision_.motion)) {
      decision_.waiting = true;
      return {decision_.motion, Kind::kHeld};
    }
    // It cannot be held, or the robot was put elsewhere.
    close_decision(static_cast<Number>(decision_.situation),
                   same ? estimate : decision_.last_estimate, true);
  }
  allow(here, allowed);
  if (in_round() && path_.empty() && round_.start != static_cast<int>(here)) {
    start_round(here, estimate);
  }
  remember_choice(here, allowed);
  const Choice choice = decide(here, estimate, allowed);
  last_.choice = choice;
  decision_ = {static_cast<int>(here),
               choice.motion,
               choice.kind,
               true,
               0,
               round_.cost,
               estimate,
               0.0,
               estimate};
  return choice;
}

// What is allowed here now.
void AdaptiveLearner::allow(Number here, AllowedMotions allowed) {
  bool changed = false;
  for (int m = 0; m < config_.motion_count; ++m) {
    std::uint8_t& known = allowed_[mapping(here, m)];
    const std::uint8_t now = allowed(m) ? 1 : 0;
    changed = changed || known != now;
    known = now;
  }
  if (changed) settle(here);
}

Choice AdaptiveLearner::decide(Number here, double estimate, AllowedMotions allowed) {
  if (round_.by_habit && round_.curious &&
      round_.cost + hoped_[here] + estimate > habit_.cost + kOpeningDetour) {
    round_.by_habit = false;  // there is no opening
  }
  if (const auto settled = settled_choice(here, allowed)) return *settled;
  const int motion = homeward() ? towards_home(here, allowed)
                                : at_[here].by_values = drawn(best_by_values(here, allowed));
  return for_values(here, motion);
}

// What there is no draw about.
std::optional<Choice> AdaptiveLearner::settled_choice(Number here, AllowedMotions allowed) const {
  const auto possible = [&](int motion) { return motion >= 0 && allowed(motion); };
  if (round_.by_habit && round_.curious) {
    const int motion = hopeful(here, allowed);
    if (stale(mapping(here, motion))) return Choice{motion, Kind::kDeviation};
    return for_values(here, motion);
  }
  if (round_.by_habit && round_.deviated && config_.refine) {
    const int before = decided(here) ? path_[at_[here].decided].motion : -1;
    if (possible(before)) return for_values(here, before);
  } else if (round_.by_habit) {
    const int deviation = deviation_here(here), habit = habit_motion(here);
    if (possible(deviation)) return Choice{deviation, Kind::kDeviation};
    if (possible(habit)) return Choice{habit, Kind::kHabit};
  } else if (homeward()) {
    return std::nullopt;
  }
  // By values: the one chosen before, while none is better.
  const int last = at_[here].by_values;
  if (last >= 0 && best_by_values(here, allowed)(last)) return for_values(here, last);
  return std::nullopt;
}

// Whether a motion explores or exploits.
Choice AdaptiveLearner::for_values(Number here, int motion) const noexcept {
  return {motion, outcomes_.any(mapping(here, motion)) ? Kind::kExploit : Kind::kExplore};
}

// Whether a motion is among those of least loss.
AdaptiveLearner::Among AdaptiveLearner::best_by_values(Number here,
                                                       AllowedMotions allowed) const noexcept {
  const double* const q = &q_[mapping(here, 0)];
  double least = kInfinity;
  for (int m = 0; m < config_.motion_count; ++m) {
    if (allowed(m)) least = std::min(least, q[m]);
  }
  return {q, least + detail::kSameLoss, allowed};
}

// Any motion of those, uniformly.
template <typename Of>
int AdaptiveLearner::drawn(const Of& among) {
  std::uint32_t count = 0;
  for (int m = 0; m < config_.motion_count; ++m) count += among(m) ? 1 : 0;
  std::uint32_t left = random_.index(count);
  for (int m = 0;; ++m) {
    if (among(m) && left-- == 0) return m;
  }
}

// The motion of least loss, the first in M among equals.
template <typename Loss>
int AdaptiveLearner::least_of(AllowedMotions allowed, const Loss& loss) const noexcept {
  double least = kInfinity;
  int best = -1;
  for (int m = 0; m < config_.motion_count; ++m) {
    if (!allowed(m)) continue;
    const double each = loss(m);
    if (best >= 0 && each >= least) continue;
    least = each;
    best = m;
  }
  return best;
}

void AdaptiveLearner::remember_choice(Number here, AllowedMotions allowed) {
  last_.situation = here;
  last_.loss = at_[here].loss;
  last_.deviation = deviation_here(here);
  last_.habit = goes_by_habit() ? habit_motion(here) : -1;
  last_.by_values = at_[here].by_values;
  last_.homeward = homeward();
  for (int m = 0; m < config_.motion_count; ++m) {
    const Number each = mapping(here, m);
    last_.losses[m] = q_[each];
    last_.times[m] = outcomes_.times(each);
    last_.allowed[m] = allowed(m) ? 1 : 0;
  }
}

std::optional<int> AdaptiveLearner::best(SituationId situation) const noexcept {
  const Number here = ids_.find(situation);
  if (here == kAbsent) return std::nullopt;
  std::optional<int> best;
  for (int m = 0; m < config_.motion_count; ++m) {
    const Number each = mapping(here, m);
    if (outcomes_.any(each) && (!best || q_[each] < q_[mapping(here, *best)])) best = m;
  }
  return best;
}

// --- learning ------------------------------------------------------------------------------------

Development AdaptiveLearner::learn(double cost, SituationId next, double next_estimate,
                                   bool interrupted) {
  if (!decision_.waiting) refuse_outcome("AdaptiveLearner.learn");
  require_in("cost", cost, 0.0, kMostCost);
  require_situation(next);
  require_in("next_estimate", next_estimate, 0.0, kMostCost);
  outcomes_.make_room();
  const bool arrived = next_estimate == 0.0;
  const Number there = arrived ? kGoal : meet(next, next_estimate);

  const auto here = static_cast<Number>(decision_.situation);
  if (decision_.steps == 0) begin_decision();
  decision_.waiting = false;
  decision_.spent += cost;
  decision_.last_estimate = next_estimate;
  ++decision_.steps;
  round_.cost += cost;
  round_.arrived = arrived;

  const AdaptiveDecision made = decision_;
  Event event = Event::kNothing;
  if (there != here || interrupted || decision_.steps >= config_.hold_limit) {
    event = close_decision(there, next_estimate, interrupted);
  }
  watch_habit(made, interrupted);
  if (config_.sweep_limit > 0) go_on_sweeping();
  return development(here, made.motion, event, next_estimate + loss_at(there));
}

// Its first step was made.
void AdaptiveLearner::begin_decision() {
  if (!in_round()) return;
  const auto here = static_cast<Number>(decision_.situation);
  if (decision_.kind == Kind::kDeviation) round_.deviated = true;
  if (!decided(here)) {
    at_[here].decided = static_cast<std::int32_t>(path_.size());
    path_.push_back({here, decision_.motion, decision_.before, decision_.estimate, false});
  } else if (path_[at_[here].decided].motion != decision_.motion) {
    round_.two_ways = true;
  }
}

Event AdaptiveLearner::close_decision(Number next, double estimate, bool interrupted) {
  const auto here = static_cast<Number>(decision_.situation);
  const Number made = mapping(here, decision_.motion);
  const bool on_trial = round_.curious && stale(made);
  if (on_trial && !interrupted) forget_outcomes(made);  // what was in the way is gone
  const double loss = decision_.spent + (estimate - decision_.estimate);
  const Event event = add_outcome(made, next, loss, interrupted);
  if (interrupted && in_round()) path_[at_[here].decided].interrupted = true;
  decision_ = {};
  if (on_trial) {
    hope_.begin(at_.size(), kHopePassesOnTheWay);
    if (config_.sweep_limit == 0) sweep_hope(kEveryMapping);
  }
  return event;
}

// What is told of an outcome, after it.
Development AdaptiveLearner::development(Number situation, int motion, Event event,
                                         double value) const noexcept {
  return {ids_.id(situation), motion, event, 0, explored_count_, effective_count_, value};
}

void AdaptiveLearner::cancel() {
  if (!decision_.waiting) refuse_outcome("AdaptiveLearner.cancel");
  if (decision_.steps > 0) {
    outcomes_.make_room();
    close_decision(static_cast<Number>(decision_.situation), decision_.last_estimate, true);
  }
  decision_ = {};
}

Development AdaptiveLearner::update(SituationId situation, int motion, double cost,
                                    SituationId next, double next_estimate,
                                    std::optional<double> estimate) {
  require_situation(situation);
  require_count("motion", motion, 0, config_.motion_count - 1);
  require_in("cost", cost, 0.0, kMostCost);
  require_situation(next);
  require_in("next_estimate", next_estimate, 0.0, kMostCost);
  if (estimate) require_in("estimate", *estimate, 0.0, kMostCost);
  if (!estimate && ids_.find(situation) == kAbsent) {
    throw InvalidValue("estimate", "none for a situation never met", "in [0, 1e12]");
  }
  outcomes_.make_room();
  const Number here = meet(situation, estimate.value_or(0.0));
  const Number there = next_estimate == 0.0 ? kGoal : meet(next, next_estimate);
  const double loss = cost + (next_estimate - estimate.value_or(at_[here].first_estimate));
  const Event event = add_outcome(mapping(here, motion), there, loss, false);
  return development(here, motion, event, next_estimate + loss_at(there));
}

// Of a mapping; its motion is untried again.
void AdaptiveLearner::forget_outcomes(Number mapping) noexcept {
  if (!outcomes_.any(mapping)) return;
  outcomes_.clear(mapping);
  priorities_.take(mapping);
  interrupted_[mapping] = 0;
  q_[mapping] = first_loss(situation_of(mapping));
  --explored_count_;
}

bool AdaptiveLearner::forget(SituationId situation) {
  require_situation(situation);
  const Number here = ids_.find(situation);
  if (here == kAbsent) return false;
  if (decision_.situation == static_cast<int>(here)) {
    throw InvalidValue("AdaptiveLearner.forget", "the situation in which a decision is open",
                       "its end, or cancel(), before it");
  }
  for (int m = 0; m < config_.motion_count; ++m) forget_outcomes(mapping(here, m));
  settle(here);
  at_[here].by_values = -1;
  if (habit_motion(here) >= 0) {
    round_.by_habit = false;
    drop_habit();
  }
  return true;
}

// --- rounds and the habit ------------------------------------------------------------------------

void AdaptiveLearner::begin_round() {
  decision_ = {};
  round_ = {};
  round_.begun = true;
  ++rounds_;
  path_.clear();
  if (config_.curious_every > 0) reconsider_trials();
}

void AdaptiveLearner::end_round(bool arrived) {
  if (!round_.begun) {
    throw InvalidValue("AdaptiveLearner.end_round", "no round", "a begin_round() before it");
  }
  const AdaptiveRound round = round_;
  decision_ = {};
  round_ = {};
  if (!round.over && !path_.empty()) count_round(round, arrived);
  path_.clear();
}

void AdaptiveLearner::count_round(const AdaptiveRound& round, bool arrived) {
  if (arrived) habit_.least = std::min(habit_.least, round.cost);
  if (habit_.start >= 0 && round.start != habit_.start) return;
  if (!arrived || round.two_ways || round.cost >= habit_.cost) {
    ++habit_.since;
    return;
  }
  forget_trials();
  habit_path_.swap(path_);
  for (std::size_t i = 0; i < habit_path_.size(); ++i) {
    at_[habit_path_[i].situation].habit = static_cast<std::int32_t>(i);
  }
  habit_.cost = round.cost;
  habit_.start = round.start;
  habit_.since_look = 0;
  habit_.looking = false;
  if (!round.deviated) habit_.since = 0;
}

// The motion by which this round is to deviate here, or -1.
int AdaptiveLearner::deviation_here(Number here) const noexcept {
  const bool target =
      round_.by_habit && !round_.deviated && round_.target_situation == static_cast<int>(here);
  return target ? round_.target_motion : -1;
}

// At a round's first decision: whether it goes by habit, and where it is to deviate. Likewise where
// that one was cancelled, and the first step is made elsewhere.
void AdaptiveLearner::start_round(Number here, double estimate) {
  round_.curious = round_.deviated = false;
  round_.target_situation = round_.target_motion = -1;
  round_.start = static_cast<int>(here);
  round_.by_habit =
      round_.start == habit_.start && habit_.since >= config_.patience && habit_.cost < kInfinity;
  if (!round_.by_habit) return;
  if (look_for_openings(here, estimate)) {
    round_.curious = round_.deviated = true;
    return;
  }
  if (look_for_target()) return;
  if (config_.refine && optimism_ > 1.0 && !falling_.under_way()) {
    lower_optimism();
    if (!falling_.under_way()) look_for_target();
  }
}

// Of all other motions on the habit's way, the one that promises most, if it does at all.
bool AdaptiveLearner::look_for_target() {
  double least = habit_.cost - config_.gain;
  for (const Waypoint& on_the_way : habit_path_) {
    for (int m = 0; m < config_.motion_count; ++m) {
      const Number other = mapping(on_the_way.situation, m);
      if (m == on_the_way.motion || on_trial_[other] != 0 || allowed_[other] == 0) continue;
      const double promise = on_the_way.before + on_the_way.estimate + q_[other];
      if (promise < least) {
        least = promise;
        round_.target_situation = static_cast<int>(on_the_way.situation);
        round_.target_motion = m;
      }
    }
  }
  if (round_.target_motion < 0) return false;
  const Number target = mapping(static_cast<Number>(round_.target_situation), round_.target_motion);
  on_trial_[target] = 1;
  if (config_.curious_every > 0) trial_loss_[target] = kInfinity;
  return true;
}

// f(mapping) for each of the motions on the habit's way.
template <typename F>
void AdaptiveLearner::each_on_the_way(const F& f) {
  for (const Waypoint& on_the_way : habit_path_) {
    for (int m = 0; m < config_.motion_count; ++m) f(mapping(on_the_way.situation, m));
  }
}

void AdaptiveLearner::forget_trials() {
  each_on_the_way([this](Number mapping) { on_trial_[mapping] = 0; });
}

// One whose loss has fallen since it was tried may be tried again.
void AdaptiveLearner::reconsider_trials() {
  each_on_the_way([this](Number mapping) {
    if (on_trial_[mapping] == 0) return;
    double& then = trial_loss_[mapping];
    if (then == kInfinity) then = q_[mapping];
    if (q_[mapping] < then - kRetrial) on_trial_[mapping] = 0;
  });
}

// The world is no longer as it was, or what the habit stands on was forgotten.
void AdaptiveLearner::drop_habit() {
  const double least = habit_.least;
  habit_ = {};
  habit_.least = least;
  forget_trials();
  habit_path_.clear();
}

void AdaptiveLearner::watch_habit(const AdaptiveDecision& made, bool interrupted) {
  if (!round_.by_habit) return;
  if (round_.deviated) {
    if (round_.cost > habit_.cost + config_.detour) round_.by_habit = false;
    return;
  }
  const auto here = static_cast<Number>(made.situation);
  const bool as_ever = !interrupted || (habit_motion(here) == made.motion &&
                                        habit_path_[at_[here].habit].interrupted);
  if (as_ever && round_.cost <= habit_.cost * (1.0 + config_.tolerance)) return;
  round_.by_habit = false;
  drop_habit();
}

// --- sweeps over all that is known ---------------------------------------------------------------

// A situation's value becomes the least loss of what is allowed there; by how much it changed.
template <typename Loss>
double AdaptiveLearner::revalue(std::vector<double>& values, Number situation, const Loss& loss) {
  double least = kInfinity;
  const Number first = mapping(situation, 0);
  for (Number each = first; each < first + motions(); ++each) {
    if (allowed_[each] != 0) least = std::min(least, loss(each));
  }
  const double before = values[situation];
  values[situation] = least;
  return least == before ? 0.0 : std::abs(least - before);
}

void AdaptiveLearner::go_on_sweeping() {
  const auto limit = static_cast<std::size_t>(config_.sweep_limit);
  sweep_home(limit);
  sweep_falling(limit);
  sweep_hope(limit);
}

template <typename Visit>
void AdaptiveLearner::go_on(detail::Sweep& sweep, std::size_t mappings, double small,
                            const Visit& visit) {
  sweep.go_on(at_.size(), std::max<std::size_t>(1, mappings / motions()), small, visit);
}

void AdaptiveLearner::lower_optimism() {
  optimism_ = std::max(1.0, optimism_ - kOptimismStep);
  falling_.begin(at_.size(), 1);
  forget_trials();
  if (config_.sweep_limit > 0) return;
  sweep_falling(kEveryMapping);
  recollect(kFallingRecollections);
}

void AdaptiveLearner::sweep_falling(std::size_t mappings) {
  go_on(falling_, mappings, 0.0, [this](Number situation, detail::Sweep&) {
    for (int m = 0; m < config_.motion_count; ++m) {
      const Number each = mapping(situation, m);
      if (!outcomes_.any(each)) q_[each] = first_loss(situation);
    }
    settle(situation);
    return 0.0;
  });
}

// What an untried motion counts as on the way home: more than any known way.
double AdaptiveLearner::unknown_loss() const noexcept { return kUnknown * habit_.least; }

bool AdaptiveLearner::homeward() const noexcept {
  return in_round() && !round_.by_habit && round_.cost > config_.enough * habit_.least;
}

double AdaptiveLearner::loss_home(Number mapping) const noexcept {
  if (!outcomes_.any(mapping)) return unknown_loss();
  return mean_loss(mapping, [this](Number next) {
    return known_[next] < kInfinity ? known_[next] : unknown_loss();
  });
}

void AdaptiveLearner::sweep_home(std::size_t mappings) {
  go_on(home_, mappings, kHomeChange, [this](Number situation, detail::Sweep&) {
    return revalue(known_, situation, [this](Number each) { return loss_home(each); });
  });
}

int AdaptiveLearner::towards_home(Number here, AllowedMotions allowed) {
  if (round_.decisions_home < 0 || round_.decisions_home >= kHomeDecisions) {
    round_.decisions_home = 0;
    if (!home_.under_way()) home_.begin(at_.size(), kHomePasses);
    if (config_.sweep_limit == 0) sweep_home(kEveryMapping);
  }
  ++round_.decisions_home;
  if (random_.index(kHomeDraws) == 0) return drawn(allowed);
  return least_of(allowed, [&](int m) { return loss_home(mapping(here, m)); });
}

bool AdaptiveLearner::stale(Number mapping) const noexcept {
  const std::uint32_t round = interrupted_[mapping];
  return round != 0 && static_cast<std::uint32_t>(rounds_) - round >=
                           static_cast<std::uint32_t>(config_.stale_after);
}

// q where what once was in the way is hoped to be gone.
double AdaptiveLearner::hope(Number mapping) const noexcept {
  if (!outcomes_.any(mapping)) return q_[mapping];
  if (stale(mapping)) return std::min(q_[mapping], first_loss(situation_of(mapping)));
  return mean_loss(mapping, [this](Number next) { return hoped_[next]; });
}

void AdaptiveLearner::sweep_hope(std::size_t mappings) {
  go_on(hope_, mappings, kHopeChange, [this](Number situation, detail::Sweep& sweep) {
    for (int m = 0; m < config_.motion_count; ++m) {
      sweep.found = sweep.found || stale(mapping(situation, m));
    }
    return revalue(hoped_, situation, [this](Number each) { return hope(each); });
  });
}

// Whether this round is to be curious.
bool AdaptiveLearner::look_for_openings(Number here, double estimate) {
  if (config_.curious_every == 0 || ++habit_.since_look < config_.curious_every) return false;
  if (!habit_.looking) {
    habit_.looking = true;
    for (std::size_t i = 0; i < at_.size(); ++i) hoped_[i] = at_[i].loss;
    hope_.begin(at_.size(), kHopePasses);
    if (config_.sweep_limit == 0) sweep_hope(kEveryMapping);
  }
  if (hope_.under_way()) return false;
  habit_.looking = false;
  habit_.since_look = 0;
  return hope_.found && hoped_[here] + estimate < habit_.cost - kOpening;
}

int AdaptiveLearner::hopeful(Number here, AllowedMotions allowed) const noexcept {
  return least_of(allowed, [&](int m) { return hope(mapping(here, m)); });
}

}  // namespace devlearn
