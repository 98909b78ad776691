#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include "core/kept_snapshots.hpp"
#include "core/refusal.hpp"
#include "core/snapshot_bytes.hpp"
#include "devlearn/learner_agent.hpp"
#include "devlearn/random_agent.hpp"
#include "devlearn/snapshot.hpp"
#include "devlearn/trial_snapshot.hpp"
#include "sim/open_world.hpp"

using namespace devlearn;

namespace {

using Bytes = std::vector<std::byte>;

World shipped(const std::string& name) {
  return World::load(std::string(DEVLEARN_SOURCE_DIR) + "/python/devlearn/worlds/" + name +
                     ".json");
}

TrialConfig sonar_config() {
  TrialConfig config = TrialConfig::step5();
  config.clearance_source = ClearanceSource::kSonar;
  config.walls_count = true;
  std::get<LearnerConfig>(config.learner).sigma = 0.123456789012345678;
  return config;
}

TrialSnapshot loaded(const Bytes& bytes, std::shared_ptr<Agent> agent = nullptr) {
  return load_trial(bytes.data(), bytes.size(), {std::move(agent)}, "it");
}

// Equal in all that is in a snapshot, to the bit.
bool same(const Trial& a, const Record& record_a, const Trial& b, const Record& record_b) {
  return to_bytes(a, {&record_a, true, ""}) == to_bytes(b, {&record_b, true, ""});
}

void require_equal_futures(Trial a, Trial b) {
  Record record_a, record_b;
  for (auto [trial, record] : {std::pair(&a, &record_a), std::pair(&b, &record_b)}) {
    trial->run(*record, 300);
    trial->free_learning(*record, 500);
    trial->path_learning(*record, 3, 400);
  }
  REQUIRE(same(a, record_a, b, record_b));
}

// A trial that has lived, with contacts, and its record.
struct Lived {
  Trial trial{shipped("paper"), TrialConfig{}, 7};
  Record record;
  Lived() {
    const RunOptions echoes{true, {}};
    trial.free_learning(record, 1500, echoes);
    trial.path_learning(record, 2, 300, echoes);
  }
  Bytes bytes() const { return to_bytes(trial, {&record, true, ""}); }
};

// Which field is refused.
std::string refusal(const Bytes& bytes) {
  try {
    loaded(bytes);
  } catch (const FileError& error) {
    CHECK(error.file() == "it");
    CHECK_FALSE(error.allowed().empty());
    return error.field().empty() ? "the file" : error.field();
  }
  return "";
}

// Goes to and fro; nothing of ours knows how to save it.
class Own final : public Agent {
 public:
  Choice choose(const Observation&) override { return {steps++ % 5, Kind::kUnstated}; }
  Development observe(const Outcome&) override {
    if (observing) observing();
    return {};
  }
  int steps = 0;
  std::function<void()> observing;
};

}  // namespace

TEST_CASE("a trial that is loaded goes on equal to the bit") {
  for (const char* world : {"paper", "u_trap"}) {
    for (const TrialConfig& config : {TrialConfig{}, sonar_config()}) {
      Trial trial(shipped(world), config, 3);
      Record record;
      trial.free_learning(record, 1200);
      REQUIRE(std::count(record.collided.begin(), record.collided.end(), 1) > 0);
      TrialSnapshot snapshot = loaded(to_bytes(trial));
      CHECK_FALSE(snapshot.record.has_value());
      CHECK(snapshot.trial.config() == config);
      CHECK(snapshot.trial.seed() == 3);
      CHECK(snapshot.trial.pose() == trial.pose());
      CHECK(snapshot.trial.round() == 1);
      CHECK(snapshot.trial.world().to_json() == trial.world().to_json());
      require_equal_futures(std::move(trial), std::move(snapshot.trial));
    }
  }
}

TEST_CASE("a trial that has not begun survives, too") {
  Trial trial(shipped("office"), {}, 1);
  TrialSnapshot snapshot = loaded(to_bytes(trial));
  CHECK(snapshot.trial.round() == 0);
  require_equal_futures(std::move(trial), std::move(snapshot.trial));
}

