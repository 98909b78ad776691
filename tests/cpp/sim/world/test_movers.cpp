#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "devlearn/error.hpp"
#include "devlearn/random.hpp"
#include "devlearn/robot.hpp"
#include "devlearn/world.hpp"
#include "sim/world/random_movers.hpp"
#include "world/movers.hpp"

using namespace devlearn;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

WorldDef with(const Mover& mover) {
  WorldDef def;
  def.movers = {mover};
  return def;
}

Mover on_path(std::vector<Point> points, double speed, MoverPath::Then then) {
  return {Circle{{}, 0.2}, MoverPath{std::move(points), speed, then}};
}

Point place(const World& world, double time) { return centre_of(world.movers_at(time).at(0)); }

double apart(Point a, Point b) { return std::hypot(a.x - b.x, a.y - b.y); }

void check_refused(const WorldDef& def, const std::string& quantity, const std::string& told) {
  CAPTURE(quantity);
  try {
    World{def};
    FAIL_CHECK("accepted");
  } catch (const InvalidValue& error) {
    CHECK(error.quantity() == quantity);
    const std::string message = error.what();
    CAPTURE(message);
    CHECK(message.find(told) != std::string::npos);
  }
}

}  // namespace

TEST_CASE("A mover goes along its points at its speed, then back, around, or no further") {
  const std::vector<Point> points{{1, 3}, {4, 3}, {4, 4}};  // 3 m, 1 m, and sqrt(10) m back
  const double around = 4.0 + std::sqrt(10.0);
  using Then = MoverPath::Then;
  const World back(with(on_path(points, 0.5, Then::kBack)));
  const World ring(with(on_path(points, 0.5, Then::kAround)));
  const World stop(with(on_path(points, 0.5, Then::kStop)));
  for (const World* world : {&back, &ring, &stop}) {
    CHECK(apart(place(*world, 0.0), {1, 3}) < 1e-12);
    CHECK(apart(place(*world, 2.0), {2, 3}) < 1e-12);
    CHECK(apart(place(*world, 6.0), {4, 3}) < 1e-12);
    CHECK(apart(place(*world, 7.0), {4, 3.5}) < 1e-12);
    CHECK(apart(place(*world, 8.0), {4, 4}) < 1e-12);
  }
  for (const double turns : {0.0, 1.0, 7.0, 1e6}) {
    CHECK(apart(place(back, 16.0 * turns + 9.0), {4, 3.5}) < 1e-6);
    CHECK(apart(place(back, 16.0 * turns + 12.0), {3, 3}) < 1e-6);
    CHECK(apart(place(ring, 2.0 * around * turns + 2.0), {2, 3}) < 1e-6);
    const double homeward = 1.0 / std::sqrt(10.0);  // a metre of it
    CHECK(apart(place(ring, 2.0 * around * turns + 10.0), {4 - 3 * homeward, 4 - homeward}) < 1e-6);
    CHECK(apart(place(stop, 8.0 + turns), {4, 4}) < 1e-12);
  }
}

TEST_CASE("A walk goes straight and evenly from point to point of its box, uniform in it") {
  MoverWalk walk;
  walk.seed = 5;
  walk.low = {1, 2};
  walk.high = {4, 4};
  walk.leg_time = 8.0;
  const World world(with({Circle{{}, 0.1}, walk}));
  Point sum{};
  constexpr int kLegs = 4000;
  for (int leg = 0; leg < kLegs; ++leg) {
    const Point a = place(world, 8.0 * leg), b = place(world, 8.0 * (leg + 1));
    const Point middle = place(world, 8.0 * leg + 2.0);
    CHECK(apart(middle, {0.75 * a.x + 0.25 * b.x, 0.75 * a.y + 0.25 * b.y}) < 1e-9);
    REQUIRE(a.x >= 1.0);
    REQUIRE(a.x <= 4.0);
    REQUIRE(a.y >= 2.0);
    REQUIRE(a.y <= 4.0);
    sum = {sum.x + a.x / kLegs, sum.y + a.y / kLegs};
  }
  // Three standard errors of the mean of a uniform number.
  CHECK(std::abs(sum.x - 2.5) < 3.0 * 3.0 / std::sqrt(12.0 * kLegs));
  CHECK(std::abs(sum.y - 3.0) < 3.0 * 2.0 / std::sqrt(12.0 * kLegs));
  walk.seed = 6;
  CHECK(apart(place(World(with({Circle{{}, 0.1}, walk})), 4.0), place(world, 4.0)) > 1e-3);
  // Nor is one seed's walk a later part of another's.
  const World next(with({Circle{{}, 0.1}, walk}));
  for (int leg = 0; leg < 8; ++leg) {
    CHECK(apart(place(next, 0.0), place(world, 8.0 * leg)) > 1e-3);
  }
}

