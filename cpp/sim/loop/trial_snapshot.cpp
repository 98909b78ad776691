#include "devlearn/trial_snapshot.hpp"

#include <box2d/b2_common.h>

#include <typeinfo>
#include <utility>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "excerpt.hpp"
#include "file.hpp"
#include "json.hpp"
#include "learner_snapshot.hpp"

namespace devlearn {
namespace {

using safetensors::Contents;

constexpr const char* kFormat = "devlearn-trial";
constexpr std::uint64_t kFormatVersion = 1;

constexpr const char* kLearner = "learner";
constexpr const char* kRandom = "random";
constexpr const char* kNone = "none";

constexpr const char* kConfig = "config.";

std::string box2d_version() {
  return std::to_string(b2_version.major) + "." + std::to_string(b2_version.minor) + "." +
         std::to_string(b2_version.revision);
}

// --- writing -------------------------------------------------------------------------------------

// A trial's contents and what they point into.
class Description {
 public:
  Description(const Trial& trial, const SaveOptions& options)
      : contents_{preamble(kFormat, kFormatVersion), {}} {
    if (trial.under_way()) {
      throw InvalidValue("Trial", "a snapshot while a call is under way", "one call at a time");
    }
    describe_trial(trial);
    if (options.agent) {
      describe_agent(*trial.agent());
    } else {
      contents_.metadata["agent"] = kNone;
    }
    if (options.record != nullptr) describe_record(*options.record);
    if (!json::is_utf8(options.note)) throw InvalidValue("note", excerpt(options.note), "UTF-8");
    if (!options.note.empty()) contents_.metadata["note"] = options.note;
  }
  Description(const Description&) = delete;
  Description& operator=(const Description&) = delete;

  const Contents& contents() const noexcept { return contents_; }

 private:
  void describe_trial(const Trial& trial) {
    contents_.metadata["box2d"] = box2d_version();
    contents_.metadata["world"] = trial.world().to_json();
    EntryWriter entries(contents_);
    entries("trial_seed", trial.seed());
    entries("round", trial.round());
    each_entry(trial.config(), kConfig, entries);
    pose_ = {trial.pose().x, trial.pose().y, trial.pose().heading};
    add("pose", pose_, "F64");
  }

  void describe_agent(const Agent& agent) {
    if (const auto* paper = dynamic_cast<const LearnerAgent*>(&agent)) {
      contents_.metadata["agent"] = kLearner;
      learner_ = paper->learner()->state();
      describe(learner_, contents_);
    } else if (const auto* random = dynamic_cast<const RandomAgent*>(&agent)) {
      contents_.metadata["agent"] = kRandom;
      random_.assign(random->random().state().begin(), random->random().state().end());
      add("random", random_, "U64");
    } else {
      throw InvalidValue("Trial.agent", typeid(agent).name(),
                         "a learner or a RandomAgent; save an agent of your own yourself, the "
                         "trial without its agent, and give the agent when loading");
    }
  }

  void describe_record(const Record& record) {
    record.validate();
    EntryWriter entries(contents_);
    entries("record_steps", std::uint64_t{record.steps()});
    entries("record_rounds", std::uint64_t{record.rounds.size()});
    entries("record_sonars", record.sonar_count);
    for (const Round& round : record.rounds) {
      numbers_.push_back(round.round);
      steps_.push_back(round.steps);
      arrived_.push_back(round.arrived);
    }
    const auto add_column = [&](const char* name, const auto& column, const char* dtype) {
      add(std::string("record.") + name, column, dtype);
    };
    const auto add_values = [&](auto& column) {
      add_column(column.name, record.*column.values, column.dtype());
    };
    detail::each_column(Record::step_columns(), add_values);
    detail::each_column(Record::pose_columns(), add_values);
    add_column("rounds.round", numbers_, "I32");
    add_column("rounds.steps", steps_, "I64");
    add_column("rounds.arrived", arrived_, "BOOL");
    if (record.sonar_count > 0) {
      add_column("echoes", record.echoes, "F64");
      contents_.arrays["record.echoes"].shape = {record.steps(),
                                                 static_cast<std::uint64_t>(record.sonar_count)};
    }
  }

  template <typename T>
  void add(const std::string& name, const std::vector<T>& values, const char* dtype) {
    contents_.arrays[name] = safetensors::array_of(values.data(), {values.size()});
    contents_.arrays[name].dtype = dtype;
  }