TEST_CASE("random motions go on as they would have") {
  Trial trial(shipped("empty"), {}, 1, std::make_shared<RandomAgent>(5));
  recorded([&](Record& r) { trial.free_learning(r, 100); });
  TrialSnapshot snapshot = loaded(to_bytes(trial));
  CHECK(snapshot.trial.learner() == nullptr);
  require_equal_futures(std::move(trial), std::move(snapshot.trial));
}

TEST_CASE("a trial and its learner keep configurations and seeds of their own") {
  LearnerConfig other;
  other.sigma = 0.7;
  const auto agent = std::make_shared<LearnerAgent>(std::make_shared<Learner>(other, 99));
  const Trial trial(shipped("empty"), {}, 4, agent);
  const TrialSnapshot snapshot = loaded(to_bytes(trial));
  CHECK(snapshot.trial.seed() == 4);
  CHECK(snapshot.trial.config() == TrialConfig{});
  CHECK(snapshot.trial.learner()->seed() == 99);
  CHECK(snapshot.trial.learner()->config() == other);
}

TEST_CASE("path learning stopped anywhere goes on so that the joined record is the unbroken one") {
  constexpr std::int64_t kRounds = 8, kLimit = 1500;
  Trial unbroken(shipped("paper"), {}, 2);
  Record whole;
  unbroken.free_learning(whole, 6000, {true, {}});
  unbroken.path_learning(whole, kRounds, kLimit, {true, {}});
  REQUIRE(std::count_if(whole.rounds.begin(), whole.rounds.end(),
                        [](const Round& round) { return round.arrived; }) > 4);
  REQUIRE(whole.steps() > 6000 + 8 * 200);

  for (int looks = 1; looks < 1000; looks += 1 + looks / 2) {
    Trial trial(shipped("paper"), {}, 2);
    Record record;
    trial.free_learning(record, 6000, {true, {}});
    int look = 0;
    trial.path_learning(record, kRounds, kLimit, {true, [&] { return ++look == looks; }});
    const Bytes bytes = to_bytes(trial, {&record, true, ""});

    TrialSnapshot snapshot = loaded(bytes);
    Trial& resumed = snapshot.trial;
    Record& joined = *snapshot.record;
    REQUIRE(same(trial, record, resumed, joined));
    resumed.finish_round(joined, kLimit - joined.rounds.back().steps, {true, {}});
    const auto finished = static_cast<std::int64_t>(joined.rounds.size()) - 1;
    resumed.path_learning(joined, kRounds - finished, kLimit, {true, {}});
    REQUIRE(same(resumed, joined, unbroken, whole));
  }
}

TEST_CASE("an agent of one's own is refused with what to do, and takes its place when loading") {
  const auto own = std::make_shared<Own>();
  Trial trial(shipped("empty"), {}, 1, own);
  recorded([&](Record& r) { trial.free_learning(r, 33); });
  const std::string path = std::string(DEVLEARN_BINARY_DIR) + "/own.safetensors";
  std::remove(path.c_str());
  for (const auto& saving : {std::function<void()>([&] { save(trial, path); }),
                             std::function<void()>([&] { to_bytes(trial); })}) {
    try {
      saving();
      FAIL("not refused");
    } catch (const InvalidValue& error) {
      CHECK(error.quantity() == "Trial.agent");
      CHECK(error.value().find("Own") != std::string::npos);
      CHECK(error.allowed().find("give the agent when loading") != std::string::npos);
    }
  }
  CHECK_FALSE(std::ifstream(path).good());

  const Bytes bytes = to_bytes(trial, {nullptr, false, ""});
  CHECK(refusal(bytes) == "agent");
  const auto again = std::make_shared<Own>(*own);
  Trial resumed = loaded(bytes, again).trial;
  CHECK(resumed.agent() == again);
  const Record a = recorded([&](Record&r) { trial.run(r, 50); }),
               b = recorded([&](Record&r) { resumed.run(r, 50); });
  CHECK(a.x == b.x);
  CHECK(a.motion == b.motion);
}

