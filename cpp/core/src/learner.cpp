#include "devlearn/learner.hpp"

#include <algorithm>
#include <cstring>
#include <string>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "devlearn/math.hpp"

namespace devlearn {
namespace {

[[noreturn]] void refuse_second_choice() {
  throw InvalidValue("Learner.choose", "a second choice before the first met its outcome",
                     "learn() or cancel() between two choices");
}

[[noreturn]] void refuse_outcome(const char* call) {
  throw InvalidValue(call, "no choice that waits for its outcome", "a choose() before it");
}

}  // namespace

LearnerConfig LearnerConfig::step5() {
  LearnerConfig config;
  config.on_negative = OnNegative::kWeaken;
  config.when_exhausted = WhenExhausted::kWander;
  return config;
}

void LearnerConfig::validate() const { detail::require_fields(*this); }

bool operator==(const LearnerConfig& a, const LearnerConfig& b) noexcept {
  return detail::same_fields(a, b);
}

Learner::Learner(const LearnerConfig& config, std::uint64_t seed)
    : config_((config.validate(), config)),
      seed_(seed),
      random_(seed, "agent"),
      curiosity_(config.c1, config.c2),
      store_(config.motion_count),
      last_block_(store_.block_bytes() + static_cast<std::size_t>(config.motion_count)) {}

Learner& Learner::operator=(const Learner& other) {
  if (this == &other) return *this;
  if (config_.motion_count != other.config_.motion_count) return *this = Learner(other);
  store_ = other.store_;  // the one that may throw
  config_ = other.config_;
  seed_ = other.seed_;
  random_ = other.random_;
  curiosity_ = other.curiosity_;
  pending_slot_ = other.pending_slot_;
  pending_choice_ = other.pending_choice_;
  pending_place_ = other.pending_place_;
  std::memcpy(last_block_.data(), other.last_block_.data(), last_block_.size());
  last_every_ = other.last_every_;
  last_draw_ = other.last_draw_;
  explored_count_ = other.explored_count_;
  effective_count_ = other.effective_count_;
  return *this;
}

Choice Learner::choose(SituationId situation, AllowedMotions allowed) {
  require_situation(situation);
  if (pending_slot_ != SituationStore::kAbsent) refuse_second_choice();
  allowed.validate(config_.motion_count);
  const Slot slot = store_.find_or_add(situation);
  const MotorMemory here = store_.memory(slot);
  std::memcpy(last_block_.data(), store_.block(slot), store_.block_bytes());
  last_every_ = allowed.every();
  if (!last_every_) {
    std::memcpy(last_block_.data() + store_.block_bytes(), allowed.data(), allowed.size());
  }
  const Candidates left = candidates(here, allowed);
  last_draw_ = static_cast<int>(random_.index(static_cast<std::uint32_t>(left.count())));
  const int place = choose_motion(here, left, last_draw_, config_.sigma, curiosity_, allowed);
  const Choice choice = choice_at(here, place);
  pending_slot_ = slot;
  pending_place_ = place;
  pending_choice_ = choice;
  return choice;
}

std::optional<int> Learner::best(SituationId situation) const noexcept {
  const Slot slot = store_.find(situation);
  if (slot == SituationStore::kAbsent) return std::nullopt;
  const MotorMemory memory = store_.memory(slot);
  const double* const o = memory.orientations();
  const int n = memory.effective_count();
  if (n == 0) return std::nullopt;
  return memory.motion(static_cast<int>(std::max_element(o, o + n) - o));
}

bool Learner::forget(SituationId situation) {
  require_situation(situation);
  const Slot slot = store_.find(situation);
  if (slot == SituationStore::kAbsent) return false;
  if (slot == pending_slot_) {
    throw InvalidValue("Learner.forget", "the situation in which a choice waits for its outcome",
                       "learn() or cancel() before it");
  }
  const MotorMemory memory = store_.memory(slot);
  explored_count_ -= memory.tried_count();
  effective_count_ -= memory.effective_count();
  if (pending_slot_ == store_.nth(store_.size() - 1)) pending_slot_ = slot;
  store_.forget(situation);
  return true;
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
  development.explored_count = explored_count_;
  development.effective_count = effective_count_;
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

Explanation Learner::explain(SituationId situation, AllowedMotions allowed) const {
  require_situation(situation);
  allowed.validate(config_.motion_count);
  std::vector<std::byte> fresh;
  return devlearn::explain(situation, store_.look_up(situation, fresh), config_.sigma, curiosity_,
                           allowed);
}

std::optional<ChoiceTrace> Learner::last_choice() const {
  if (last_draw_ < 0) return std::nullopt;
  const std::byte* const block = last_block_.data();
  const std::size_t bytes = store_.block_bytes();
  const AllowedMotions allowed = last_every_
                                     ? AllowedMotions()
                                     : AllowedMotions(reinterpret_cast<const bool*>(block + bytes),
                                                      last_block_.size() - bytes);
  return trace(store_.id_in(block), store_.memory_in(block), last_draw_, config_.sigma, curiosity_,
               allowed);
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