TEST_CASE("Whatever its course, a mover is never faster than 1 m/s and its centre in the arena") {
  Random random(1, "speeds");
  for (int n = 0; n < 300; ++n) {
    const World world = random_moving_world(random, 0, 1, 5.0);
    for (int i = 0; i < 50; ++i) {
      const double time = between(random, 0.0, i % 2 == 0 ? 100.0 : 1e7);
      const Point now = place(world, time), later = place(world, time + 0.01);
      REQUIRE(apart(now, later) <= 0.01 + 1e-8);
      REQUIRE(std::min({now.x, now.y, 5.0 - now.x, 5.0 - now.y}) >= 0.0);
    }
  }
}

TEST_CASE(
    "At any time, distances and echoes are those of a world in which the movers stand there") {
  Random random(2, "frozen");
  double worst = 0.0, worst_echo = 0.0;
  long echoes = 0, heard = 0, past_corners = 0;
  for (int n = 0; n < 60; ++n) {
    const World world = random_moving_world(random, 4, 4, 3.0);
    const Robot robot(world, {}), alone(world.standing(), {});
    for (int i = 0; i < 30; ++i) {
      const double time = between(random, 0.0, 500.0);
      std::optional<World> still;
      try {
        still = frozen(world, time);
      } catch (const InvalidValue&) {
        continue;  // a mover over the target
      }
      const Point p = point_in(random, 3.0);
      for (const bool walls : {false, true}) {
        worst =
            std::max(worst, std::abs(world.clearance(p, walls, time) - still->clearance(p, walls)));
      }
      auto pose = free_pose(random, *still, 0.1);
      if (!pose) continue;
      pose->heading = between(random, 0.0, 360.0);
      const std::vector<double> here = robot.sonar(*pose, time),
                                expected = Robot(*still, {}).sonar(*pose);
      const std::vector<double> without = alone.sonar(*pose, time);
      for (std::size_t k = 0; k < here.size(); ++k) {
        ++echoes;
        heard += here[k] < without[k];
        // A float ray may pass a corner on the other side.
        const double error = std::abs(here[k] - expected[k]);
        past_corners += error > 1e-3;
        if (error <= 1e-3) worst_echo = std::max(worst_echo, error);
      }
    }
  }
  MESSAGE(echoes << " echoes, " << heard << " of movers; off by at most " << worst_echo << " m");
  CHECK(worst < 1e-12);
  CHECK(worst_echo < 2e-5);
  CHECK(past_corners * 1000 < echoes);
  CHECK(heard > 500);
}

TEST_CASE("Inside a mover that went over the robot, every echo is nearness itself") {
  const World world(
      with({Circle{{}, 0.5}, MoverPath{{{1, 3}, {4, 3}}, 0.1, MoverPath::Then::kBack}}));
  const Robot robot(world, {});
  for (const double echo : robot.sonar({2.0, 3.1, 0.0}, 10.0)) CHECK(echo == 0.0);
  CHECK(robot.sonar({2.0, 3.1, 0.0}, 60.0)[0] > 0.0);
}

TEST_CASE(
    "What keeps clear of movers within a step is further than that at every moment, and only "
    "that") {
  Random random(3, "sweeps");
  long clear = 0, met = 0;
  for (int n = 0; n < 3000; ++n) {
    const World world = random_moving_world(random, 0, 1, 3.0);
    const Point p = point_in(random, 3.0);
    const Point q{p.x + between(random, -0.5, 0.5), p.y + between(random, -0.5, 0.5)};
    const TimeSpan step{between(random, 0.0, 100.0), between(random, 0.1, 1.0)};
    const double room = between(random, 0.01, 1.0);
    // The mover's way within a step is straight.
    const Point from = place(world, step.begin), to = place(world, step.end());
    double least = std::numeric_limits<double>::infinity();
    constexpr int kMoments = 400;
    for (int i = 0; i <= kMoments; ++i) {
      const double part = static_cast<double>(i) / kMoments;
      const auto at = [part](double a, double b) { return a + part * (b - a); };
      const Point seen{at(p.x, q.x) - at(from.x, to.x) + place(world, 0.0).x,
                       at(p.y, q.y) - at(from.y, to.y) + place(world, 0.0).y};
      least = std::min(least, world.clearance(seen, false, 0.0));
    }
    const bool keeps = world.movers().keep_clear_of(p, q, room, step);
    (keeps ? clear : met) += 1;
    const double between_moments = 2.0 * 1.5 / kMoments;
    if (keeps) REQUIRE(least > room - 1e-9);
    if (!keeps) REQUIRE(least <= room + between_moments);
  }
  CHECK(clear > 300);
  CHECK(met > 300);
}

