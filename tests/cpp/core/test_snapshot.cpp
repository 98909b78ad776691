#include <doctest/doctest.h>

#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include "devlearn/error.hpp"
#include "devlearn/random.hpp"
#include "devlearn/snapshot.hpp"

using namespace devlearn;

namespace {

// Lives a while among some situations.
void live(Learner& learner, Random& world, int steps) {
  for (int i = 0; i < steps; ++i) {
    const auto situation = static_cast<SituationId>(world.index(40)) * 1000003;
    const int motion = learner.choose(situation).motion;
    learner.learn(world.uniform() * 4.0 - 2.0 + 0.1 * motion);
  }
}

Learner experienced(const LearnerConfig& config = {}) {
  Learner learner(config, 7);
  Random world(7, "world");
  live(learner, world, 3000);
  return learner;
}

LearnerConfig nine_motions() {
  LearnerConfig config = LearnerConfig::step5();
  config.motion_count = 9;
  config.sigma = 0.123456789012345678;
  return config;
}

Learner copy_of(const Learner& learner) {
  const std::vector<std::byte> bytes = to_bytes(learner);
  return load_learner(bytes.data(), bytes.size());
}

void require_equal_futures(Learner a, Learner b) {
  Random world_a(99, "world"), world_b(99, "world");
  live(a, world_a, 2000);
  live(b, world_b, 2000);
  REQUIRE(to_bytes(a) == to_bytes(b));
}

std::string refusal(const std::vector<std::byte>& bytes) {
  try {
    load_learner(bytes.data(), bytes.size(), "it");
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

std::string refusal(const LearnerState& state) {
  try {
    Learner learner(state);
  } catch (const InvalidValue& error) {
    return error.quantity();
  }
  return "";
}

}  // namespace

TEST_CASE("a learner that is loaded goes on equal to the bit") {
  for (const LearnerConfig& config : {LearnerConfig{}, nine_motions()}) {
    const Learner learner = experienced(config);
    const Learner loaded = copy_of(learner);
    CHECK(loaded.config() == learner.config());
    CHECK(loaded.seed() == learner.seed());
    CHECK(loaded.explored_count() == learner.explored_count());
    CHECK(loaded.effective_count() == learner.effective_count());
    require_equal_futures(learner, loaded);
  }
}

TEST_CASE("a learner that has experienced nothing survives, too") {
  const Learner learner(nine_motions(), 3);
  require_equal_futures(learner, copy_of(learner));
}

TEST_CASE("a choice that waits for its outcome survives") {
  Learner learner = experienced();
  const Choice choice = learner.choose(12345);
  Learner loaded = copy_of(learner);
  REQUIRE(loaded.pending().has_value());
  CHECK(loaded.pending()->motion == choice.motion);
  CHECK(loaded.pending()->kind == choice.kind);
  CHECK(loaded.learn(1.0).situation == 12345);
  CHECK_FALSE(loaded.pending().has_value());
}

TEST_CASE("file, stream and memory hold the same snapshot") {
  const Learner learner = experienced();
  const std::vector<std::byte> bytes = to_bytes(learner);
  const std::string path = std::string(DEVLEARN_BINARY_DIR) + "/learner.safetensors";
  save(learner, path);
  std::ostringstream stream;
  save(learner, stream);
  std::ifstream file(path, std::ios::binary);
  std::ostringstream read;
  read << file.rdbuf();
  CHECK(read.str() == stream.str());
  CHECK(stream.str() == std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  std::istringstream again(stream.str());
  CHECK(to_bytes(load_learner(again)) == bytes);
  CHECK(to_bytes(load_learner(path)) == bytes);
  std::remove(path.c_str());
}

TEST_CASE("a snapshot cut off anywhere is refused") {
  const std::vector<std::byte> bytes = to_bytes(experienced());
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 64) {
    CHECK(refusal(std::vector<std::byte>(bytes.begin(), bytes.begin() + size)) != "");
  }
}

TEST_CASE("a snapshot with any bit flipped is refused") {
  const std::vector<std::byte> bytes = to_bytes(experienced());
  for (std::size_t i = 0; i < bytes.size(); i += 7) {
    std::vector<std::byte> damaged = bytes;
    damaged[i] ^= static_cast<std::byte>(1 << i % 8);
    REQUIRE(refusal(damaged) != "");
  }
}

TEST_CASE("a file that is none of ours is refused with what is wrong") {
  const auto of = [](std::string text) {
    const auto* const data = reinterpret_cast<const std::byte*>(text.data());
    return refusal(std::vector<std::byte>(data, data + text.size()));
  };
  const auto with_header = [&](const std::string& header) {
    std::string text(8, '\0');
    text[0] = static_cast<char>(header.size() & 255);
    text[1] = static_cast<char>(header.size() >> 8);
    return of(text + header);
  };
  CHECK(of("").find("0 bytes") != std::string::npos);
  CHECK(of(std::string(7, '\xff') + '\x0f').find("header length") != std::string::npos);
  CHECK(with_header("[]").find("byte 0") != std::string::npos);
  CHECK(with_header(std::string(50000, '{')).find("byte 1") != std::string::npos);
  CHECK(with_header("{\"__metadata__\":{}}").find("checksum") != std::string::npos);
  CHECK(with_header("{\"a\":{\"dtype\":\"F64\",\"shape\":[1152921504606846976],"
                    "\"data_offsets\":[0,0]}}")
            .find("a.shape") != std::string::npos);
  CHECK(with_header("{\"a\":{\"dtype\":\"F64\",\"shape\":[1],\"data_offsets\":[0,8]}}")
            .find("a.data_offsets") != std::string::npos);
  CHECK(with_header("{\"a\":{},\"a\":{}}") != "");
  std::string keys = "{\"__metadata__\":{";
  for (int i = 0; i <= 1000; ++i) keys += "\"" + std::to_string(i) + "\":\"\",";
  CHECK(with_header(keys + "\"\":\"\"}}").find("at most 1000 keys") != std::string::npos);
  // What it holds is not repeated at length.
  CHECK(with_header("{\"" + std::string(50000, 'a') + "\":{}}").size() < 1000);
}

TEST_CASE("a state that breaks a law of the method is refused, naming it") {
  const LearnerState good = experienced().state();
  CHECK(refusal(good) == "");
  const auto broken = [&](const auto& harm) {
    LearnerState state = good;
    harm(state);
    return refusal(state);
  };
  using S = LearnerState&;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(broken([](S s) { s.memory.situation[1] = s.memory.situation[0]; }) ==
        "memory.situation[1]");
  CHECK(broken([](S s) { s.memory.situation[2] = -1; }) == "memory.situation[2]");
  CHECK(broken([](S s) { s.memory.motions[0] = s.memory.motions[1]; }) == "memory.motions[0]");
  CHECK(broken([](S s) { s.memory.motions[3] = 5; }) == "memory.motions[0]");
  CHECK(broken([](S s) { s.memory.orientation[0] = nan; }) == "memory.orientation[0]");
  CHECK(broken([](S s) { s.memory.orientation[0] = -0.1; }) == "memory.orientation[0]");
  CHECK(broken([](S s) { s.memory.orientation[0] *= 0.9; }).find("memory.orientation") == 0);
  CHECK(broken([](S s) { s.memory.times_learned[0] = 0; }) == "memory.times_learned[0]");
  CHECK(broken([](S s) { s.memory.ineffective_count[0] = 6; }) == "memory.ineffective_count[0]");
  CHECK(broken([](S s) { s.memory.motions.pop_back(); }) == "memory.motions");
  CHECK(broken([](S s) { s.memory.orientation.push_back(1.0); }) == "memory.orientation");
  CHECK(broken([](S s) { s.random = {}; }) == "random");
  CHECK(broken([](S s) { s.pending = {-5, {0, Kind::kExplore}}; }) == "pending.situation");
  CHECK(broken([](S s) { s.pending = {0, {5, Kind::kExplore}}; }) == "pending.motion");
  CHECK(broken([](S s) { s.config.sigma = nan; }) == "LearnerConfig.sigma");
}

TEST_CASE("orientations of which Eq. 9 and 14 would leave nothing are refused") {
  LearnerConfig config;
  config.motion_count = 2;
  Learner learner(config);
  learner.update(0, 0, 1.0);
  learner.update(0, 1, 1.0);
  LearnerState state = learner.state();
  for (const double least : {0.0, 5e-324, 1e-13}) {
    state.memory.orientation = {1.0, least};
    CHECK(refusal(state) == "memory.orientation[1]");
  }
  state.memory.orientation = {1.0, 1e-12};
  for (const double smf : {-50.0, -1e300, 1e300}) {
    for (const int motion : {0, 1}) {
      Learner lived(state);
      lived.update(0, motion, smf);
      CHECK(refusal(lived.state()) == "");
    }
  }
}

TEST_CASE("a snapshot that cannot be written leaves the previous one whole") {
  const std::string folder = std::string(DEVLEARN_BINARY_DIR) + "/no such folder";
  CHECK_THROWS_AS(save(experienced(), folder + "/learner"), FileError);
  CHECK_THROWS_AS(save(experienced(), "/dev/full"), FileError);
  CHECK_THROWS_AS(load_learner(folder), FileError);
}
