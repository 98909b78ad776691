#include <doctest/doctest.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "devlearn/error.hpp"
#include "loop/config_file.hpp"

using namespace devlearn;

namespace {

const std::string kPath = std::string(DEVLEARN_BINARY_DIR) + "/config.json";

TrialConfig loaded(const std::string& text) {
  std::ofstream(kPath, std::ios::binary) << text;
  return load_config(kPath);
}

// What is refused, and with what: "field: got ...; expected ...".
std::string refusal(const std::string& text) {
  try {
    loaded(text);
  } catch (const FileError& error) {
    CHECK(error.file() == kPath);
    return std::string(error.what()).substr(kPath.size() + 2);
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a configuration's file says any fields, and leaves the others at their defaults") {
  CHECK(loaded("{}") == TrialConfig{});
  CHECK(loaded(R"({"learner": {}, "robot": {"track": null}})") == TrialConfig{});
  TrialConfig config;
  std::get<LearnerConfig>(config.learner).motion_count = 2;
  std::get<LearnerConfig>(config.learner).sigma = 0.25;
  std::get<LearnerConfig>(config.learner).when_exhausted = WhenExhausted::kWander;
  config.evaluation.a3 = 4.0;
  config.robot.track = 0.3;
  config.robot.steering_angles = {-45.0, 45.5};
  config.clearance_source = ClearanceSource::kSonar;
  config.walls_count = true;
  config.heading_bins = 7;
  CHECK(loaded(R"({
    "learner": {"motion_count": 2, "sigma": 0.25, "when_exhausted": "wander"},
    "evaluation": {"a3": 4},
    "robot": {"track": 3e-1, "steering_angles": [-45, 45.5]},
    "clearance_source": "sonar", "walls_count": true, "heading_bins": 7
  })") == config);
}

TEST_CASE("a configuration's file is refused by the path of its field, with what may stand there") {
  const auto check = [](const std::string& text, const std::string& says) {
    const std::string found = refusal(text);
    CAPTURE(text);
    CAPTURE(found);
    CHECK(found.rfind(says, 0) == 0);
  };
  check(R"({"learner": {"sigma": "x"}})", "learner.sigma: got \"x\"; expected in (0, 1)");
  check(R"({"learner": {"sigma": 7}})", "learner.sigma: got 7; expected in (0, 1)");
  check(R"({"learner": {"sigma": 0.1, "sigma": 0.1}})", "learner.sigma: got the field again");
  check(R"({"learner": {"sigmas": 0.1}})", "learner.sigmas: got an unknown field; expected one of");
  check(R"({"learner": {"motion_count": -1}})", "learner.motion_count: got -1; expected a whole");
  check(R"({"learner": {"motion_count": 18446744073709551615}})", "learner.motion_count: got 184");
  check(R"({"learner": {"on_negative": "x"}})",
        "learner.on_negative: got \"x\"; expected 'abandon'");
  check(R"({"learner": {"on_negative": 0}})", "learner.on_negative: got 0; expected 'abandon' or");
  check(R"({"learner": 1})", "learner: got 1; expected an object");
  check(R"({"heading_bins": true})",
        "heading_bins: got true; expected a whole number in [1, 3600]");
  check(R"({"heading_bins": 12.5})", "heading_bins: got 12.5; expected a whole number in");
  check(R"({"goal_radius": true})", "goal_radius: got true; expected in (0, 100] m");
  check(R"({"goal_radius": 1e999})", "goal_radius: got number overflow");
  check(R"({"walls_count": 1})", "walls_count: got 1; expected true or false");
  check(R"({"robot": {"steering_angles": [0, "x"]}})", "robot.steering_angles[1]: got \"x\"");
  check(R"({"robot": {"steering_angles": []}})", "robot.steering_angles: got an array of 0");
  check(R"({"robot": {"track": false}})", "robot.track: got false; expected in (0, 10] m, or none");
  check(R"({"robot": {"track": 0}})", "robot.track: got 0; expected in (0, 10] m, or none");
  // Laws of several fields.
  check(R"({"robot": {"speed": 10, "sample_time": 10}})", "RobotDef.");
  check(R"({"learner": {"motion_count": 3}})",
        "TrialConfig.learner.motion_count: got 3; expected 5");
  std::remove(kPath.c_str());
  try {
    load_config(kPath);
    FAIL_CHECK("loaded");
  } catch (const FileError& error) {
    CHECK(error.file() == kPath);
  }
}