  Contents contents_;
  LearnerState learner_;
  std::vector<double> pose_;
  std::vector<std::uint64_t> random_;
  std::vector<std::int32_t> numbers_;
  std::vector<std::int64_t> steps_;
  std::vector<std::uint8_t> arrived_;
};

// --- reading -------------------------------------------------------------------------------------

World world_of(const Contents& contents, const std::string& source) {
  const std::string& text = safetensors::entry(contents, "world", source);
  try {
    return World::parse(text, source);
  } catch (const FileError& error) {
    const std::string field = error.field().empty() ? "world" : "world." + error.field();
    throw FileError(source, field, error.value(), error.allowed());
  }
}

std::shared_ptr<Agent> agent_of(const Contents& contents, const std::string& source) {
  const std::string& kind = safetensors::entry(contents, "agent", source);
  if (kind == kLearner) {
    return std::make_shared<LearnerAgent>(std::make_shared<Learner>(learner_of(contents, source)));
  }
  if (kind == kRandom) return std::make_shared<RandomAgent>(Random(random_of(contents, source)));
  throw FileError(source, "agent", excerpt(kind),
                  "learner or random; or give the agent that goes on");
}

Trial trial_of(const Contents& contents, std::shared_ptr<Agent> agent, const std::string& source) {
  TrialConfig config;
  std::uint64_t seed = 0;
  int round = 0;
  const EntryReader entries(contents, source);
  entries("trial_seed", seed);
  entries("round", round);
  each_entry(config, kConfig, entries);
  const std::vector<double> pose = safetensors::values<double>(contents, "pose", {3}, source);
  const World world = world_of(contents, source);
  if (agent == nullptr) agent = agent_of(contents, source);
  return made_of(source, [&] {
    Trial trial(world, config, seed, std::move(agent));
    trial.resume({pose[0], pose[1], pose[2]}, round);
    return trial;
  });
}

std::optional<Record> record_of(const Contents& contents, const std::string& source) {
  const EntryReader entries(contents, source);
  if (!entries.has("record_steps")) return std::nullopt;
  Record record;
  std::uint64_t steps = 0, rounds = 0;
  entries("record_steps", steps);
  entries("record_rounds", rounds);
  entries("record_sonars", record.sonar_count);
  // The sizes are checked against the arrays, which are bounded by the file.
  const auto take = [&](const char* name, auto& column, std::vector<std::uint64_t> shape,
                        const char* dtype) {
    using T = typename std::decay_t<decltype(column)>::value_type;
    column = safetensors::values<T>(contents, std::string("record.") + name, shape, source, dtype);
  };
  detail::each_column(Record::step_columns(), [&](auto& column) {
    take(column.name, record.*column.values, {steps}, column.dtype());
  });
  detail::each_column(Record::pose_columns(), [&](auto& column) {
    take(column.name, record.*column.values, {steps + rounds}, column.dtype());
  });
  if (record.sonar_count != 0) {
    take("echoes", record.echoes, {steps, static_cast<std::uint64_t>(record.sonar_count)}, "F64");
  }
  std::vector<std::int32_t> numbers;
  std::vector<std::int64_t> counts;
  std::vector<std::uint8_t> arrived;
  take("rounds.round", numbers, {rounds}, "I32");
  take("rounds.steps", counts, {rounds}, "I64");
  take("rounds.arrived", arrived, {rounds}, "BOOL");
  for (std::size_t i = 0; i < rounds; ++i) {
    made_of(source, [&] { require_count("record.rounds.arrived", arrived[i], 0, 1); });
    record.rounds.push_back({numbers[i], counts[i], arrived[i] == 1});
  }
  made_of(source, [&] { record.validate(); });
  return record;
}

}  // namespace

// --- trials --------------------------------------------------------------------------------------

void save(const Trial& trial, const std::string& path, const SaveOptions& options) {
  safetensors::write(Description(trial, options).contents(), path);
}

void save(const Trial& trial, std::ostream& stream, const SaveOptions& options) {
  safetensors::write(Description(trial, options).contents(), stream);
}

std::vector<std::byte> to_bytes(const Trial& trial, const SaveOptions& options) {
  return safetensors::to_bytes(Description(trial, options).contents());
}

TrialSnapshot load_trial(const std::string& path, std::shared_ptr<Agent> agent) {
  const std::vector<std::byte> bytes = bytes_of_file(path);
  return load_trial(bytes.data(), bytes.size(), std::move(agent), path);
}

TrialSnapshot load_trial(std::istream& stream, std::shared_ptr<Agent> agent) {
  const std::vector<std::byte> bytes = safetensors::read_stream(stream);
  return load_trial(bytes.data(), bytes.size(), std::move(agent), "stream");
}

TrialSnapshot load_trial(const std::byte* bytes, std::size_t size, std::shared_ptr<Agent> agent,
                         const std::string& source) {
  const Contents contents = safetensors::read(bytes, size, source);
  require_format(contents, kFormat, kFormatVersion, source);
  const auto entry = contents.metadata.find("note");
  const std::string note = entry == contents.metadata.end() ? "" : entry->second;
  return {trial_of(contents, std::move(agent), source), record_of(contents, source), note};
}

}  // namespace devlearn