namespace {

// A number of ours, that decides which way to go.
class Counting final : public Agent {
 public:
  Counting() = default;
  explicit Counting(const AgentState& state)
      : steps(state.values<std::int64_t>("steps", {})[0]), rounds(state.text("rounds")) {}
  void begin_round() override { rounds += "b"; }
  Choice choose(const Observation&) override {
    return {static_cast<int>(steps * steps % 5), Kind::kUnstated};
  }
  Development observe(const Outcome&) override {
    ++steps;
    return {};
  }
  void end_round(bool arrived) override { rounds += arrived ? "T" : "F"; }
  std::optional<AgentState> state() const override {
    return AgentState{kind, {{"rounds", rounds}}, {{"steps", array_of<std::int64_t>({steps}, {})}}};
  }
  std::int64_t steps = 0;
  std::string rounds, kind = "counting";
};

std::shared_ptr<Agent> counting(const AgentState& state) {
  return state.kind == "counting" ? std::make_shared<Counting>(state) : nullptr;
}

}  // namespace

TEST_CASE("an agent of one's own is saved with the trial, and its maker makes it again") {
  const auto agent = std::make_shared<Counting>();
  Trial trial(shipped("empty"), {}, 1, agent);
  Record record;
  trial.free_learning(record, 33);
  const Bytes bytes = to_bytes(trial);
  CHECK(refusal(bytes) == "agent");

  Trial resumed = load_trial(bytes.data(), bytes.size(), {nullptr, counting}, "it").trial;
  CHECK(resumed.round_open());
  CHECK(to_bytes(resumed) == bytes);
  Record again;
  trial.run(record = {}, 50);
  trial.path_learning(record, 2, 60);
  resumed.run(again, 50);
  resumed.path_learning(again, 2, 60);
  CHECK(again.x == record.x);
  CHECK(std::dynamic_pointer_cast<Counting>(resumed.agent())->rounds == agent->rounds);
  CHECK(to_bytes(resumed) == to_bytes(trial));
}

TEST_CASE("a maker that does not know the kind leaves it to devlearn") {
  const Lived lived;
  const Bytes bytes = lived.bytes();
  const auto snapshot = load_trial(bytes.data(), bytes.size(), {nullptr, counting}, "it");
  CHECK(same(snapshot.trial, *snapshot.record, lived.trial, lived.record));
}

TEST_CASE("a state that does not fit its maker is refused as the file's fault") {
  const auto agent = std::make_shared<Counting>();
  SnapshotBytes lie{to_bytes(Trial(shipped("empty"), {}, 1, agent))};
  REQUIRE(lie.replace("\"agent.steps\":{\"dtype\":\"I64\"", "\"agent.steps\":{\"dtype\":\"U64\""));
  const Bytes bytes = lie.mended();
  try {
    load_trial(bytes.data(), bytes.size(), {nullptr, counting}, "it");
    FAIL("not refused");
  } catch (const FileError& error) {
    CHECK(error.file() == "it");
    CHECK(error.field() == "steps");
    CHECK(error.value() == "U64");
  }
}