TEST_CASE("A course over the start is refused, one that passes it is not") {
  using Then = MoverPath::Then;
  // The start is (0.5, 0.5), the mover's radius 0.2.
  CHECK_NOTHROW(World(with(on_path({{0.2, 0.71}, {4, 0.71}}, 0.1, Then::kBack))));
  check_refused(with(on_path({{0.2, 0.69}, {4, 0.69}}, 0.1, Then::kBack)), "movers[0]",
                "over the start, (0.5, 0.5)");
  // Around leads over it, back does not.
  CHECK_NOTHROW(World(with(on_path({{0.1, 1.5}, {4, 1.5}, {1.5, 0.1}}, 0.1, Then::kBack))));
  check_refused(with(on_path({{0.1, 0.9}, {4, 1.5}, {0.9, 0.1}}, 0.1, Then::kAround)), "movers[0]",
                "over the start");
  const Rectangle thin{{}, 1.0, 0.02, 45.0};
  CHECK_NOTHROW(World(with({thin, MoverPath{{{1.2, 0.7}, {1.2, 4}}, 0.1, Then::kBack}})));
  check_refused(with({thin, MoverPath{{{0.8, 0.7}, {0.8, 4}}, 0.1, Then::kBack}}), "movers[0]",
                "over the start");
  // A walk may lead anywhere in its box.
  CHECK_NOTHROW(World(with({Circle{{}, 0.2}, MoverWalk{1, {0.71, 0.2}, {4, 4}, 20}})));
  check_refused(with({Circle{{}, 0.2}, MoverWalk{1, {0.69, 0.2}, {4, 4}, 20}}), "movers[0]",
                "over the start");
  check_refused(with({Circle{{}, 0.2}, MoverWalk{1, {0.1, 0.2}, {4, 4}, 20}}), "movers[0]",
                "over the start");
  const World world(with({Circle{{}, 0.2}, MoverWalk{1, {0.71, 0.2}, {4, 4}, 20}}));
  CHECK_THROWS_AS(world.with_start({1.0, 1.0, 0.0}), InvalidValue);
}

TEST_CASE("Where a mover ever comes is no nearer than at any time, and its course comes so near") {
  Random random(4, "ever");
  for (int n = 0; n < 200; ++n) {
    const World world = random_moving_world(random, 0, 1, 5.0);
    const Point p = point_in(random, 5.0);
    const double ever = world.movers().distance_ever(0, p);
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 2000; ++i) {
      least = std::min(least, world.clearance(p, false, between(random, 0.0, 20000.0)));
    }
    REQUIRE(ever <= least + 1e-9);
    if (std::holds_alternative<MoverPath>(world.def().movers[0].course) &&
        std::get<MoverPath>(world.def().movers[0].course).then != MoverPath::Then::kStop) {
      CHECK(ever > least - 0.3);
    }
  }
}

