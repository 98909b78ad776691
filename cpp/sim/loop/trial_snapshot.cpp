#include "devlearn/trial_snapshot.hpp"

#include <box2d/b2_common.h>

#include <typeinfo>
#include <utility>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "devlearn/learner_agent.hpp"
#include "devlearn/random_agent.hpp"
#include "excerpt.hpp"
#include "json.hpp"
#include "learner_snapshot.hpp"
#include "made_of.hpp"

namespace devlearn {
namespace {

using safetensors::Contents;

constexpr const char* kFormat = "devlearn-trial";
// Of trials with noise, or with parts of one's own, which an older reader must not take for exact
// ones, or for Eq. 6 and the grid's.
constexpr std::uint64_t kFormatVersion = 3;
constexpr std::uint64_t kFormatVersionOfOwnParts = 2;
constexpr std::uint64_t kFormatVersionOfPlain = 1;

// Stands for an agent where there is none.
constexpr const char* kNone = "none";

constexpr const char* kConfig = "config.";

// Steps that the trial has made, and the worlds that it was in before.
constexpr const char* kSteps = "trial_steps";
constexpr std::int64_t kMostSteps = std::int64_t{1} << 62;
std::string earlier_world(std::size_t i) { return "earlier_world." + std::to_string(i); }

// Where there is noise: the estimated pose, and the state of its stream.
constexpr const char* kEstimate = "estimate";
constexpr const char* kNoise = "noise";

// Parts of one's own: names of functions, and the table.
constexpr const char* kEvaluation = "own.evaluation";
constexpr const char* kSituations = "own.situations";
constexpr const char* kSefTable = "own.sef_table";

std::uint64_t version_for(const Trial& trial) {
  if (!detail::known_to_earlier_builds(trial.config().noise) ||
      !detail::known_to_earlier_builds(trial.config().robot)) {
    return kFormatVersion;
  }
  const TrialParts& parts = trial.parts();
  const bool own = parts.evaluation.function || parts.situations.function;
  return own || !parts.sef_table.empty() ? kFormatVersionOfOwnParts : kFormatVersionOfPlain;
}

// What stands before the names of an agent's texts and arrays. devlearn's first two agents stand as
// in a snapshot of their own.
std::string prefix_of(const std::string& kind) {
  return kind == LearnerAgent::kKind || kind == RandomAgent::kKind ? "" : "agent.";
}

std::string box2d_version() {
  return std::to_string(b2_version.major) + "." + std::to_string(b2_version.minor) + "." +
         std::to_string(b2_version.revision);
}

// --- writing -------------------------------------------------------------------------------------

// A trial's contents and what they point into.
class Description {
 public:
  Description(const Trial& trial, const SaveOptions& options)
      : contents_{preamble(kFormat, version_for(trial)), {}} {
    if (trial.under_way()) {
      throw InvalidValue("Trial", "a snapshot while a call is under way", "one call at a time");
    }
    describe_trial(trial);
    describe_parts(trial.parts());
    if (options.agent) {
      describe_agent(*trial.agent());
    } else {
      contents_.metadata["agent"] = kNone;
    }
    if (options.record != nullptr) describe_record(*options.record);
    if (!options.note.empty()) contents_.metadata["note"] = utf8("note", options.note);
    safetensors::require_readable(contents_);
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
    entries("round_open", trial.round_open());
    entries(kSteps, trial.environment().state().place.steps);
    for (std::size_t i = 0; i < trial.earlier_worlds().size(); ++i) {
      const auto& [world, steps] = trial.earlier_worlds()[i];
      contents_.metadata[earlier_world(i)] = world.to_json();
      entries(earlier_world(i) + ".steps", steps);
    }
    each_entry(trial.config(), kConfig, entries);
    const auto& [pose, estimate, noise, steps] = trial.environment().state().place;
    pose_ = {pose.x, pose.y, pose.heading};
    add("pose", pose_, "F64");
    if (trial.config().noise == NoiseDef{}) return;
    estimate_ = {estimate.x, estimate.y, estimate.heading};
    add(kEstimate, estimate_, "F64");
    noise_.assign(noise.state().begin(), noise.state().end());
    add(kNoise, noise_, "U64");
  }

  void describe_parts(const TrialParts& parts) {
    const auto add_name = [&](const char* entry, const std::string& name) {
      if (!name.empty()) contents_.metadata[entry] = utf8(entry, name);
    };
    add_name(kEvaluation, parts.evaluation.name);
    add_name(kSituations, parts.situations.name);
    if (!parts.sef_table.empty()) add(kSefTable, parts.sef_table, "F64");
  }

  void describe_agent(const Agent& agent) {
    const std::optional<AgentState> state = agent.state();
    if (!state) {
      throw InvalidValue("Trial.agent", typeid(agent).name(),
                         "an agent with a state; save this one yourself, the trial without its "
                         "agent, and give the agent when loading");
    }
    if (state->kind == kNone) throw InvalidValue("Trial.agent.kind", kNone, "another name");
    contents_.metadata["agent"] = utf8("Trial.agent.kind", state->kind);
    const std::string prefix = prefix_of(state->kind);
    for (const auto& [name, text] : state->texts) {
      contents_.metadata[prefix + utf8("Trial.agent.texts", name)] = utf8(name, text);
    }
    for (const auto& [name, array] : state->arrays) {
      contents_.arrays[prefix + utf8("Trial.agent.arrays", name)] = array;
    }
  }

