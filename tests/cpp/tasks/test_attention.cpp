#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "core/field_laws.hpp"
#include "devlearn/attention.hpp"
#include "devlearn/error.hpp"
#include "devlearn/iac.hpp"
#include "devlearn/random.hpp"

using namespace devlearn;
using Zone = Attention::Zone;

namespace {

// The motion of these wheel speeds and about this frequency.
int motion_of(const Attention& task, double left, double right, double frequency) {
  int found = 0;
  double least = 1e9;
  for (int motion = 0; motion < task.motion_count(); ++motion) {
    const double* const row = task.motors().row(motion);
    const double off =
        std::abs(row[0] - left) + std::abs(row[1] - right) + std::abs(row[2] - frequency);
    if (off >= least) continue;
    found = motion;
    least = off;
  }
  return found;
}

double apart(const Attention& task) {
  return std::hypot(task.robot().x - task.toy().x, task.robot().y - task.toy().y);
}

template <class Call>
void check_refusal(Call call, const std::string& quantity) {
  CAPTURE(quantity);
  try {
    call();
    FAIL_CHECK("expected InvalidValue");
  } catch (const InvalidValue& error) {
    CHECK(error.quantity() == quantity);
  }
}

AttentionConfig without_noise() {
  AttentionConfig config;
  config.noise = 0.0;
  return config;
}

}  // namespace

TEST_CASE("every setting of Attention is described, compared and refused beyond its bounds") {
  field_laws::check_fields<AttentionConfig>();
}

TEST_CASE("motions are all of (l, r, f), and a third of them in each of the paper's zones") {
  const Attention task;
  CHECK(task.motion_count() == 5 * 5 * 9);
  std::set<std::vector<double>> different;
  int count[3] = {};
  for (int motion = 0; motion < task.motion_count(); ++motion) {
    const double* const row = task.motors().row(motion);
    different.insert({row[0], row[1], row[2]});
    for (const int wheel : {0, 1}) CHECK(std::abs(row[wheel]) <= 1.0);
    // f1 = [0; 0.33], f2 = [0.34; 0.66], f3 = [0.67; 1]
    const Zone zone = row[2] <= 0.33                     ? Zone::kRandom
                      : row[2] >= 0.34 && row[2] <= 0.66 ? Zone::kStays
                                                         : Zone::kJumps;
    CHECK(task.zone(motion) == zone);
    ++count[static_cast<int>(zone)];
  }
  CHECK(different.size() == 225);
  for (const int of_zone : count) CHECK(of_zone == 75);
}

TEST_CASE("a toy that stays is as far as the way of two wheels leads") {
  Attention task(without_noise());
  const int ahead = motion_of(task, 1.0, 1.0, 0.5), turn = motion_of(task, -1.0, 1.0, 0.5);
  int inside = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    task.begin(seed);
    const Pose before = task.robot();
    const Point toy = task.toy();
    const double angle = before.heading * 3.14159265358979323846 / 180.0;
    const double x = before.x + 0.1 * std::cos(angle), y = before.y + 0.1 * std::sin(angle);
    task.step(ahead);
    CHECK(task.toy() == toy);
    CHECK(task.distance() == doctest::Approx(apart(task)));
    if (x < 0.0 || x > 1.0 || y < 0.0 || y > 1.0) continue;
    ++inside;
    CHECK(task.robot().x == doctest::Approx(x));
    CHECK(task.robot().y == doctest::Approx(y));
    CHECK(task.robot().heading == doctest::Approx(before.heading));
    task.step(turn);  // 2 x 0.1 m of way between wheels 0.2 m apart: 1 rad
    const double turned = std::remainder(task.robot().heading - before.heading, 360.0);
    CHECK(turned == doctest::Approx(180.0 / 3.14159265358979323846));
    CHECK(task.robot().x == doctest::Approx(x));
  }
  CHECK(inside > 30);
}

