#include "devlearn/snapshot.hpp"

#include <algorithm>
#include <charconv>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "devlearn/version.hpp"
#include "excerpt.hpp"
#include "learner_snapshot.hpp"
#include "made_of.hpp"

namespace devlearn {
namespace {

constexpr const char* kFormat = "devlearn-learner";
constexpr std::uint64_t kFormatVersion = 1;

}  // namespace

// --- entries -------------------------------------------------------------------------------------

safetensors::Metadata preamble(const std::string& format, std::uint64_t version) {
  return {{"format", format},
          {"format_version", std::to_string(version)},
          {"devlearn", devlearn::version()},
          {"commit", commit()}};
}

void require_format(const safetensors::Contents& contents, const std::string& format,
                    std::uint64_t version, const std::string& source) {
  const std::string& found = safetensors::entry(contents, "format", source);
  if (found != format) throw FileError(source, "format", excerpt(found), format);
  std::uint64_t number = 0;
  EntryReader(contents, source)("format_version", number);
  if (number < 1 || number > version) {
    throw FileError(source, "format_version", std::to_string(number),
                    "in [1, " + std::to_string(version) + "]; a newer devlearn wrote it");
  }
}

void EntryWriter::operator()(const std::string& name, double value) {
  contents_.metadata[name] = to_text(value);
}
void EntryWriter::operator()(const std::string& name, std::uint64_t value) {
  contents_.metadata[name] = std::to_string(value);
}
void EntryWriter::operator()(const std::string& name, std::int64_t value) {
  contents_.metadata[name] = std::to_string(value);
}
void EntryWriter::operator()(const std::string& name, int value) {
  contents_.metadata[name] = std::to_string(value);
}
void EntryWriter::operator()(const std::string& name, bool value) {
  contents_.metadata[name] = value ? "true" : "false";
}
void EntryWriter::operator()(const std::string& name, const std::optional<double>& value) {
  (*this)(name, value.value_or(0.0));
}
void EntryWriter::operator()(const std::string& name, const std::vector<double>& values) {
  contents_.arrays[name] = array_over(values.data(), {values.size()}, nullptr);
}

template <typename T>
void EntryReader::number(const std::string& name, T& value, const char* allowed) const {
  const std::string& text = safetensors::entry(contents_, name, source_);
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stopped != end) {
    throw FileError(source_, name, excerpt(text), allowed);
  }
}

void EntryReader::operator()(const std::string& name, double& value) const {
  number(name, value, "a number that a double can hold");
}
void EntryReader::operator()(const std::string& name, std::uint64_t& value) const {
  number(name, value, "a whole number in [0, 2^64 - 1]");
}
void EntryReader::operator()(const std::string& name, std::int64_t& value) const {
  number(name, value, "a whole number of 64 bits");
}
void EntryReader::operator()(const std::string& name, int& value) const {
  number(name, value, "a whole number of 32 bits");
}
void EntryReader::operator()(const std::string& name, bool& value) const {
  value = option(name, {"false", "true"}) == 1;
}
void EntryReader::operator()(const std::string& name, std::optional<double>& value) const {
  double number = 0.0;
  if (has(name)) (*this)(name, number);
  value = number == 0.0 ? std::nullopt : std::optional(number);
}
void EntryReader::operator()(const std::string& name, std::vector<double>& values) const {
  const auto found = contents_.arrays.find(name);
  const bool listed = found != contents_.arrays.end() && !found->second.shape.empty();
  const std::uint64_t count = listed ? found->second.shape[0] : 0;
  values = safetensors::values<double>(contents_, name, {count}, source_);
}

// The position of an entry's text among its options.
std::size_t EntryReader::option(const std::string& name,
                                const std::vector<std::string>& names) const {
  const std::string& text = safetensors::entry(contents_, name, source_);
  const auto found = std::find(names.begin(), names.end(), text);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  std::string allowed;
  for (const std::string& one : names) allowed += (allowed.empty() ? "" : " or ") + one;
  throw FileError(source_, name, excerpt(text), allowed);
}

// --- a learner's state ---------------------------------------------------------------------------

