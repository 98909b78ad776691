#include "devlearn/learner.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "devlearn/math.hpp"

namespace devlearn {
namespace {

[[noreturn]] void refuse_situation(SituationId situation) {
  throw InvalidValue("situation", std::to_string(situation), "a whole number in [0, 2^63 - 1]");
}

void require_situation(SituationId situation) {
  if (situation < 0) refuse_situation(situation);
}

[[noreturn]] void refuse_second_choice() {
  throw InvalidValue("Learner.choose", "a second choice before the first met its outcome",
                     "learn() or cancel() between two choices");
}

[[noreturn]] void refuse_outcome(const char* call) {
  throw InvalidValue(call, "no choice that waits for its outcome", "a choose() before it");
}

[[noreturn]] void refuse_memory(const char* quantity, std::size_t i, const std::string& value,
                                const char* allowed) {
  throw InvalidValue("memory." + std::string(quantity) + "[" + std::to_string(i) + "]", value,
                     allowed);
}

void require_size(const char* quantity, std::size_t size, std::size_t expected) {
  if (size != expected) {
    throw InvalidValue("memory." + std::string(quantity), std::to_string(size) + " values",
                       std::to_string(expected) + " values");
  }
}

// The laws of one situation's lists: they partition M, and what is unexplored is ascending.
void require_partition(const LearnerMemory& all, std::size_t i, int motion_count,
                       std::vector<bool>& seen) {
  const int n = all.effective_count[i], tried = n + all.ineffective_count[i];
  if (tried > motion_count) {
    refuse_memory("ineffective_count", i, std::to_string(all.ineffective_count[i]),
                  "no more than motion_count less the effective ones");
  }
  const std::uint16_t* motions = &all.motions[i * motion_count];
  std::fill(seen.begin(), seen.end(), false);
  for (int j = 0; j < motion_count; ++j) {
    if (motions[j] >= motion_count || seen[motions[j]]) {
      refuse_memory("motions", i, std::to_string(motions[j]), "each motion of M once");
    }
    seen[motions[j]] = true;
    if (j > tried && motions[j] < motions[j - 1]) {
      refuse_memory("motions", i, std::to_string(motions[j]), "unexplored motions ascending");
    }
  }
}

// Reduction leaves none below 1/(3 n_i), and then each extension the share n_i/(n_i + 1): no
// history of N motions goes below 1/(3 N^2). From zeros the divisions of Eq. 9 and 14 could make
// NaN.
constexpr double kLeastOrientation = 1e-12;

void require_orientations(const LearnerMemory& all, std::size_t i, std::size_t first) {
  double sum = 0.0;
  for (std::size_t j = first; j < first + all.effective_count[i]; ++j) {
    if (!(all.orientation[j] >= kLeastOrientation && all.orientation[j] <= 1.0)) {
      refuse_memory("orientation", j, to_text(all.orientation[j]), "in [1e-12, 1]");
    }
    if (all.times_learned[j] < 1) refuse_memory("times_learned", j, "0", "at least 1");
    sum += all.orientation[j];
  }
  if (all.effective_count[i] > 0 && !(std::abs(sum - 1.0) <= 1e-9)) {
    refuse_memory("orientation", first, "a sum of " + to_text(sum),
                  "a sum of 1 within 1e-9 in each situation");
  }
}

void require_laws(const LearnerState& state) {
  const LearnerMemory& all = state.memory;
  const int motion_count = state.config.motion_count;
  const std::size_t situations = all.situation.size();
  require_size("effective_count", all.effective_count.size(), situations);
  require_size("ineffective_count", all.ineffective_count.size(), situations);
  require_size("motions", all.motions.size(), situations * motion_count);
  const auto effective =
      std::accumulate(all.effective_count.begin(), all.effective_count.end(), std::size_t{0});
  require_size("orientation", all.orientation.size(), effective);
  require_size("times_learned", all.times_learned.size(), effective);

  std::vector<bool> seen(static_cast<std::size_t>(motion_count));
  std::size_t first = 0;
  for (std::size_t i = 0; i < situations; ++i) {
    if (all.situation[i] < 0) {
      refuse_memory("situation", i, std::to_string(all.situation[i]), "at least 0");
    }
    require_partition(all, i, motion_count, seen);
    require_orientations(all, i, first);
    first += all.effective_count[i];
  }
  if (state.random == Random::State{}) {
    throw InvalidValue("random", "all zeros", "a state of the generator");
  }
  if (state.pending) {
    require_count("pending.motion", state.pending->choice.motion, 0, motion_count - 1);
    require_count("pending.kind", static_cast<int>(state.pending->choice.kind), 0, 2);
  }
}

}  // namespace

LearnerConfig LearnerConfig::step5() {
  LearnerConfig config;
  config.on_negative = OnNegative::kWeaken;
  config.when_exhausted = WhenExhausted::kWander;
  return config;
}

void LearnerConfig::validate() const {
  require_count("LearnerConfig.motion_count", motion_count, 1, 65535);
  require_between("LearnerConfig.eta", eta, 0.0, 1.0);
  require_between("LearnerConfig.sigma", sigma, 0.0, 1.0);
  require_in("LearnerConfig.c1", c1, 0.0, 1e6);
  require_in("LearnerConfig.c2", c2, -1e6, 1e6);
  require_count("LearnerConfig.on_negative", static_cast<int>(on_negative), 0, 1);
  require_count("LearnerConfig.when_exhausted", static_cast<int>(when_exhausted), 0, 1);
}

bool operator==(const LearnerConfig& a, const LearnerConfig& b) noexcept {
  return a.motion_count == b.motion_count && a.eta == b.eta && a.sigma == b.sigma && a.c1 == b.c1 &&
         a.c2 == b.c2 && a.on_negative == b.on_negative && a.when_exhausted == b.when_exhausted;
}

Learner::Learner(const LearnerConfig& config, std::uint64_t seed)
    : config_((config.validate(), config)),
      seed_(seed),
      random_(seed, "agent"),
      curiosity_(config.c1, config.c2),
      store_(config.motion_count),
      last_block_(store_.block_bytes()) {}

Learner::Learner(const LearnerState& state) : Learner(state.config, state.seed) {
  require_laws(state);
  random_ = Random(state.random);
  const LearnerMemory& all = state.memory;
  reserve(all.situation.size());
  const double* orientation = all.orientation.data();
  const std::uint32_t* times_learned = all.times_learned.data();
  for (std::size_t i = 0; i < all.situation.size(); ++i) {
    const Slot slot = store_.find_or_add(all.situation[i]);
    if (slot != store_.nth(i))
      refuse_memory("situation", i, std::to_string(all.situation[i]), "each id once");
    const int n = all.effective_count[i], ineffective = all.ineffective_count[i];
    store_.memory(slot).assign(&all.motions[i * config_.motion_count], n, ineffective, orientation,
                               times_learned);
    orientation += n;
    times_learned += n;
    effective_count_ += n;
    explored_count_ += n + ineffective;
  }
  if (state.pending) {
    pending_slot_ = store_.find(state.pending->situation);
    pending_choice_ = state.pending->choice;
    if (pending_slot_ == SituationStore::kAbsent) {
      throw InvalidValue("pending.situation", std::to_string(state.pending->situation),
                         "a situation that was experienced");
    }
    pending_place_ = store_.memory(pending_slot_).place_of(pending_choice_.motion);
  }
}

Choice Learner::choose(SituationId situation) {
  require_situation(situation);
  if (pending_slot_ != SituationStore::kAbsent) refuse_second_choice();
  const Slot slot = store_.find_or_add(situation);
  const MotorMemory here = store_.memory(slot);
  std::memcpy(last_block_.data(), store_.block(slot), last_block_.size());
  const auto outcomes = static_cast<std::uint32_t>(outcome_count(here));
  last_outcome_ = static_cast<int>(random_.index(outcomes));
  const int place = choose_motion(here, last_outcome_, config_.sigma, curiosity_);
  const Choice choice = choice_at(here, place);
  pending_slot_ = slot;
  pending_place_ = place;
  pending_choice_ = choice;
  return choice;
}

Development Learner::learn(double smf) {
  const Slot slot = require_pending("Learner.learn");
  require_finite("smf", smf);
  pending_slot_ = SituationStore::kAbsent;
  return develop(slot, pending_place_, smf);
}

Development Learner::learn(double smf, int motion) {
  const Slot slot = require_pending("Learner.learn");
  require_finite("smf", smf);
  require_count("motion", motion, 0, config_.motion_count - 1);
  pending_slot_ = SituationStore::kAbsent;
  return develop(slot, store_.memory(slot).place_of(motion), smf);
}

void Learner::cancel() {
  require_pending("Learner.cancel");
  pending_slot_ = SituationStore::kAbsent;
}

Development Learner::update(SituationId situation, int motion, double smf) {
  require_situation(situation);
  require_count("motion", motion, 0, config_.motion_count - 1);
  require_finite("smf", smf);
  const Slot slot = store_.find_or_add(situation);
  const MotorMemory memory = store_.memory(slot);
  const Development development = develop(slot, memory.place_of(motion), smf);
  if (slot == pending_slot_) pending_place_ = memory.place_of(pending_choice_.motion);
  return development;
}

// Steps 4 and 5.
Development Learner::develop(Slot slot, int place, double smf) noexcept {
  MotorMemory situation = store_.memory(slot);
  Development development;
  development.situation = store_.id(slot);
  development.motion = situation.motion(place);

  const int effective_before = situation.effective_count();
  const bool effective = smf >= 0.0;
  switch (situation.list(place)) {
    case MotorMemory::List::kUnexplored:
      ++explored_count_;
      if (effective) {
        situation.extend(place);
        development.event = Event::kExtension;
      } else {
        situation.reject(place);
        development.event = Event::kRejection;
      }
      break;

    case MotorMemory::List::kEffective:
      situation.count_learning(place);
      if (!effective && config_.on_negative == OnNegative::kAbandon) {
        situation.abandon(place);
        development.event = Event::kAbandonment;
      } else {
        development.event = Event::kOrientation;
        if (effective_before > 1) {  // a sole motion has nothing to change
          // Below D = -1 Eq. 9 would leave [0, 1].
          const double d = std::max(-1.0, 1.0 - exponential(-config_.eta * smf));
          situation.orient(place, d);
          development.reduced = situation.reduce();
        }
      }
      break;

    case MotorMemory::List::kIneffective:
      if (effective && config_.when_exhausted == WhenExhausted::kRetry) {
        situation.extend(place);
        development.event = Event::kExtension;
      }
      break;
  }
  effective_count_ += situation.effective_count() - effective_before;
  return development;
}

SituationMemory Learner::situation(SituationId situation) const {
  require_situation(situation);
  std::vector<std::byte> fresh;
  return store_.look_up(situation, fresh).copy();
}

std::vector<SituationId> Learner::situations() const {
  std::vector<SituationId> ids(store_.size());
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = store_.id(store_.nth(i));
  return ids;
}

Explanation Learner::explain(SituationId situation) const {
  require_situation(situation);
  std::vector<std::byte> fresh;
  return devlearn::explain(situation, store_.look_up(situation, fresh), config_.sigma, curiosity_);
}

std::optional<ChoiceTrace> Learner::last_choice() const {
  if (last_outcome_ < 0) return std::nullopt;
  const std::byte* const block = last_block_.data();
  return trace(store_.id_in(block), store_.memory_in(block), last_outcome_, config_.sigma,
               curiosity_);
}

LearnerState Learner::state() const {
  LearnerState state;
  state.config = config_;
  state.seed = seed_;
  state.random = random_.state();
  if (pending_slot_ != SituationStore::kAbsent)
    state.pending = {store_.id(pending_slot_), pending_choice_};
  LearnerMemory& all = state.memory;
  all.situation = situations();
  all.effective_count.reserve(store_.size());
  all.ineffective_count.reserve(store_.size());
  all.motions.reserve(store_.size() * config_.motion_count);
  all.orientation.reserve(static_cast<std::size_t>(effective_count_));
  all.times_learned.reserve(static_cast<std::size_t>(effective_count_));
  for (std::size_t i = 0; i < store_.size(); ++i) {
    const MotorMemory memory = store_.memory(store_.nth(i));
    memory.append_to(all.motions, all.orientation, all.times_learned);
    all.effective_count.push_back(static_cast<std::uint16_t>(memory.effective_count()));
    all.ineffective_count.push_back(static_cast<std::uint16_t>(memory.ineffective_count()));
  }
  return state;
}

std::optional<Choice> Learner::pending() const noexcept {
  if (pending_slot_ == SituationStore::kAbsent) return std::nullopt;
  return pending_choice_;
}

Learner::Slot Learner::require_pending(const char* call) const {
  if (pending_slot_ == SituationStore::kAbsent) refuse_outcome(call);
  return pending_slot_;
}

}  // namespace devlearn