TEST_CASE("a toy that is called is at the robot, and one that moves at random anywhere") {
  Attention task(without_noise());
  task.begin(3);
  const int call = motion_of(task, 0.5, 1.0, 0.9), scatter = motion_of(task, 0.5, 1.0, 0.1);
  double x = 0.0, y = 0.0, xx = 0.0, lag = 0.0, last = 0.0;
  constexpr int kSteps = 2000;
  for (int i = 0; i < kSteps; ++i) {
    task.step(call);
    CHECK(task.distance() == 0.0);
    task.step(scatter);
    const Point toy = task.toy();
    x += toy.x / kSteps;
    y += toy.y / kSteps;
    xx += (toy.x - 0.5) * (toy.x - 0.5) / kSteps;
    lag += (toy.x - 0.5) * last / kSteps;
    last = toy.x - 0.5;
    CHECK(task.robot().x >= 0.0);
    CHECK(task.robot().x <= 1.0);
  }
  // Uniform: mean 1/2, variance 1/12, none of it told by where it was.
  CHECK(x == doctest::Approx(0.5).epsilon(0.05));
  CHECK(y == doctest::Approx(0.5).epsilon(0.05));
  CHECK(xx == doctest::Approx(1.0 / 12.0).epsilon(0.1));
  CHECK(std::abs(lag) < 0.1 / 12.0);
}

TEST_CASE("what is sensed has the noise that was asked for") {
  AttentionConfig config;
  config.noise = 0.03;
  Attention task(config);
  task.begin(5);
  const int call = motion_of(task, 1.0, 1.0, 0.9);
  double squares = 0.0;
  for (int i = 0; i < 4000; ++i) {
    task.step(call);
    squares += task.distance() * task.distance() / 4000;
    CHECK(task.observation().senses[0] == task.distance());
  }
  CHECK(std::sqrt(squares) == doctest::Approx(0.03).epsilon(0.05));
}

TEST_CASE("an episode follows from its seed and ends after its steps") {
  AttentionConfig config;
  config.steps = 300;
  Attention task(config), twin(config);
  check_refusal([&] { static_cast<void>(task.observation()); }, "observation");
  check_refusal([&] { task.step(0); }, "step");
  task.begin(7);
  twin.begin(3);
  twin.step(4);
  twin.begin(7);
  Random random(1, "motions");
  for (int i = 1; i <= 300; ++i) {
    CHECK(!task.succeeded());
    const int motion = static_cast<int>(random.index(225));
    const Outcome outcome = task.step(motion);
    CHECK(twin.step(motion).situation == outcome.situation);
    CHECK(twin.distance() == task.distance());
    CHECK(outcome.arrived == (i == 300));
    CHECK(outcome.reward() == 0.0);
    if (i < 300) CHECK(task.observation().situation == outcome.situation);
    const double tenths = std::floor(10.0 * std::max(0.0, task.distance()));
    CHECK(outcome.situation == std::min(14.0, tenths));
  }
  CHECK(task.succeeded());
  check_refusal([&] { task.step(0); }, "step");
  task.begin(8);
  check_refusal([&] { task.step(-1); }, "motion");
  check_refusal([&] { task.step(225); }, "motion");
  CHECK(task.distance() != twin.distance());
}

// The published order (section VI, figure 4), with the margins of docs/who_is_who/iac.md.
TEST_CASE("attention goes to what is easy, then to what is harder, and not to what is unknowable") {
  constexpr int kSeeds = 10;
  double share[3][3] = {};  // of the three spans of steps, in the three zones
  for (std::uint64_t seed = 100; seed < 100 + kSeeds; ++seed) {
    Attention task;
    IacConfig config;
    config.smoothing = 100;
    config.window = 150;
    Iac agent(config, seed, task.motors());
    task.begin(seed);
    for (int step = 1; step <= 2000; ++step) {
      const int motion = agent.choose(task.observation()).motion;
      agent.observe(task.step(motion));
      const auto zone = static_cast<int>(task.zone(motion));
      if (step <= 250) share[0][zone] += 1.0 / (250 * kSeeds);
      if (step > 250 && step <= 750) share[1][zone] += 1.0 / (500 * kSeeds);
      if (step > 1000) share[2][zone] += 1.0 / (1000 * kSeeds);
    }
    const std::vector<IacRegion> regions = agent.regions();
    CHECK(regions[1].since == 251);
    CHECK(regions[0].split_dimension == 3);  // the frequency
  }
  for (const double of_zone : share[0]) CHECK(of_zone == doctest::Approx(1.0 / 3.0).epsilon(0.15));
  const double* const early = share[1];
  CHECK(early[2] > 0.5);
  CHECK(early[2] > early[1] + 0.2);
  CHECK(early[2] > early[0] + 0.2);
  const double* const late = share[2];
  CHECK(late[1] > 0.5);
  CHECK(late[1] > late[2] + 0.2);
  CHECK(late[1] > late[0] + 0.2);
  CHECK(early[0] < 0.25);
  CHECK(late[0] < 0.25);
}
