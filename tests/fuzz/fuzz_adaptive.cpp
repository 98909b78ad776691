#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "devlearn/adaptive.hpp"
#include "devlearn/snapshot.hpp"
#include "law.hpp"
#include "snapshot.hpp"

// Any bytes are refused with a FileError, or make an adaptive learner that keeps its laws, saves to
// what loads equal, and lives on by those laws.
using namespace devlearn;

namespace {

std::optional<AdaptiveLearner> loaded(const std::vector<std::byte>& bytes) {
  try {
    return load_adaptive_learner(bytes.data(), bytes.size());
  } catch (const FileError& error) {
    fuzz::require_fit(error);
    return std::nullopt;
  }
}

void require_laws(const AdaptiveLearner& learner) {
  const auto motions = static_cast<std::size_t>(learner.config().motion_count);
  std::int64_t explored = 0, effective = 0;
  for (const SituationId id : learner.situations()) {
    const AdaptiveMemory memory = learner.situation(id);
    fuzz::require(std::isfinite(memory.expected_loss), "E is finite");
    for (const double loss : memory.losses) fuzz::require(std::isfinite(loss), "q is finite");
    fuzz::require(
        memory.effective.size() + memory.ineffective.size() + memory.unexplored.size() == motions,
        "the lists partition M");
    effective += static_cast<std::int64_t>(memory.effective.size());
    explored += static_cast<std::int64_t>(motions - memory.unexplored.size());
    fuzz::require(learner.best(id).has_value() == (memory.unexplored.size() < motions),
                  "there is a best motion where one was tried");
  }
  fuzz::require(learner.effective_count() == effective, "NUM_M counts the effective");
  fuzz::require(learner.explored_count() == explored, "NUM_RM counts the explored");
  fuzz::require(learner.optimism() >= 1.0, "optimism falls no further than to 1");
}

template <typename T, std::size_t N>
T any(const T (&values)[N], Random& random) {
  return values[random.index(N)];
}

// Steps, rounds and calls of every kind, in situations that are known and in new ones.
class Life {
 public:
  explicit Life(AdaptiveLearner& learner)
      : learner_(learner), random_(learner.seed(), "life"), ids_(learner.situations()) {
    if (ids_.size() > 8) ids_.resize(8);
    ids_.insert(ids_.end(), {0, 1});
    here_ = id();
  }

  void step() {
    switch (random_.index(24)) {
      case 0:
        learner_.begin_round();
        here_ = ids_.front();
        break;
      case 1:
        if (learner_.in_round()) learner_.end_round(random_.index(4) != 0);
        break;
      case 2:
        learner_.update(id(), motion(), cost(), id(), estimate(), estimate());
        break;
      case 3:
        if (!learner_.pending() && random_.index(4) == 0) forget();
        break;
      case 4:
        learner_.explain(id());
        learner_.last_choice();
        break;
      case 5:
        here_ = id();
        break;
      default:
        move();
    }
  }

 private:
  SituationId id() { return ids_[random_.index(static_cast<std::uint32_t>(ids_.size()))]; }
  int motion() {
    return static_cast<int>(
        random_.index(static_cast<std::uint32_t>(learner_.config().motion_count)));
  }
  double cost() {
    static constexpr double kCosts[] = {0.0, 1.0, 1.0, 1.0, 6.0, 1e12};
    return any(kCosts, random_);
  }
  double estimate() {
    static constexpr double kEstimates[] = {0.0, 0.5, 3.0, 10.0, 30.0, 1e12};
    return any(kEstimates, random_);
  }

  void move() {
    if (!learner_.pending()) choose();
    if (random_.index(16) == 0) {
      learner_.cancel();
      return;
    }
    here_ = random_.index(2) == 0 ? here_ : id();
    learner_.learn(cost(), here_, estimate(), random_.index(6) == 0);
  }

  void choose() {
    if (random_.index(4) != 0) {
      learner_.choose(here_, estimate());
      return;
    }
    const auto motions = static_cast<std::size_t>(learner_.config().motion_count);
    const auto allowed = std::make_unique<bool[]>(motions);
    for (std::size_t i = 0; i < motions; ++i) allowed[i] = random_.index(2) == 0;
    allowed[static_cast<std::size_t>(motion())] = true;
    learner_.choose(here_, estimate(), {allowed.get(), motions});
  }

  void forget() {
    try {
      learner_.forget(id());
    } catch (const InvalidValue&) {
      // A decision is open there.
    }
  }

  AdaptiveLearner& learner_;
  Random random_;
  std::vector<SituationId> ids_;
  SituationId here_ = 0;
};

// What is recalled in a step is the caller's wish: fewer steps where that is much.
void live(AdaptiveLearner& learner) {
  const AdaptiveConfig& config = learner.config();
  const double dear = config.motion_count * (100.0 + std::min(config.recollections, 100'000));
  const int steps = static_cast<int>(std::clamp(1e7 / dear, 2.0, 200.0));
  Life life(learner);
  for (int i = 0; i < steps; ++i) life.step();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::optional<AdaptiveLearner> learner = loaded(fuzz::mended(data, size));
  if (!learner) return 0;
  require_laws(*learner);

  const std::vector<std::byte> bytes = to_bytes(*learner);
  std::optional<AdaptiveLearner> again = loaded(bytes);
  fuzz::require(again.has_value(), "what was saved loads");
  fuzz::require(to_bytes(*again) == bytes, "what was saved loads equal");

  live(*learner);
  require_laws(*learner);
  live(*again);
  fuzz::require(to_bytes(*again) == to_bytes(*learner), "both live on alike");
  return 0;
}
