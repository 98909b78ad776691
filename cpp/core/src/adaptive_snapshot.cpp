// How an adaptive learner stands in a snapshot, its own or a trial's.
#include <memory>

#include "adaptive_arrays.hpp"
#include "devlearn/snapshot.hpp"
#include "learner_snapshot.hpp"
#include "made_of.hpp"

namespace devlearn {
namespace {

constexpr const char* kFormat = "devlearn-adaptive";
constexpr std::uint64_t kFormatVersion = 1;

// Everything of a state but its arrays, for a writer or a reader.
template <typename State, typename Entries>
void each_entry_of(State& state, Entries& entries) {
  each_entry(state.config, "", entries);
  entries("seed", state.seed);
  entries("rounds", state.rounds);
  entries("optimism_now", state.optimism);
  each_entry(state.habit, "habit.", entries);
  each_entry(state.round, "round.", entries);
  each_entry(state.decision, "decision.", entries);
  each_entry(state.home, "home.", entries);
  each_entry(state.falling, "falling.", entries);
  each_entry(state.hope, "hope.", entries);
}

}  // namespace

void describe(const std::shared_ptr<const AdaptiveState>& shared, safetensors::Contents& contents) {
  const AdaptiveState& state = *shared;
  const AdaptiveSizes sizes = sizes_of(state);
  EntryWriter entries(contents);
  each_entry_of(state, entries);
  entries("situations", sizes.situations);
  entries("outcomes", sizes.outcomes);
  entries("habit_length", sizes.habit);
  entries("path_length", sizes.path);
  each_array(state.arrays, sizes, [&](const char* name, const auto& values, const Shape& shape) {
    contents.arrays[name] = array_over(values.data(), shape, shared);
  });
  contents.arrays["random"] = array_over(state.random.data(), {state.random.size()}, shared);
}

AdaptiveLearner adaptive_learner_of(const safetensors::Contents& contents,
                                    const std::string& source) {
  AdaptiveState state;
  const EntryReader entries(contents, source);
  each_entry_of(state, entries);
  made_of(source, [&] { state.config.validate(); });
  AdaptiveSizes sizes;
  sizes.motions = static_cast<std::uint64_t>(state.config.motion_count);
  sizes.curious = state.config.curious_every > 0;
  // They are checked against the arrays, which are bounded by the file.
  entries("situations", sizes.situations);
  entries("outcomes", sizes.outcomes);
  entries("habit_length", sizes.habit);
  entries("path_length", sizes.path);
  each_array(state.arrays, sizes, [&](const char* name, auto& values, const Shape& shape) {
    using T = typename std::decay_t<decltype(values)>::value_type;
    values = safetensors::values<T>(contents, name, shape, source);
  });
  state.random = random_of(contents, source);
  return made_of(source, [&] { return AdaptiveLearner(state); });
}

safetensors::Contents contents_of(const AdaptiveLearner& learner) {
  safetensors::Contents contents{preamble(kFormat, kFormatVersion), {}};
  describe(std::make_shared<const AdaptiveState>(learner.state()), contents);
  return contents;
}

void save(const AdaptiveLearner& learner, std::ostream& stream) {
  safetensors::write(contents_of(learner), stream);
}

std::vector<std::byte> to_bytes(const AdaptiveLearner& learner) {
  return safetensors::to_bytes(contents_of(learner));
}

AdaptiveLearner load_adaptive_learner(std::istream& stream) {
  const std::vector<std::byte> bytes = safetensors::read_stream(stream);
  return load_adaptive_learner(bytes.data(), bytes.size(), "stream");
}

AdaptiveLearner load_adaptive_learner(const std::byte* bytes, std::size_t size,
                                      const std::string& source) {
  const safetensors::Contents contents = safetensors::read(bytes, size, source);
  require_format(contents, kFormat, kFormatVersion, source);
  return adaptive_learner_of(contents, source);
}

}  // namespace devlearn