TEST_CASE("a state that a file cannot hold is not saved") {
  class Odd final : public Agent {
   public:
    explicit Odd(AgentState state) : state_(std::move(state)) {}
    Choice choose(const Observation&) override { return {0, Kind::kUnstated}; }
    Development observe(const Outcome&) override { return {}; }
    std::optional<AgentState> state() const override { return state_; }

   private:
    AgentState state_;
  };
  const auto refused = [](const AgentState& state, const char* quantity, const char* value) {
    const Trial trial(shipped("empty"), {}, 1, std::make_shared<Odd>(state));
    check_refused([&] { to_bytes(trial); }, quantity, value);
  };
  refused({"none", {}, {}}, "Trial.agent.kind", "none");
  refused({"\xff", {}, {}}, "Trial.agent.kind", "?");
  refused({"odd", {{"\xff", ""}}, {}}, "Trial.agent.texts", "?");
  refused({"odd", {{"name", "\xff"}}, {}}, "name", "?");
  StateArray array = array_of(std::vector<double>(3));
  refused({"odd", {}, {{"\xff", array}}}, "Trial.agent.arrays", "?");
  array.shape = {4};
  refused({"odd", {}, {{"q", array}}}, "agent.q.shape", "24 bytes");
  array.dtype = "F32";
  refused({"odd", {}, {{"q", array}}}, "agent.q.dtype", "F32");
  AgentState many{"odd", {}, {}};
  for (int i = 0; i < 100'000; ++i) many.texts[std::to_string(i)] = "";
  const Trial trial(shipped("empty"), {}, 1, std::make_shared<Odd>(many));
  CHECK_THROWS_AS(to_bytes(trial), InvalidValue);
}

TEST_CASE("whether a round is open is saved; a file that does not say has one where it has begun") {
  Lived lived;
  CHECK(loaded(lived.bytes()).trial.round_open() == lived.trial.round_open());
  for (const char* open : {"true", "false"}) {
    SnapshotBytes bytes{lived.bytes()};
    REQUIRE(bytes.set_entry("round_open", open));
    CHECK(loaded(bytes.mended()).trial.round_open() == (std::string(open) == "true"));
    REQUIRE(bytes.replace("\"round_open\"", "\"rounds_open\""));
    CHECK(loaded(bytes.mended()).trial.round_open());
    REQUIRE(bytes.set_entry("round", "0"));
    CHECK_FALSE(loaded(bytes.mended()).trial.round_open());
  }
}

TEST_CASE("the agent that is given goes on instead of the one in the file") {
  Lived lived;
  const auto own = std::make_shared<Own>();
  Trial trial = loaded(lived.bytes(), own).trial;
  trial.step();
  CHECK(own->steps == 1);
  LearnerConfig other;
  other.motion_count = 3;
  CHECK_THROWS_AS(
      loaded(lived.bytes(), std::make_shared<LearnerAgent>(std::make_shared<Learner>(other, 1))),
      FileError);
}

TEST_CASE("a trial is not saved in the middle of a step") {
  const auto own = std::make_shared<Own>();
  Trial trial(shipped("empty"), {}, 1, own);
  own->observing = [&] { to_bytes(trial, {nullptr, false, ""}); };
  check_refused([&] { trial.step(); }, "Trial", "a snapshot while a call is under way");
}

TEST_CASE("file, stream and memory hold the same snapshot, its record and its note") {
  const Lived lived;
  const SaveOptions all{&lived.record, true, "caf\u00e9 \"quoted\"\n"};
  const Bytes bytes = to_bytes(lived.trial, all);
  const std::string path = std::string(DEVLEARN_BINARY_DIR) + "/trial.safetensors";
  save(lived.trial, path, all);
  std::ostringstream stream;
  save(lived.trial, stream, all);
  CHECK(stream.str() == std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  std::istringstream again(stream.str());
  for (const TrialSnapshot& snapshot : {load_trial(path), load_trial(again), loaded(bytes)}) {
    CHECK(snapshot.note == all.note);
    REQUIRE(snapshot.record.has_value());
    CHECK(to_bytes(snapshot.trial, {&*snapshot.record, true, snapshot.note}) == bytes);
  }
  std::remove(path.c_str());
}

Trial in_open_world() {
  TrialConfig config;
  config.evaluation = {20.0, 0.3, 3.0, 0.5, 1.5};
  return Trial(open_world(), config, 2);
}

TEST_CASE("trials that earlier versions saved have the past and the future that they had then") {
  const auto future = [](const std::string& path) {
    TrialSnapshot snapshot = load_trial(path);
    REQUIRE(snapshot.record.has_value());
    Record& record = *snapshot.record;
    const auto past = static_cast<std::ptrdiff_t>(record.steps());
    snapshot.trial.run(record, 100, {true, {}});
    snapshot.trial.path_learning(record, 2, 60, {true, {}});
    CHECK(std::count(record.collided.begin() + past, record.collided.end(), 1) == 0);
    std::string text;
    for (std::size_t i = 0; i < record.steps(); ++i) {
      char line[200];
      std::snprintf(line, sizeof line, "%d %lld %d %d %lld %.17g %.17g\n", record.round[i],
                    static_cast<long long>(record.situation[i]), record.motion[i], record.event[i],
                    static_cast<long long>(record.effective_count[i]), record.smf[i],
                    record.clearance[i]);
      text += line;
    }
    for (const Round& round : record.rounds) {
      text += std::to_string(round.round) + " " + std::to_string(round.steps) + " " +
              std::to_string(round.arrived) + "\n";
    }
    return text;
  };
  const auto past = [](const std::string& path) {
    Trial trial = in_open_world();
    recorded([&](Record& r) { trial.free_learning(r, 150); });
    Record record;
    trial.free_learning(record, 40, {true, {}});
    save(trial, path, {&record, true, "kept"});
  };
  check_kept_snapshots("trial", past, future);
}

TEST_CASE("a record that does not fit is not saved") {
  Lived lived;
  const auto refused = [&](const auto& harm) {
    Record record = lived.record;
    harm(record);
    try {
      to_bytes(lived.trial, {&record, true, ""});
    } catch (const InvalidValue& error) {
      return error.quantity();
    }
    return std::string();
  };
  CHECK(refused([](Record&) {}) == "");
  CHECK(refused([](Record& r) { r.sef.pop_back(); }) == "record.sef");
  CHECK(refused([](Record& r) { r.heading.push_back(0.0); }) == "record.heading");
  CHECK(refused([](Record& r) { r.echoes.pop_back(); }) == "record.echoes");
  CHECK(refused([](Record& r) { r.rounds[0].steps -= 1; }) == "record.rounds.steps");
  CHECK(refused([](Record& r) { r.rounds[1].steps += 1000; }) == "record.rounds[1].steps");
  CHECK(refused([](Record& r) { r.rounds[1].round = 0; }) == "record.rounds[1].round");
  CHECK(refused([](Record& r) { r.kind[5] = 7; }) == "record.kind[5]");
  CHECK(refused([](Record& r) { r.motion[2] = -1; }) == "record.motion[2]");
  check_refused([&] { to_bytes(lived.trial, {nullptr, true, "\xff"}); }, "note", "?");
}

TEST_CASE("a trial's snapshot cut off anywhere, or with a bit flipped, is refused") {
  const Bytes bytes = Lived().bytes();
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 32) {
    REQUIRE(refusal(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size))) != "");
  }
  for (std::size_t i = 0; i < bytes.size(); i += 97 + i / 40) {
    Bytes damaged = bytes;
    damaged[i] ^= static_cast<std::byte>(1 << i % 8);
    REQUIRE(refusal(damaged) != "");
  }
}