TEST_CASE("A mover out of range is refused by the name of its field") {
  using Then = MoverPath::Then;
  const auto path = [](std::vector<Point> points, double speed, Then then = Then::kBack) {
    return with(on_path(std::move(points), speed, then));
  };
  check_refused(path({}, 0.1), "movers[0].path.points", "2 to 10000");
  check_refused(path({{1, 3}}, 0.1), "movers[0].path.points", "got 1 points");
  check_refused(path(std::vector<Point>(10001, Point{1, 3}), 0.1), "movers[0].path.points",
                "10001 points");
  check_refused(path({{1, 3}, {1.005, 3}}, 0.1), "movers[0].path.points[1]", "0.01 m apart");
  check_refused(path({{1, 3}, {4, 3}, {1, 3}}, 0.1, Then::kAround), "movers[0].path.points[0]",
                "0 m from the point before");
  CHECK_NOTHROW(World(path({{1, 3}, {4, 3}, {1, 3}}, 0.1)));
  for (const double bad : {0.0, -0.1, 1.001, kNan}) {
    check_refused(path({{1, 3}, {4, 3}}, bad), "movers[0].path.speed", "1] m/s");
  }
  check_refused(path({{1, 3}, {5.1, 3}}, 0.1), "movers[0].path.points[1][0]", "[0, 5] m");
  check_refused(path({{1, -0.1}, {4, 3}}, 0.1), "movers[0].path.points[0][1]", "[0, 5] m");
  check_refused(path({{1, kNan}, {4, 3}}, 0.1), "movers[0].path.points[0][1]", "nan");

  const auto walk = [](Point low, Point high, double leg_time) {
    return with({Circle{{}, 0.1}, MoverWalk{1, low, high, leg_time}});
  };
  check_refused(walk({1, 2}, {5.1, 4}, 20), "movers[0].walk.high[0]", "[0, 5] m");
  check_refused(walk({1, -2}, {4, 4}, 20), "movers[0].walk.low[1]", "[0, 5] m");
  check_refused(walk({1, 4}, {4, 2}, 20), "movers[0].walk.high", "no less than low, (1, 4)");
  check_refused(walk({1, 1}, {4, 5}, 4.9), "movers[0].walk.leg_time", "at least 5 s");
  CHECK_NOTHROW(World(walk({1, 1}, {4, 5}, 5.0)));
  CHECK_NOTHROW(World(walk({2, 2}, {2, 2}, 0.1)));
  for (const double bad : {0.0, 0.09, -1.0, 1.1e6, kNan}) {
    check_refused(walk({2, 2}, {2, 2}, bad), "movers[0].walk.leg_time", "[0.1, 1e+06] s");
  }
  check_refused(walk({kNan, 2}, {4, 4}, 20), "movers[0].walk.low[0]", "nan");

  const MoverPath good{{{1, 3}, {4, 3}}, 0.1, Then::kBack};
  check_refused(with({Circle{{}, 0.0}, good}), "movers[0].radius", "[0.01, 1000] m");
  check_refused(with({Rectangle{{}, 0.1, 0.0, 0.0}, good}), "movers[0].size[1]", "[0.01, 1000] m");
  check_refused(with({Circle{{1, 3}, 0.2}, good}), "movers[0].center", "(0, 0)");
  WorldDef many;
  many.movers.assign(1001, Mover{Circle{{}, 0.1}, good});
  check_refused(many, "movers", "at most 1000");
}

TEST_CASE("A world with movers written as JSON reads back equal to the bit") {
  Random random(5, "movers as text");
  for (int n = 0; n < 100; ++n) {
    const World world = random_moving_world(random, 2, 3, between(random, 2.0, 20.0));
    const World back = World::parse(world.to_json());
    CHECK(back.to_json() == world.to_json());
    for (const double time : {0.0, 1.5, 1e5}) {
      for (std::size_t i = 0; i < 3; ++i) {
        CHECK(centre_of(back.movers_at(time)[i]) == centre_of(world.movers_at(time)[i]));
      }
    }
  }
  CHECK(World().to_json().find("movers") == std::string::npos);
  const World world = random_moving_world(random, 2, 3, 5.0);
  CHECK(world.standing().to_json().find("movers") == std::string::npos);
  CHECK(world.standing().def().obstacles.size() == 2);
}

TEST_CASE("A file with movers that breaks the format is refused by the path of its field") {
  const std::string good =
      World(with(on_path({{1, 3}, {4, 3}}, 0.1, MoverPath::Then::kStop))).to_json();
  const std::string walking =
      World(with({Rectangle{{}, 0.3, 0.2, 10.0}, MoverWalk{7, {2, 2}, {4, 4}, 9}})).to_json();
  const auto refused = [](std::string text, const std::string& part, const std::string& by,
                          const std::string& field) {
    const std::size_t at = text.find(part);
    CAPTURE(text);
    REQUIRE(at != std::string::npos);
    text.replace(at, part.size(), by);
    try {
      World::parse(text);
      FAIL_CHECK("accepted");
    } catch (const FileError& error) {
      CHECK(error.field() == field);
    }
  };
  refused(good, R"("radius": 0.2)", R"("center": [1, 3], "radius": 0.2)", "movers[0].center");
  refused(good, R"("shape": "circle")", R"("shape": "polygon")", "movers[0].shape");
  refused(good, R"("path")", R"("way")", "movers[0].way");
  refused(good, R"(, "path": {)", R"(, "walk": {}, "path": {)", "movers[0].walk");
  refused(good, R"("then": "stop")", R"("then": "halt")", "movers[0].path.then");
  refused(good, R"(, "then": "stop")", "", "movers[0].path.then");
  refused(good, R"("speed": 0.1)", R"("speed": 2)", "movers[0].path.speed");
  refused(good, "[4, 3]", "[6, 3]", "movers[0].path.points[1][0]");
  refused(walking, R"("seed": 7)", R"("seed": -7)", "movers[0].walk.seed");
  refused(walking, R"("seed": 7)", R"("seed": 7.5)", "movers[0].walk.seed");
  refused(walking, R"("leg_time": 9)", R"("leg_time": 1)", "movers[0].walk.leg_time");
  refused(walking, R"("low")", R"("least")", "movers[0].walk.least");
  refused(walking, R"("size": [0.3, 0.2])", R"("size": [0.3])", "movers[0].size");
}