void describe(const std::shared_ptr<const LearnerState>& shared, safetensors::Contents& contents) {
  const LearnerState& state = *shared;
  const LearnerMemory& all = state.memory;
  const std::uint64_t situations = all.situation.size(), effective = all.orientation.size();
  EntryWriter entries(contents);
  each_entry(state.config, "", entries);
  entries("seed", state.seed);
  entries("situations", situations);
  entries("effective", effective);
  if (state.pending) {
    entries("pending_situation", static_cast<std::uint64_t>(state.pending->situation));
    entries("pending_motion", state.pending->choice.motion);
    entries("pending_kind", static_cast<int>(state.pending->choice.kind));
  }

  const auto motion_count = static_cast<std::uint64_t>(state.config.motion_count);
  const auto add = [&](const char* name, const auto* values, Shape shape) {
    contents.arrays[name] = array_over(values, std::move(shape), shared);
  };
  add("situation", all.situation.data(), {situations});
  add("effective_count", all.effective_count.data(), {situations});
  add("ineffective_count", all.ineffective_count.data(), {situations});
  add("motions", all.motions.data(), {situations, motion_count});
  add("orientation", all.orientation.data(), {effective});
  add("times_learned", all.times_learned.data(), {effective});
  add("random", state.random.data(), {state.random.size()});
}

Random::State random_of(const safetensors::Contents& contents, const std::string& source,
                        const char* name) {
  Random::State state{};
  const auto random = safetensors::values<std::uint64_t>(contents, name, {state.size()}, source);
  std::copy(random.begin(), random.end(), state.begin());
  if (state == Random::State{}) {
    throw FileError(source, name, "all zeros", "a state of the generator");
  }
  return state;
}

Learner learner_of(const safetensors::Contents& contents, const std::string& source) {
  LearnerState state;
  const EntryReader entries(contents, source);
  each_entry(state.config, "", entries);
  made_of(source, [&] { state.config.validate(); });
  entries("seed", state.seed);
  if (entries.has("pending_situation")) {
    state.pending.emplace();
    entries("pending_situation", state.pending->situation);
    entries("pending_motion", state.pending->choice.motion);
    int kind = 0;
    entries("pending_kind", kind);
    made_of(source, [&] { require_count("pending_kind", kind, 0, 2); });
    state.pending->choice.kind = static_cast<Kind>(kind);
  }

  // The sizes are checked against the arrays, which are bounded by the file.
  std::uint64_t situations = 0, effective = 0;
  entries("situations", situations);
  entries("effective", effective);
  const auto motion_count = static_cast<std::uint64_t>(state.config.motion_count);
  const auto take = [&](const char* name, auto& values, const Shape& shape) {
    using T = typename std::decay_t<decltype(values)>::value_type;
    values = safetensors::values<T>(contents, name, shape, source);
  };
  LearnerMemory& all = state.memory;
  take("situation", all.situation, {situations});
  take("effective_count", all.effective_count, {situations});
  take("ineffective_count", all.ineffective_count, {situations});
  take("motions", all.motions, {situations, motion_count});
  take("orientation", all.orientation, {effective});
  take("times_learned", all.times_learned, {effective});
  state.random = random_of(contents, source);
  return made_of(source, [&] { return Learner(state); });
}

// --- learners ------------------------------------------------------------------------------------

safetensors::Contents contents_of(const Learner& learner) {
  safetensors::Contents contents{preamble(kFormat, kFormatVersion), {}};
  describe(std::make_shared<const LearnerState>(learner.state()), contents);
  return contents;
}

void save(const Learner& learner, std::ostream& stream) {
  safetensors::write(contents_of(learner), stream);
}

std::vector<std::byte> to_bytes(const Learner& learner) {
  return safetensors::to_bytes(contents_of(learner));
}

Learner load_learner(std::istream& stream) {
  const std::vector<std::byte> bytes = safetensors::read_stream(stream);
  return load_learner(bytes.data(), bytes.size(), "stream");
}

Learner load_learner(const std::byte* bytes, std::size_t size, const std::string& source) {
  const safetensors::Contents contents = safetensors::read(bytes, size, source);
  require_format(contents, kFormat, kFormatVersion, source);
  return learner_of(contents, source);
}

}  // namespace devlearn
