// What a learner goes on from, and the laws that a state must keep to be gone on from.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "devlearn/learner.hpp"

namespace devlearn {
namespace {

[[noreturn]] void refuse_memory(const char* quantity, std::size_t i, const std::string& value,
                                const char* allowed) {
  throw InvalidValue("memory." + std::string(quantity) + "[" + std::to_string(i) + "]", value,
                     allowed);
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
  require_size("memory.effective_count", all.effective_count.size(), situations);
  require_size("memory.ineffective_count", all.ineffective_count.size(), situations);
  require_size("memory.motions", all.motions.size(), std::uint64_t{situations} * motion_count);
  const auto effective =
      std::accumulate(all.effective_count.begin(), all.effective_count.end(), std::size_t{0});
  require_size("memory.orientation", all.orientation.size(), effective);
  require_size("memory.times_learned", all.times_learned.size(), effective);

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

}  // namespace devlearn