  static const std::string& utf8(const std::string& quantity, const std::string& text) {
    if (!json::is_utf8(text)) throw InvalidValue(excerpt(quantity), excerpt(text), "UTF-8");
    return text;
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
      began_.push_back(round.began);
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
    add_column("rounds.began", began_, "I64");
    if (record.sonar_count > 0) {
      add_column("echoes", record.echoes, "F64");
      contents_.arrays["record.echoes"].shape = {record.steps(),
                                                 static_cast<std::uint64_t>(record.sonar_count)};
    }
  }

  // The values are the trial's, the record's or this description's.
  template <typename T>
  void add(const std::string& name, const std::vector<T>& values, const char* dtype) {
    contents_.arrays[name] = array_over(values.data(), {values.size()}, nullptr);
    contents_.arrays[name].dtype = dtype;
  }

  Contents contents_;
  std::vector<double> pose_, estimate_;
  std::vector<std::uint64_t> noise_;
  std::vector<std::int32_t> numbers_;
  std::vector<std::int64_t> steps_, began_;
  std::vector<std::uint8_t> arrived_;
};

// --- reading -------------------------------------------------------------------------------------

World world_of(const Contents& contents, const std::string& source,
               const std::string& entry = "world") {
  const std::string& text = safetensors::entry(contents, entry, source);
  try {
    return World::parse(text, source);
  } catch (const FileError& error) {
    const std::string field = error.field().empty() ? entry : entry + "." + error.field();
    throw FileError(source, field, error.value(), error.allowed());
  }
}

void take_count(const EntryReader& entries, const std::string& entry, std::int64_t& count,
                const std::string& source) {
  entries(entry, count);
  made_of(source, [&] { require_count(entry, count, 0, kMostSteps); });
}

std::vector<Trial::EarlierWorld> earlier_worlds_of(const Contents& contents,
                                                   const std::string& source) {
  std::vector<Trial::EarlierWorld> worlds;
  const EntryReader entries(contents, source);
  while (entries.has(earlier_world(worlds.size()))) {
    const std::string entry = earlier_world(worlds.size());
    worlds.push_back({world_of(contents, source, entry), 0});
    take_count(entries, entry + ".steps", worlds.back().steps, source);
  }
  return worlds;
}

// What is in the file of the agent. The arrays stay where they are.
AgentState agent_state_of(const Contents& contents, const std::string& source) {
  AgentState state;
  state.kind = safetensors::entry(contents, "agent", source);
  const std::string prefix = prefix_of(state.kind);
  const auto take = [&](const auto& all, auto& taken) {
    for (auto entry = all.lower_bound(prefix); entry != all.end(); ++entry) {
      if (entry->first.compare(0, prefix.size(), prefix) != 0) break;
      taken[entry->first.substr(prefix.size())] = entry->second;
    }
  };
  take(contents.metadata, state.texts);
  take(contents.arrays, state.arrays);
  return state;
}

std::shared_ptr<Agent> agent_of(const Contents& contents, const LoadOptions& options,
                                const std::string& source) {
  if (options.agent) return options.agent;
  const AgentState state = agent_state_of(contents, source);
  std::shared_ptr<Agent> agent;
  if (options.maker) agent = made_of(source, [&] { return options.maker(state); });
  if (!agent) agent = make_agent(state, source);
  if (agent) return agent;
  throw FileError(source, "agent", excerpt(state.kind),
                  "learner, adaptive or random; or give the agent that goes on, or its maker");
}

// Where a function lives, such as a module, is no part of its name.
std::string name_alone(const std::string& name) { return name.substr(name.find(':') + 1); }

// The function that the file names, and none where it names none.
void require_named(const Contents& contents, const char* entry, const std::string& given,
                   const std::string& source) {
  const auto found = contents.metadata.find(entry);
  const std::string saved = found == contents.metadata.end() ? "" : found->second;
  if (saved.empty() == given.empty() && name_alone(saved) == name_alone(given)) return;
  throw FileError(source, entry, saved.empty() ? "none" : excerpt(saved),
                  given.empty() ? "none, where no function is given; give the one of this name"
                                : excerpt(given) + ", the name of the function given");
}

TrialParts parts_of(const Contents& contents, const TrialParts& given, const std::string& source) {
  require_named(contents, kEvaluation, given.evaluation.name, source);
  require_named(contents, kSituations, given.situations.name, source);
  if (!given.sef_table.empty()) {
    throw FileError(source, kSefTable, "given again", "nothing: the file has its table");
  }
  TrialParts parts = given;
  const auto table = contents.arrays.find(kSefTable);
  if (table != contents.arrays.end()) {
    const std::uint64_t length = table->second.shape.size() == 1 ? table->second.shape[0] : 1;
    parts.sef_table = safetensors::values<double>(contents, kSefTable, {length}, source);
  }
  return parts;
}

TrialConfig config_of(const Contents& contents, const std::string& source) {
  TrialConfig config;
  const EntryReader entries(contents, source);
  each_entry(config, kConfig, entries);
  made_of(source, [&] { config.validate(); });
  return config;
}

std::uint64_t seed_of(const Contents& contents, const std::string& source) {
  std::uint64_t seed = 0;
  EntryReader(contents, source)("trial_seed", seed);
  return seed;
}

Pose pose_of(const Contents& contents, const char* name, const std::string& source) {
  const std::vector<double> pose = safetensors::values<double>(contents, name, {3}, source);
  return {pose[0], pose[1], pose[2]};
}

Environment::Place place_of(const Contents& contents, const TrialConfig& config, std::uint64_t seed,
                            const std::string& source) {
  const Pose pose = pose_of(contents, "pose", source);
  std::int64_t steps = 0;
  const EntryReader entries(contents, source);
  // Earlier files do not say; nothing moves in their worlds.
  if (entries.has(kSteps)) take_count(entries, kSteps, steps, source);
  if (config.noise == NoiseDef{}) return {pose, pose, Random(seed, "noise"), steps};
  const Random::State noise = random_of(contents, source, kNoise);
  return {pose, pose_of(contents, kEstimate, source), Random(noise), steps};
}

std::string note_of(const Contents& contents) {
  const auto entry = contents.metadata.find("note");
  return entry == contents.metadata.end() ? "" : entry->second;
}

Trial trial_of(const Contents& contents, const LoadOptions& options, const std::string& source) {
  const std::uint64_t seed = seed_of(contents, source);
  int round = 0;
  const EntryReader entries(contents, source);
  entries("round", round);
  // Earlier files do not say.
  bool round_open = round > 0;
  if (entries.has("round_open")) entries("round_open", round_open);
  const TrialConfig config = config_of(contents, source);
  const Environment::Place place = place_of(contents, config, seed, source);
  const World world = world_of(contents, source);
  const std::vector<Trial::EarlierWorld> earlier = earlier_worlds_of(contents, source);
  TrialParts parts = parts_of(contents, options.parts, source);
  const std::shared_ptr<Agent> agent = agent_of(contents, options, source);
  return made_of(source, [&] {
    Trial trial(world, config, seed, agent, std::move(parts));
    trial.resume(place, round, round_open, earlier);
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
    if constexpr (std::decay_t<decltype(column)>::may_lack()) {
      if (contents.arrays.count(std::string("record.") + column.name) == 0) {
        (record.*column.values).assign(steps, column.missing());
        return;
      }
    }
    take(column.name, record.*column.values, {steps}, column.dtype());
  });
  // Of rounds only there are none.
  const auto x = contents.arrays.find("record.x");
  const bool none = x != contents.arrays.end() && x->second.shape == Shape{0};
  detail::each_column(Record::pose_columns(), [&](auto& column) {
    take(column.name, record.*column.values, {none ? 0 : steps + rounds}, column.dtype());
  });
  if (record.sonar_count != 0) {
    take("echoes", record.echoes, {steps, static_cast<std::uint64_t>(record.sonar_count)}, "F64");
  }
  std::vector<std::int32_t> numbers;
  std::vector<std::int64_t> counts, began;
  std::vector<std::uint8_t> arrived;
  take("rounds.round", numbers, {rounds}, "I32");
  take("rounds.steps", counts, {rounds}, "I64");
  take("rounds.arrived", arrived, {rounds}, "BOOL");
  if (contents.arrays.count("record.rounds.began") > 0) {
    take("rounds.began", began, {rounds}, "I64");
  } else {
    began.assign(rounds, Round{}.began);
  }
  for (std::size_t i = 0; i < rounds; ++i) {
    made_of(source, [&] { require_count("record.rounds.arrived", arrived[i], 0, 1); });
    record.rounds.push_back({numbers[i], counts[i], arrived[i] == 1, began[i]});
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

TrialSnapshot load_trial(const std::string& path, const LoadOptions& options) {
  const std::vector<std::byte> bytes = safetensors::read_file(path);
  return load_trial(bytes.data(), bytes.size(), options, path);
}

TrialSnapshot load_trial(std::istream& stream, const LoadOptions& options) {
  const std::vector<std::byte> bytes = safetensors::read_stream(stream);
  return load_trial(bytes.data(), bytes.size(), options, "stream");
}

TrialSnapshot load_trial(const std::byte* bytes, std::size_t size, const LoadOptions& options,
                         const std::string& source) {
  const Contents contents = safetensors::read(bytes, size, source);
  require_format(contents, kFormat, kFormatVersion, source);
  return {trial_of(contents, options, source), record_of(contents, source), note_of(contents)};
}

RecordSnapshot load_record(const std::string& path) {
  const std::vector<std::byte> bytes = safetensors::read_file(path);
  const Contents contents = safetensors::read(bytes.data(), bytes.size(), path);
  require_format(contents, kFormat, kFormatVersion, path);
  return {record_of(contents, path), world_of(contents, path), config_of(contents, path),
          seed_of(contents, path), note_of(contents)};
}

}  // namespace devlearn
