#include <doctest/doctest.h>

#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "devlearn/error.hpp"
#include "devlearn/random.hpp"
#include "devlearn/snapshot.hpp"
#include "experienced.hpp"
#include "snapshot_bytes.hpp"

using namespace devlearn;

namespace {

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

TEST_CASE("stream and memory hold the same snapshot") {
  const Learner learner = experienced();
  const std::vector<std::byte> bytes = to_bytes(learner);
  std::ostringstream stream;
  save(learner, stream);
  CHECK(stream.str() == std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  std::istringstream again(stream.str());
  CHECK(to_bytes(load_learner(again)) == bytes);
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
    for (std::size_t i = 0; i < 8; ++i) text[i] = static_cast<char>(header.size() >> 8 * i & 255);
    return of(text + header);
  };
  std::string many;
  for (int i = 0; i < 100000; ++i) many += "0,";
  CHECK(of("").find("0 bytes") != std::string::npos);
  CHECK(of(std::string(7, '\xff') + '\x0f').find("header length") != std::string::npos);
  CHECK(with_header("[]").find("header: got an array") != std::string::npos);
  CHECK(with_header(std::string(50000, '{')).find("line 1, column 2") != std::string::npos);
  CHECK(with_header("{\"__metadata__\":{}}").find("checksum") != std::string::npos);
  CHECK(with_header("{\"a\":{\"dtype\":\"F64\",\"shape\":[1152921504606846976],"
                    "\"data_offsets\":[0,0]}}")
            .find("a.shape") != std::string::npos);
  CHECK(with_header("{\"a\":{\"dtype\":\"F64\",\"shape\":[1],\"data_offsets\":[0,8]}}")
            .find("a.data_offsets") != std::string::npos);
  CHECK(with_header("{\"a\":{},\"a\":{}}") != "");
  CHECK(with_header("{\"a\":{\"shape\":[" + many + "0]}}").find("at most 100000 values") !=
        std::string::npos);
  CHECK(
      with_header("{\"__metadata__\":{\"a\":1}}").find("__metadata__.a: got 1; expected a text") !=
      std::string::npos);
  CHECK(with_header("{\"__metadata__\":{\"a\":\"\xff\"}}").find("UTF-8") != std::string::npos);
  // What it holds is not repeated at length.
  CHECK(with_header("{\"" + std::string(50000, 'a') + "\":{}}").size() < 1000);
}

TEST_CASE("a snapshot that lies, its checksum mended, is refused, naming the lie") {
  const SnapshotBytes good(to_bytes(experienced()));
  REQUIRE(refusal(good.mended()) == "");
  const auto told = [&](const auto& lie) {
    SnapshotBytes bytes = good;
    lie(bytes);
    const std::string error = refusal(bytes.mended());
    CHECK(error.rfind("it: ", 0) == 0);
    return error.substr(4, error.find(": got") - 4);
  };
  using B = SnapshotBytes&;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string end = std::to_string(good.data.size());

  SUBCASE("about versions and formats") {
    CHECK(told([](B b) { b.set_entry("format", "devlearn-trial"); }) == "format");
    CHECK(told([](B b) { b.set_entry("format", std::string(5000, 'x')); }) == "format");
    CHECK(told([](B b) { b.set_entry("format_version", "2"); }) == "format_version");
    CHECK(told([](B b) { b.set_entry("format_version", "99999999999999999999"); }) ==
          "format_version");
    CHECK(told([](B b) { b.set_entry("checksum", "0"); }) == "checksum");
    CHECK(told([](B b) { b.replace("\"format\"", "\"tamrof\""); }) == "__metadata__.format");
    CHECK(told([](B b) { b.replace("__metadata__", "__atadatem__"); }) == "__atadatem__.c1");
  }
  SUBCASE("about where arrays lie") {
    CHECK(told([](B b) { b.replace("\"orientation\"", "\"orientatiom\""); }) == "orientation");
    CHECK(told([](B b) { b.replace("\"I64\"", "\"U64\""); }) == "situation");
    CHECK(told([](B b) { b.replace("\"I64\"", "\"F16\""); }) == "situation.dtype");
    CHECK(told([&](B b) {
            b.replace("," + end + "]", ",1152921504606846976]");
          }).find(".data_offsets") != std::string::npos);
    CHECK(told([](B b) {
            b.replace("\"shape\":[40]", "\"shape\":[1152921504606846976]");
          }).find(".shape") != std::string::npos);
    CHECK(told([](B b) { b.replace("[40,5]", "[18446744073709551615,18446744073709551615]"); }) ==
          "motions.shape");
    CHECK(told([](B b) { b.replace("[40,5]", "[200]"); }) == "motions");
    CHECK(told([](B b) { b.replace("[40,5]", "[40,5,0]"); }) == "motions.shape");
    // A hole at the end, and one in the middle.
    CHECK(told([](B b) { b.data.resize(b.data.size() + 8); }).find("got 8 bytes") == 0);
    CHECK(told([](B b) {
            const std::size_t at = b.header.find("\"random\":");
            b.header.erase(at - 1, b.header.find('}', at) - at + 2);
          }).find(".data_offsets") != std::string::npos);
    // Two that overlap.
    CHECK(told([](B b) {
            b.header.insert(b.header.rfind('}'),
                            ",\"too\":{\"dtype\":\"U8\",\"shape\":[9],\"data_offsets\":[3,12]}");
          }).find(".data_offsets") != std::string::npos);
    CHECK(told([](B b) { b.replace("\"shape\":[4]", "\"shape\":[4.0]"); }) == "random.shape[0]");
    CHECK(told([](B b) { b.replace("\"shape\":[4]", "\"shape\":[-4]"); }) == "random.shape[0]");
    CHECK(told([](B b) { b.replace("\"shape\":[4]", "\"shape\":[[4]]"); }) == "random.shape[0]");
    CHECK(told([](B b) { b.replace("\"shape\":[4]", "\"shape\":" + std::string(100000, '[')); }) ==
          "random.shape[0]");
    CHECK(told([](B b) { b.header[0] = '\xef'; }) == "header");
    CHECK(told([](B b) { b.header.back() = '\0'; }) == "header");
    CHECK(told([](B b) { b.header.back() = 'x'; }) == "header");
  }
  SUBCASE("about sizes") {
    CHECK(told([](B b) { b.set_entry("situations", "1152921504606846976"); }) == "situation");
    CHECK(told([](B b) { b.set_entry("situations", "-1"); }) == "situations");
    CHECK(told([](B b) { b.set_entry("effective", "1152921504606846976"); }) == "orientation");
    CHECK(told([](B b) { b.set_entry("motion_count", "65535"); }) == "motions");
    CHECK(told([](B b) { b.set_entry("motion_count", "65536"); }) == "LearnerConfig.motion_count");
  }
  SUBCASE("about the method") {
    CHECK(told([](B b) { b.set_entry("eta", "nan"); }) == "LearnerConfig.eta");
    CHECK(told([](B b) { b.set_entry("eta", "0.05 "); }) == "eta");
    CHECK(told([](B b) { b.set_entry("on_negative", "forget"); }) == "on_negative");
    CHECK(told([](B b) { b.set("orientation", 0, nan); }) == "memory.orientation[0]");
    CHECK(told([](B b) { b.set("orientation", 1, 1.5); }) == "memory.orientation[1]");
    CHECK(told([](B b) { b.set("orientation", 0, 0.001); }).find("memory.orientation") == 0);
    CHECK(told([](B b) { b.set("motions", 7, std::uint16_t{9}); }) == "memory.motions[1]");
    CHECK(told([](B b) { b.set("effective_count", 2, std::uint16_t{60000}); }).find("memory.") ==
          0);
    CHECK(told([](B b) { b.set("times_learned", 3, std::uint32_t{0}); }) ==
          "memory.times_learned[3]");
    CHECK(told([](B b) { b.set("situation", 4, std::int64_t{-7}); }) == "memory.situation[4]");
    CHECK(told([](B b) {
            for (std::size_t i = 0; i < 4; ++i) b.set("random", i, std::uint64_t{0});
          }) == "random");
  }
}

TEST_CASE("a learner in hand is as it was after a refusal") {
  Learner learner = experienced();
  const std::vector<std::byte> before = to_bytes(learner);
  CHECK_THROWS_AS(learner = load_learner(before.data(), before.size() / 2), FileError);
  CHECK(to_bytes(learner) == before);
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

TEST_CASE("motions that are missing are missed where 32 bits cannot count them, too") {
  LearnerState state;
  state.config.motion_count = 32768;
  const std::size_t situations = 131072;  // times motion_count: 2^32
  state.random = Random(1, "world").state();
  state.memory.situation.resize(situations);
  state.memory.effective_count.resize(situations);
  state.memory.ineffective_count.resize(situations);
  CHECK(refusal(state) == "memory.motions");
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
