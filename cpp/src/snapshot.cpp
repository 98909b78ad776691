#include "devlearn/snapshot.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <istream>
#include <iterator>
#include <limits>
#include <ostream>

#include "devlearn/error.hpp"
#include "devlearn/version.hpp"
#include "file.hpp"
#include "learner_snapshot.hpp"

namespace devlearn {
namespace {

constexpr const char* kFormat = "devlearn-learner";
constexpr std::uint64_t kFormatVersion = 1;

constexpr std::array<const char*, 2> kOnNegative{"abandon", "weaken"};
constexpr std::array<const char*, 2> kWhenExhausted{"retry", "wander"};

std::vector<std::uint64_t> random_of(const LearnerState& state) {
  return {state.random.begin(), state.random.end()};
}

// The position of an entry's text among its options.
std::size_t option_entry(const safetensors::Contents& contents, const std::string& name,
                         const std::array<const char*, 2>& options, const std::string& source) {
  const std::string& text = safetensors::entry(contents, name, source);
  for (std::size_t i = 0; i < options.size(); ++i) {
    if (text == options[i]) return i;
  }
  throw FileError(source, name, text, std::string(options[0]) + " or " + options[1]);
}

template <typename T>
T parsed_entry(const safetensors::Contents& contents, const std::string& name,
               const std::string& source, const char* allowed) {
  const std::string& text = safetensors::entry(contents, name, source);
  T value{};
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stopped != end) throw FileError(source, name, text, allowed);
  return value;
}

// A whole number that fits T.
template <typename T>
T small_entry(const safetensors::Contents& contents, const std::string& name,
              const std::string& source) {
  const std::uint64_t value = whole_entry(contents, name, source);
  if (value > static_cast<std::uint64_t>(std::numeric_limits<T>::max())) {
    throw FileError(source, name, std::to_string(value),
                    "at most " + std::to_string(std::numeric_limits<T>::max()));
  }
  return static_cast<T>(value);
}

}  // namespace

// --- what stands in a snapshot -------------------------------------------------------------------

safetensors::Metadata preamble(const std::string& format) {
  return {{"format", format},
          {"format_version", std::to_string(kFormatVersion)},
          {"devlearn", version()},
          {"commit", commit()}};
}

void require_format(const safetensors::Contents& contents, const std::string& format,
                    const std::string& source) {
  const std::string& found = safetensors::entry(contents, "format", source);
  if (found != format) throw FileError(source, "format", found, format);
  const std::uint64_t number = whole_entry(contents, "format_version", source);
  if (number < 1 || number > kFormatVersion) {
    throw FileError(source, "format_version", std::to_string(number),
                    "at most " + std::to_string(kFormatVersion) + "; a newer devlearn wrote it");
  }
}

double number_entry(const safetensors::Contents& contents, const std::string& name,
                    const std::string& source) {
  return parsed_entry<double>(contents, name, source, "a number");
}

std::uint64_t whole_entry(const safetensors::Contents& contents, const std::string& name,
                          const std::string& source) {
  return parsed_entry<std::uint64_t>(contents, name, source, "a whole number, at least 0");
}

void describe(const LearnerState& state, const std::vector<std::uint64_t>& random,
              safetensors::Metadata& metadata, safetensors::Arrays& arrays) {
  const LearnerConfig& config = state.config;
  metadata["motion_count"] = std::to_string(config.motion_count);
  metadata["eta"] = to_text(config.eta);
  metadata["sigma"] = to_text(config.sigma);
  metadata["c1"] = to_text(config.c1);
  metadata["c2"] = to_text(config.c2);
  metadata["on_negative"] = kOnNegative[static_cast<std::size_t>(config.on_negative)];
  metadata["when_exhausted"] = kWhenExhausted[static_cast<std::size_t>(config.when_exhausted)];
  metadata["seed"] = std::to_string(state.seed);
  metadata["situations"] = std::to_string(state.memory.situation.size());
  metadata["effective"] = std::to_string(state.memory.orientation.size());
  if (state.pending) {
    metadata["pending_situation"] = std::to_string(state.pending->situation);
    metadata["pending_motion"] = std::to_string(state.pending->choice.motion);
    metadata["pending_kind"] = std::to_string(static_cast<int>(state.pending->choice.kind));
  }

  const LearnerMemory& all = state.memory;
  const std::uint64_t situations = all.situation.size(), effective = all.orientation.size();
  const auto motion_count = static_cast<std::uint64_t>(config.motion_count);
  arrays["situation"] = safetensors::array_of(all.situation, {situations});
  arrays["effective_count"] = safetensors::array_of(all.effective_count, {situations});
  arrays["ineffective_count"] = safetensors::array_of(all.ineffective_count, {situations});
  arrays["motions"] = safetensors::array_of(all.motions, {situations, motion_count});
  arrays["orientation"] = safetensors::array_of(all.orientation, {effective});
  arrays["times_learned"] = safetensors::array_of(all.times_learned, {effective});
  arrays["random"] = safetensors::array_of(random, {random.size()});
}