TEST_CASE("a trial's snapshot that lies is refused, naming the lie") {
  const SnapshotBytes good{Lived().bytes()};
  REQUIRE(refusal(good.mended()) == "");
  const auto with_entry = [&](const char* name, const std::string& value) {
    SnapshotBytes lie = good;
    REQUIRE(lie.set_entry(name, value));
    return refusal(lie.mended());
  };
  const auto with = [&](const char* array, std::size_t i, auto value) {
    SnapshotBytes lie = good;
    lie.set(array, i, value);
    return refusal(lie.mended());
  };
  const auto with_text = [&](const std::string& from, const std::string& to) {
    SnapshotBytes lie = good;
    REQUIRE(lie.replace(from, to));
    return refusal(lie.mended());
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinite = std::numeric_limits<double>::infinity();

  SUBCASE("about what it is") {
    CHECK(with_entry("format", "devlearn-learner") == "format");
    CHECK(with_entry("format_version", "4") == "format_version");
    CHECK(with_entry("format_version", "0") == "format_version");
    CHECK(with_entry("format_version", "one") == "format_version");
    const Bytes learner = to_bytes(Learner());
    CHECK(refusal(learner) == "format");
    CHECK_THROWS_AS(load_learner(good.mended().data(), good.mended().size()), FileError);
    CHECK(with_text("\"box2d\":", "\"note\":\"\xff\",\"box2d\":") == "header");
    CHECK(with_entry("box2d", "\xff") == "header");
  }
  SUBCASE("about where the robot is") {
    CHECK(with("pose", 0, nan) == "pose.x");
    CHECK(with("pose", 1, infinite) == "pose.y");
    CHECK(with("pose", 2, nan) == "pose.heading");
    CHECK(with("pose", 0, -1.0) == "pose.x");
    SnapshotBytes inside = good;  // an obstacle
    const World world = shipped("paper");
    for (const Obstacle& obstacle : world.def().obstacles) {
      if (const auto* circle = std::get_if<Circle>(&obstacle)) {
        inside.set("pose", 0, circle->center.x);
        inside.set("pose", 1, circle->center.y);
      }
    }
    CHECK(refusal(inside.mended()) == "pose");
    CHECK(with_entry("round", "-1") == "round");
    CHECK(with_entry("round", "2147483647") == "round");
    CHECK(with_entry("round", "99999999999") == "round");
    CHECK(with_entry("round_open", "perhaps") == "round_open");
  }
  SUBCASE("about the world") {
    CHECK(with_text("\\\"arena\\\"", "\\\"arenas\\\"") == "world.arenas");
    CHECK(with_text("\\\"width\\\": 5", "\\\"width\\\": 1e9") == "world.arena.width");
    CHECK(with_text("\\\"version\\\": 1", "\\\"version\\\": 2") == "world.version");
    const std::string deep(50000, '[');
    CHECK(with_text("\\\"obstacles\\\": [", "\\\"obstacles\\\": " + deep) ==
          "world.obstacles" + [] {
            std::string path;
            for (int i = 0; i < 15; ++i) path += "[0]";
            return path;
          }());
    CHECK(with_text("\"world\":\"{", "\"world\":\"") == "world");
    CHECK(with_text("\"world\":", "\"word\":") == "__metadata__.world");
  }
  SUBCASE("about the configuration") {
    CHECK(with_entry("config.goal_radius", "nan") == "TrialConfig.goal_radius");
    CHECK(with_entry("config.goal_radius", "1e999") == "config.goal_radius");
    CHECK(with_entry("config.learner.motion_count", "6") == "TrialConfig.learner.motion_count");
    CHECK(with_entry("config.learner.motion_count", "-5") == "LearnerConfig.motion_count");
    CHECK(with_entry("config.clearance_source", "guess") == "config.clearance_source");
    CHECK(with_entry("config.clearance_source", "sonar") == "TrialConfig.walls_count");
    CHECK(with_entry("config.robot.sonar_count", "1000000000") == "RobotDef.sonar_count");
    CHECK(with_entry("config.heading_bins", "0") == "TrialConfig.heading_bins");
    CHECK(with_entry("trial_seed", "-1") == "trial_seed");
    CHECK(with("steering_angles", 0, nan) == "RobotDef.steering_angles[0]");
  }
  SUBCASE("about the agent") {
    CHECK(with_entry("agent", "q-learning") == "agent");
    CHECK(with_entry("motion_count", "4") == "motions");
    CHECK(with_entry("sigma", "2") == "LearnerConfig.sigma");
    CHECK(with_entry("situations", "18446744073709551615") == "situation");
    CHECK(with("orientation", 0, nan) == "memory.orientation[0]");
    CHECK(with("times_learned", 1, std::uint32_t{0}) == "memory.times_learned[1]");
    CHECK(with("motions", 0, std::uint16_t{5}) == "memory.motions[0]");
  }
  SUBCASE("about the record") {
    CHECK(with_entry("record_steps", "1") == "record.round");
    CHECK(with_entry("record_steps", "18446744073709551615") == "record.round");
    CHECK(with_entry("record_rounds", "18446744073709551615") == "record.x");
    CHECK(with_entry("record_sonars", "-5") == "record.echoes");
    CHECK(with("record.rounds.steps", 0, std::int64_t{-1}) == "record.rounds[0].steps");
    CHECK(with("record.rounds.steps", 0, std::int64_t{1} << 60) == "record.rounds[0].steps");
    CHECK(with("record.rounds.steps", 0, std::int64_t{1499}) == "record.rounds.steps");
    CHECK(with("record.rounds.arrived", 0, std::uint8_t{2}) == "record.rounds.arrived");
    CHECK(with("record.kind", 3, std::uint8_t{17}) == "record.kind[3]");
    CHECK(with("record.collided", 4, std::uint8_t{2}) == "record.collided[4]");
    CHECK(with("record.motion", 5, std::int32_t{-2}) == "record.motion[5]");
    CHECK(with_text("\"record.sef\"", "\"record.self\"") == "record.sef");
  }
}

// --- an evaluation and situations of one's own
// -----------------------------------------------------

namespace {

TrialParts own_parts(const std::string& evaluation, const std::string& situations) {
  TrialParts parts;
  parts.evaluation = {evaluation, [](const Senses& senses) { return -senses.goal_distance; }};
  parts.situations = {situations, [](const Senses& senses) {
                        return static_cast<SituationId>(10.0 * senses.clearance) +
                               100 * static_cast<SituationId>(senses.pose.heading / 30.0);
                      }};
  return parts;
}

}  // namespace

TEST_CASE("a trial with functions of one's own goes on where they are given again") {
  Trial trial(shipped("paper"), {}, 3, own_parts("mine:progress", "mine:gap"));
  Record record;
  trial.free_learning(record, 300);
  const Bytes bytes = to_bytes(trial);
  LoadOptions options;
  options.parts = own_parts("elsewhere:progress", "elsewhere:gap");
  Trial again = load_trial(bytes.data(), bytes.size(), options).trial;
  Record there, here;
  trial.path_learning(here, 3, 200);
  again.path_learning(there, 3, 200);
  CHECK(here.x == there.x);
  CHECK(here.situation == there.situation);
  CHECK(here.sef == there.sef);
}

TEST_CASE("functions that are missing, others, or too many are refused by the names in the file") {
  const auto refused = [](const TrialParts& saved, const TrialParts& given, const char* field,
                          const char* value) {
    const Bytes bytes = to_bytes(Trial(shipped("paper"), {}, 3, saved));
    LoadOptions options;
    options.parts = given;
    try {
      load_trial(bytes.data(), bytes.size(), options, "it");
      FAIL("was read");
    } catch (const FileError& error) {
      CHECK(error.field() == field);
      CHECK(error.value() == value);
    }
  };
  const TrialParts both = own_parts("progress", "gap");
  TrialParts table;
  table.sef_table.assign(static_cast<std::size_t>(Trial(shipped("paper")).grid().count()), 1.5);
  refused(both, {}, "own.evaluation", "progress");
  refused(own_parts("here:", "gap"), {}, "own.evaluation", "here:");
  refused(both, own_parts("progress", "other"), "own.situations", "gap");
  refused({}, both, "own.evaluation", "none");
  refused(table, both, "own.evaluation", "none");
  refused(table, table, "own.sef_table", "given again");
}

TEST_CASE("a table of SEFs is saved whole") {
  TrialParts parts;
  const SituationId count = Trial(shipped("paper")).grid().count();
  for (SituationId id = 0; id < count; ++id) {
    parts.sef_table.push_back(0.1 * static_cast<double>(id));
  }
  Trial trial(shipped("paper"), {}, 3, parts);
  const Bytes bytes = to_bytes(trial);
  Trial again = loaded(bytes).trial;
  CHECK(again.parts().sef_table == parts.sef_table);
  CHECK(to_bytes(again) == bytes);
}

TEST_CASE("a trial has a newer version only where older builds would misread it") {
  const auto version = [](const TrialConfig& config, const TrialParts& parts = {}) {
    const Bytes bytes = to_bytes(Trial(shipped("paper"), config, 3, parts));
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::string entry = "\"format_version\":\"";
    return text.at(text.find(entry) + entry.size());
  };
  CHECK(version({}) == '1');
  CHECK(version({}, own_parts("progress", "gap")) == '2');
  TrialConfig noisy, wide, large;
  noisy.noise.slip = 0.1;
  wide.robot.sonar_beam = 15.0;
  large.robot.radius = 0.12;
  CHECK(version(noisy) == '3');
  CHECK(version(wide) == '3');
  CHECK(version(wide, own_parts("progress", "gap")) == '3');
  CHECK(version(large) == '1');
}

TEST_CASE("a record is read from a trial's file without the functions it was made by") {
  Trial trial(shipped("paper"), {}, 3, own_parts("progress", "gap"));
  Record record;
  trial.free_learning(record, 50);
  const std::string path = "own_parts.safetensors";
  save(trial, path, {&record, true, "a note"});
  const RecordSnapshot found = load_record(path);
  std::remove(path.c_str());
  REQUIRE(found.record);
  CHECK(found.record->sef == record.sef);
  CHECK(found.world.def().name == trial.world().def().name);
  CHECK(found.config == trial.config());
  CHECK(found.seed == 3);
  CHECK(found.note == "a note");
}
