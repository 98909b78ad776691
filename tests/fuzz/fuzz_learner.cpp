#include <optional>

#include "devlearn/random.hpp"
#include "devlearn/snapshot.hpp"
#include "law.hpp"
#include "snapshot.hpp"

// Any bytes are refused with a FileError, or make a learner that obeys the laws of the method,
// saves to what loads equal, and lives on by those laws.
using namespace devlearn;

namespace {

std::optional<Learner> loaded(const std::vector<std::byte>& bytes) {
  try {
    return load_learner(bytes.data(), bytes.size());
  } catch (const FileError& error) {
    fuzz::require_fit(error);
    return std::nullopt;
  }
}

double outcome(Random& random) {
  static constexpr double kOutcomes[] = {0.0, 1.0, -1.0, 0.1, -0.1, 50.0, -50.0, 1e300, -1e300};
  return kOutcomes[random.index(std::size(kOutcomes))];
}

// Steps of every kind, in situations that are known and in new ones.
void live(Learner& learner) {
  Random random(learner.seed(), "outcomes");
  std::vector<SituationId> ids = learner.situations();
  if (ids.size() > 5) ids.resize(5);
  ids.insert(ids.end(), {0, 1});
  const auto motions = static_cast<std::uint32_t>(learner.config().motion_count);
  if (learner.pending()) learner.learn(outcome(random));
  for (int step = motions > 100 ? 4 : 24; step > 0; --step) {
    const SituationId id = ids[random.index(static_cast<std::uint32_t>(ids.size()))];
    learner.update(id, static_cast<int>(random.index(motions)), outcome(random));
    learner.choose(id);
    switch (random.index(4)) {
      case 0:
        learner.cancel();
        break;
      case 1:
        learner.learn(outcome(random), static_cast<int>(random.index(motions)));
        break;
      default:
        learner.learn(outcome(random));
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::optional<Learner> learner = loaded(fuzz::mended(data, size));
  if (!learner) return 0;
  fuzz::require_laws(*learner);

  const std::vector<std::byte> bytes = to_bytes(*learner);
  std::optional<Learner> again = loaded(bytes);
  fuzz::require(again.has_value(), "what was saved loads");
  fuzz::require(to_bytes(*again) == bytes, "what was saved loads equal");

  live(*learner);
  fuzz::require_laws(*learner);
  live(*again);
  fuzz::require(to_bytes(*again) == to_bytes(*learner), "both live on alike");
  return 0;
}