Learner learner_of(const safetensors::Contents& contents, const std::string& source) {
  LearnerState state;
  LearnerConfig& config = state.config;
  config.motion_count = small_entry<int>(contents, "motion_count", source);
  config.eta = number_entry(contents, "eta", source);
  config.sigma = number_entry(contents, "sigma", source);
  config.c1 = number_entry(contents, "c1", source);
  config.c2 = number_entry(contents, "c2", source);
  config.on_negative =
      static_cast<OnNegative>(option_entry(contents, "on_negative", kOnNegative, source));
  config.when_exhausted =
      static_cast<WhenExhausted>(option_entry(contents, "when_exhausted", kWhenExhausted, source));
  state.seed = whole_entry(contents, "seed", source);
  if (contents.metadata.count("pending_situation") > 0) {
    state.pending = {
        small_entry<SituationId>(contents, "pending_situation", source),
        {small_entry<int>(contents, "pending_motion", source),
         static_cast<Kind>(small_entry<std::uint8_t>(contents, "pending_kind", source))}};
  }

  // The sizes are checked against the arrays, which are bounded by the file.
  const std::uint64_t situations = whole_entry(contents, "situations", source);
  const std::uint64_t effective = whole_entry(contents, "effective", source);
  const auto motion_count = static_cast<std::uint64_t>(config.motion_count);
  LearnerMemory& all = state.memory;
  using safetensors::values;
  all.situation = values<SituationId>(contents, "situation", {situations}, source);
  all.effective_count = values<std::uint16_t>(contents, "effective_count", {situations}, source);
  all.ineffective_count =
      values<std::uint16_t>(contents, "ineffective_count", {situations}, source);
  all.motions = values<std::uint16_t>(contents, "motions", {situations, motion_count}, source);
  all.orientation = values<double>(contents, "orientation", {effective}, source);
  all.times_learned = values<std::uint32_t>(contents, "times_learned", {effective}, source);
  const auto random =
      values<std::uint64_t>(contents, "random", {std::tuple_size_v<Random::State>}, source);
  std::copy(random.begin(), random.end(), state.random.begin());
  try {
    return Learner(state);
  } catch (const FileError&) {
    throw;
  } catch (const InvalidValue& error) {
    throw FileError(source, error.quantity(), error.value(), error.allowed());
  }
}

std::vector<std::byte> read_file(const std::string& path) {
  const auto refuse = [&] {
    throw FileError(path, "", std::strerror(errno), "a file that can be read");
  };
  errno = 0;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) refuse();
  const std::streamoff size = file.tellg();
  if (size < 0) refuse();
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(bytes.data()), size);
  if (!file) refuse();
  return bytes;
}

// --- learners ------------------------------------------------------------------------------------

namespace {

// Hands a snapshot's pieces, one after the other, to write(data, size).
template <typename Write>
void write_pieces(const Learner& learner, const Write& write) {
  const LearnerState state = learner.state();
  const std::vector<std::uint64_t> random = random_of(state);
  safetensors::Metadata metadata = preamble(kFormat);
  safetensors::Arrays arrays;
  describe(state, random, metadata, arrays);
  const std::vector<std::byte> head = safetensors::header(metadata, arrays);
  write(head.data(), head.size());
  for (const safetensors::Array* array : safetensors::in_order(arrays)) {
    write(array->data, array->bytes);
  }
}

}  // namespace

void save(const Learner& learner, const std::string& path) {
  SideFile file(path);
  write_pieces(learner, [&](const std::byte* data, std::size_t size) { file.write(data, size); });
  file.commit();
}

void save(const Learner& learner, std::ostream& stream) {
  write_pieces(learner, [&](const std::byte* data, std::size_t size) {
    stream.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  });
}

std::vector<std::byte> to_bytes(const Learner& learner) {
  std::vector<std::byte> bytes;
  write_pieces(learner, [&](const std::byte* data, std::size_t size) {
    bytes.insert(bytes.end(), data, data + size);
  });
  return bytes;
}

Learner load_learner(const std::string& path) {
  const std::vector<std::byte> bytes = read_file(path);
  return load_learner(bytes.data(), bytes.size(), path);
}

Learner load_learner(std::istream& stream) {
  std::vector<std::byte> bytes;
  char part[1 << 16];
  while (stream.read(part, sizeof part), stream.gcount() > 0) {
    const auto* const data = reinterpret_cast<const std::byte*>(part);
    bytes.insert(bytes.end(), data, data + stream.gcount());
  }
  return load_learner(bytes.data(), bytes.size(), "stream");
}

Learner load_learner(const std::byte* bytes, std::size_t size, const std::string& source) {
  const safetensors::Contents contents = safetensors::read(bytes, size, source);
  require_format(contents, kFormat, source);
  return learner_of(contents, source);
}

}  // namespace devlearn
