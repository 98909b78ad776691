#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "devlearn/error.hpp"
#include "devlearn/math.hpp"
#include "devlearn/random.hpp"
#include "devlearn/robot.hpp"
#include "many.hpp"
#include "sim/body/plain.hpp"
#include "sim/world/random_worlds.hpp"

using namespace devlearn;

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

Pose moved(const Pose& pose, double turn, double length) {
  const double heading = std::fmod(std::fmod(pose.heading + turn, 360.0) + 360.0, 360.0);
  const double radians = heading * 3.14159265358979323846 / 180.0;
  return {pose.x + length * std::cos(radians), pose.y + length * std::sin(radians), heading};
}

double apart(const Pose& a, const Pose& b) { return std::hypot(a.x - b.x, a.y - b.y); }

// Along a ray from p in the direction (c, s), the distance to the nearest obstacle or wall; its own
// arithmetic, from the definition alone.
double ray_distance(const WorldDef& def, Point p, double c, double s) {
  double nearest = kInfinite;
  const auto side = [&](Point a, Point b) {
    // p + t (c, s) = a + u (b - a), by Cramer's rule.
    const double ex = b.x - a.x, ey = b.y - a.y, det = s * ex - c * ey;
    if (det == 0.0) return;
    const double t = ((a.y - p.y) * ex - (a.x - p.x) * ey) / det;
    const double u = (c * (a.y - p.y) - s * (a.x - p.x)) / det;
    if (t >= 0.0 && u >= 0.0 && u <= 1.0) nearest = std::min(nearest, t);
  };
  const auto way = [&](const std::vector<Point>& points) {
    for (std::size_t i = 1; i < points.size(); ++i) side(points[i - 1], points[i]);
  };
  const auto outline = [&](const std::vector<Point>& corners) {
    way(corners);
    side(corners.back(), corners.front());
  };
  const Point low = def.origin, high = def.far_corner();
  outline({low, {high.x, low.y}, high, {low.x, high.y}});
  for (const Obstacle& obstacle : def.obstacles) {
    if (const auto* circle = std::get_if<Circle>(&obstacle)) {
      const double dx = circle->center.x - p.x, dy = circle->center.y - p.y;
      const double along = dx * c + dy * s, aside = dx * s - dy * c;
      const double half = circle->radius * circle->radius - aside * aside;
      if (half >= 0.0 && along >= std::sqrt(half)) {
        nearest = std::min(nearest, along - std::sqrt(half));
      }
    } else if (const auto* box = std::get_if<Rectangle>(&obstacle)) {
      const double angle = box->angle * 3.14159265358979323846 / 180.0;
      std::vector<Point> corners;
      for (const auto& [u, v] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
        const double x = u * box->width, y = v * box->height;
        corners.push_back({box->center.x + x * std::cos(angle) - y * std::sin(angle),
                           box->center.y + x * std::sin(angle) + y * std::cos(angle)});
      }
      outline(corners);
    } else if (const auto* polygon = std::get_if<Polygon>(&obstacle)) {
      outline(polygon->corners);
      for (const auto& hole : polygon->holes) outline(hole);
    } else {
      way(std::get<Polyline>(obstacle).points);
    }
  }
  return nearest;
}

// How sonars compare with closed forms.
struct SonarCheck {
  long rays = 0, wide = 0, wrong = 0, touching = 0;
  double worst = 0.0;

  void compare(const Robot& robot, const Pose& pose) {
    const RobotDef& def = robot.def();
    const std::vector<double> echoes = robot.sonar(pose), angles = def.sonar_angles();
    for (std::size_t i = 0; i < echoes.size(); ++i) {
      const double radians = (pose.heading + angles[i]) * 3.14159265358979323846 / 180.0;
      const double c = std::cos(radians), s = std::sin(radians);
      // A float ray may pass a corner on the other side: the echo lies between those of two rays
      // just beside it.
      double low = kInfinite, high = 0.0;
      for (const double shift : {-1.5e-5, 0.0, 1.5e-5}) {
        const double way =
            ray_distance(robot.world().def(), {pose.x - shift * s, pose.y + shift * c}, c, s);
        const double echo = std::clamp(way - def.radius, 0.0, def.sonar_range);
        low = std::min(low, echo);
        high = std::max(high, echo);
      }
      const double error = std::max({0.0, low - echoes[i], echoes[i] - high});
      ++rays;
      if (high - low > 1e-3) ++wide;
      if (error > 2e-5) ++wrong;
      if (echoes[i] < 1e-3) ++touching;
      worst = std::max(worst, error);
    }
  }
};

}  // namespace

TEST_CASE("Eq. 2 gives the wheels their speeds for the turn and for the drive") {
  RobotDef def;
  const Robot printed(World(), def);
  CHECK(printed.turn_speeds(4).right == doctest::Approx(3.14159265358979 / 3 * 0.1 / (2 * 0.5)));
  CHECK(printed.turn_speeds(4).left == -printed.turn_speeds(4).right);
  CHECK(printed.turn_speeds(0).right == -printed.turn_speeds(4).right);
  CHECK(printed.turn_speeds(2).right == 0.0);
  CHECK(printed.drive_speeds().left == 0.1);
  CHECK(printed.drive_speeds().right == 0.1);
  def.track = 0.3;
  CHECK(Robot(World(), def).turn_speeds(4).right ==
        doctest::Approx(3.0 * printed.turn_speeds(4).right));
  CHECK_THROWS_AS(printed.turn_speeds(5), InvalidValue);
}

TEST_CASE("Sonars look evenly over the field of view from right to left") {
  RobotDef def;
  CHECK(def.sonar_angles() == std::vector<double>{-90, -45, 0, 45, 90});
  def.sonar_count = 1;
  CHECK(def.sonar_angles() == std::vector<double>{0});
  def.sonar_count = 0;
  CHECK(def.sonar_angles().empty());
  def.sonar_count = 4;
  def.sonar_fov = 360;
  CHECK(def.sonar_angles() == std::vector<double>{-180, -90, 0, 90});
}

TEST_CASE("A robot out of range is refused by the name of its field") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const std::string& quantity, auto change) {
    RobotDef def;
    change(def);
    CAPTURE(quantity);
    try {
      def.validate();
      FAIL_CHECK("accepted");
    } catch (const InvalidValue& e) {
      CHECK(e.quantity() == quantity);
    }
    CHECK_THROWS_AS(Robot(World(), def), InvalidValue);
  };
  for (const double bad : {0.009, 10.1, -1.0, nan, kInfinite}) {
    refused("RobotDef.radius", [=](RobotDef& d) { d.radius = bad; });
  }
  for (const double bad : {0.0, 10.1, -1.0, nan, kInfinite}) {
    refused("RobotDef.speed", [=](RobotDef& d) { d.speed = bad; });
    refused("RobotDef.sample_time", [=](RobotDef& d) { d.sample_time = bad; });
  }
  for (const double bad : {10.1, -1.0, nan}) {
    refused("RobotDef.track", [=](RobotDef& d) { d.track = bad; });
  }
  refused("RobotDef.speed * sample_time", [](RobotDef& d) { d.speed = 2.1; });
  refused("RobotDef.steering_angles", [](RobotDef& d) { d.steering_angles.clear(); });
  refused("RobotDef.steering_angles", [](RobotDef& d) { d.steering_angles.resize(65536); });
  for (const double bad : {360.1, nan, kInfinite}) {
    refused("RobotDef.steering_angles[3]", [=](RobotDef& d) { d.steering_angles[3] = bad; });
  }
  for (const int bad : {-1, 721}) {
    refused("RobotDef.sonar_count", [=](RobotDef& d) { d.sonar_count = bad; });
  }
  for (const double bad : {-0.1, 360.1, nan}) {
    refused("RobotDef.sonar_fov", [=](RobotDef& d) { d.sonar_fov = bad; });
  }
  for (const double bad : {0.009, 100.1, nan}) {
    refused("RobotDef.sonar_range", [=](RobotDef& d) { d.sonar_range = bad; });
  }
}

TEST_CASE("A pose where the body does not fit is refused by every call that takes one") {
  WorldDef def;
  def.obstacles = {Circle{{2.0, 2.0}, 0.5}};
  const Robot robot(World(def), {});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> echoes(5);
  const auto refused = [&](const Pose& pose, const std::string& quantity) {
    CAPTURE(quantity);
    for (int call = 0; call < 3; ++call) {
      try {
        if (call == 0) robot.require_place(pose);
        if (call == 1) robot.step(pose, 2);
        if (call == 2) robot.sonar(pose, echoes.data());
        FAIL_CHECK("accepted");
      } catch (const InvalidValue& e) {
        CHECK(e.quantity() == quantity);
      }
    }
  };
  for (const double bad : {-0.1, 5.1, nan, kInfinite, -kInfinite, 1e300}) {
    refused({bad, 1.0, 0.0}, "pose.x");
    refused({1.0, bad, 0.0}, "pose.y");
  }
  for (const double bad : {nan, kInfinite, -kInfinite}) refused({1.0, 1.0, bad}, "pose.heading");
  refused({2.0, 2.0, 0.0}, "pose");
  refused({2.0, 2.594, 0.0}, "pose");
  refused({0.094, 1.0, 0.0}, "pose");
  CHECK_NOTHROW(robot.require_place({2.0, 2.596, 0.0}));
  CHECK_NOTHROW(robot.require_place({0.096, 1.0, 0.0}));
  CHECK_NOTHROW(robot.require_place({1.0, 1.0, 1e308}));
  for (const int bad : {-1, 5}) {
    CHECK_THROWS_AS(robot.step({1, 1, 0}, bad), InvalidValue);
  }
}

TEST_CASE("Free steps are Eq. 1 to 1e-12, and to 1e-5 m where Box2D takes them all the way") {
  Random random(1, "free steps");
  double worst = 0.0, worst_simulated = 0.0;
  int free = 0;
  for (int n = 0; n < 20; ++n) {
    const Robot robot(random_world(random, 10, 5.0), {});
    for (int i = 0; i < 500; ++i) {
      const auto pose = free_pose(random, robot.world(), 0.17);
      if (!pose) continue;
      const int motion = static_cast<int>(random.index(5));
      const Pose expected =
          moved(*pose, robot.def().steering_angles[static_cast<std::size_t>(motion)], 0.05);
      const Robot::Move step = robot.step(*pose, motion);
      CHECK_FALSE(step.collided);
      CHECK(step.pose.heading == expected.heading);
      worst = std::max(worst, apart(step.pose, expected));
      const Robot::Move simulated = plain::simulated(robot, *pose, motion);
      CHECK_FALSE(simulated.collided);
      CHECK(simulated.pose.heading == expected.heading);
      worst_simulated = std::max(worst_simulated, apart(simulated.pose, expected));
      ++free;
    }
  }
  MESSAGE(free << " free steps: off Eq. 1 by at most " << worst << " m, simulated by "
               << worst_simulated << " m");
  CHECK(free > 5000);
  CHECK(worst < 1e-12);
  CHECK(worst_simulated < 1e-5);
}

TEST_CASE("However it is driven at walls, corners and circles, the body stays out of them") {
  Random random(2, "pressing");
  long steps = 0, contacts = 0, stayed = 0, resting = 0;
  double deepest = 0.0;
  for (int n = 0; n < 100; ++n) {
    RobotDef def;
    def.radius = between(random, 0.03, 0.15);
    def.speed = between(random, 0.02, 0.2);
    const Robot robot(random_world(random, 12, 2.5), def);
    const auto start = free_pose(random, robot.world(), def.radius);
    if (!start) continue;
    Pose pose = *start;
    const int substeps =
        std::max(15, static_cast<int>(std::ceil(def.speed * def.sample_time / 0.0034)));
    for (int i = 0; i < 1000; ++i) {
      // Mostly straight on, so that it comes to press and slide.
      const int motion = random.index(4) == 0 ? static_cast<int>(random.index(5)) : 2;
      const Robot::Move step = robot.step(pose, motion);
      ++steps;
      if (step.collided) {
        ++contacts;
        if (apart(step.pose, pose) == 0.0) {
          ++resting;
          if (apart(plain::simulated(robot, pose, motion, substeps).pose, pose) > 0.0) ++stayed;
        }
      }
      const double room = robot.world().clearance({step.pose.x, step.pose.y}, true);
      deepest = std::max(deepest, def.radius - room);
      REQUIRE(room >= def.radius - 0.005);
      REQUIRE(room > 0.0);
      REQUIRE(apart(step.pose, pose) <= def.speed * def.sample_time + 0.01);
      pose = step.pose;
    }
  }
  MESSAGE(steps << " steps, " << contacts << " with contact, " << resting << " at rest, " << stayed
                << " held back; deepest " << deepest << " m");
  CHECK(steps >= 100000);
  CHECK(contacts * 20 >= steps);
  CHECK(stayed * 1000 < steps);
}

TEST_CASE("Nothing gets out of a room of thin walls, however small and fast it is") {
  Random random(7, "thin rooms");
  long steps = 0, contacts = 0, out = 0;
  double deepest = 0.0;
  for (int n = 0; n < many(400); ++n) {
    // Spikes and all, in front of more thin walls.
    std::vector<Point> room = random_ring(random, {2.5, 2.5}, 3 + random.index(6), 0.1, 0.6);
    WorldDef def;
    def.obstacles = {random_polyline(random, {2.7, 2.5}), random_polyline(random, {2.3, 2.4})};
    std::vector<Point> closed = room;
    closed.push_back(room.front());
    def.obstacles.emplace_back(Polyline{closed});
    RobotDef robot_def;
    robot_def.radius = between(random, 0.01, 0.04);
    robot_def.speed = random.index(4) == 0 ? between(random, 0.2, 2.0) : between(random, 0.02, 0.2);
    std::optional<Robot> robot;
    try {
      robot.emplace(World(def), robot_def);
    } catch (const InvalidValue&) {  // corners too close
      continue;
    }
    const auto inside = [&](const Pose& p) {
      bool odd = false;
      for (std::size_t i = 0; i < room.size(); ++i) {
        const Point a = room[i], b = room[(i + 1) % room.size()];
        const double x = a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
        if ((a.y > p.y) != (b.y > p.y) && x > p.x) odd = !odd;
      }
      return odd;
    };
    Pose pose;
    int tries = 0;
    for (; tries < 1000; ++tries) {
      pose = {between(random, 1.9, 3.1), between(random, 1.9, 3.1), 0.0};
      const double clearance = robot->world().clearance({pose.x, pose.y});
      if (inside(pose) && clearance >= robot_def.radius) break;
    }
    if (tries == 1000) continue;
    for (int i = 0; i < 500; ++i, ++steps) {
      const int motion = random.index(3) == 0 ? static_cast<int>(random.index(5)) : 2;
      const Robot::Move step = robot->step(pose, motion);
      contacts += step.collided;
      out += inside(pose) && !inside(step.pose);
      pose = step.pose;
      deepest =
          std::max(deepest, robot_def.radius - robot->world().clearance({pose.x, pose.y}, true));
    }
  }
  MESSAGE(steps << " steps, " << contacts << " with contact, deepest " << deepest << " m");
  CHECK(out == 0);
  CHECK(deepest <= 0.005);
  CHECK(contacts > many(20'000));
}

TEST_CASE("A step is a pure function of world, pose and motion") {
  Random random(3, "purity");
  const World world = random_world(random, 12, 2.5);
  const Robot robot(world, {}), twin(world, {});
  struct Asked {
    Pose pose;
    int motion;
    Robot::Move answer;
  };
  std::vector<Asked> history;
  Pose pose = free_pose(random, world, 0.1).value();
  for (int i = 0; i < 2000; ++i) {
    const int motion = random.index(4) == 0 ? static_cast<int>(random.index(5)) : 2;
    history.push_back({pose, motion, robot.step(pose, motion)});
    pose = history.back().answer.pose;
  }
  const auto agrees = [](const Robot::Move& a, const Robot::Move& b) {
    return a.pose == b.pose && a.collided == b.collided;
  };
  long contacts = 0, differ = 0;
  for (std::size_t i = 0; i < history.size(); ++i) {
    const Asked& asked = history[random.index(static_cast<std::uint32_t>(history.size()))];
    robot.sonar(asked.pose);
    contacts += asked.answer.collided;
    differ += !agrees(robot.step(asked.pose, asked.motion), asked.answer);
    differ += !agrees(twin.step(asked.pose, asked.motion), asked.answer);
  }
  CHECK(contacts > 200);
  CHECK(differ == 0);
}

TEST_CASE("Sonars hear what closed forms say on random worlds") {
  Random random(4, "sonars");
  SonarCheck anywhere, touching;
  for (int n = 0; n < many(100); ++n) {
    RobotDef def;
    def.sonar_count = 1 + static_cast<int>(random.index(24));
    def.sonar_fov = between(random, 0.0, 360.0);
    def.sonar_range = between(random, 0.1, 8.0);
    const Robot robot(random_world(random, 12, between(random, 2.0, 5.0)), def);
    for (int i = 0; i < 100; ++i) {
      auto pose = free_pose(random, robot.world(), def.radius);
      if (!pose) continue;
      pose->heading = between(random, 0.0, 360.0);
      anywhere.compare(robot, *pose);
      // Driven on until it touches something.
      Robot::Move step{*pose, false};
      for (int k = 0; k < 60 && !step.collided; ++k) step = robot.step(step.pose, 2);
      if (step.collided) touching.compare(robot, step.pose);
    }
  }
  for (const SonarCheck* check : {&anywhere, &touching}) {
    MESSAGE(check->rays << " rays, " << check->wide << " past a corner, " << check->touching
                        << " touching, off by at most " << check->worst << " m");
    CHECK(check->wrong == 0);
    CHECK(check->rays > many(20'000));
    CHECK(check->wide * 100 < check->rays);
  }
  CHECK(touching.touching > many(100));
}

TEST_CASE("A sonar hears what touches the rim or reaches into it as nearness itself") {
  WorldDef def;
  def.obstacles = {Circle{{2.0, 2.0}, 0.5}, Rectangle{{4.0, 2.0}, 0.4, 0.4, 0.0}};
  const Robot robot(World(def), {});
  for (const double gap : {-0.0049, -0.001, 0.0, 0.001, 0.3}) {
    CAPTURE(gap);
    const double expected = std::max(0.0, gap);
    const auto ahead = [&](const Pose& pose) { return robot.sonar(pose)[2]; };
    CHECK(ahead({1.4 - gap, 2.0, 0.0}) == doctest::Approx(expected).epsilon(1e-5));
    CHECK(ahead({3.7 - gap, 2.0, 0.0}) == doctest::Approx(expected).epsilon(1e-5));
    CHECK(ahead({0.1 + gap, 3.0, 180.0}) == doctest::Approx(expected).epsilon(1e-5));
    CHECK(ahead({2.0, 4.9 - gap, 90.0}) == doctest::Approx(expected).epsilon(1e-5));
  }
}

TEST_CASE("No sonar ray slips through a corner, wherever it lies and however straight") {
  Random random(5, "corners");
  long leaks = 0;
  for (int n = 0; n < 2000; ++n) {
    const double side = n % 2 == 0 ? 5.0 : 1000.0;
    WorldDef def;
    def.width = def.height = side;
    const Point center = {between(random, 0.45, 0.55) * side, between(random, 0.45, 0.55) * side};
    Polygon disc;
    const int count = 3 + static_cast<int>(random.index(40));
    for (int i = 0; i < count; ++i) {
      const double angle = 2.0 * 3.14159265358979 * i / count;
      disc.corners.push_back({center.x + 0.7 * std::cos(angle), center.y + 0.7 * std::sin(angle)});
    }
    def.obstacles = {disc};
    RobotDef robot_def;
    robot_def.sonar_count = 1;
    const Robot robot(World(def), robot_def);
    for (const Point& corner : disc.corners) {
      // Outwards along the corner's own radius, looking back.
      const double out = between(random, 1.2, 2.0);
      const Pose pose{
          center.x + out * (corner.x - center.x) / 0.7,
          center.y + out * (corner.y - center.y) / 0.7,
          std::atan2(center.y - corner.y, center.x - corner.x) * 180.0 / 3.14159265358979323846};
      const double error = robot.sonar(pose)[0] - (out - 0.7 - 0.1);
      if (std::abs(error) > (side > 5.0 ? 2e-3 : 2e-5)) ++leaks;
    }
  }
  CHECK(leaks == 0);

  const Robot robot(World(), {});
  for (const double at : {0.5, 1.0, 1.3}) {
    CHECK(robot.sonar({at, at, 225.0})[2] == doctest::Approx(at * std::sqrt(2.0) - 0.1));
    CHECK(robot.sonar({5.0 - at, 5.0 - at, 45.0})[2] == doctest::Approx(at * std::sqrt(2.0) - 0.1));
  }
}

TEST_CASE("The heading after a step is as commanded, whatever was touched") {
  const Robot robot(World(), {});
  Pose pose{0.15, 0.15, 30.0};
  for (int i = 0; i < 50; ++i) {
    const Robot::Move step = robot.step(pose, i % 5);
    const double turned =
        pose.heading + robot.def().steering_angles[static_cast<std::size_t>(i % 5)];
    CHECK(step.pose.heading == wrapped_heading(turned));
    pose = step.pose;
  }
}

TEST_CASE("Nothing that a caller can say of a world reaches one of Box2D's asserts") {
  Random random(6, "hostile");
  const double sizes[] = {0.0, 1e-300, 1e-3, 0.0099, 0.01, 0.0101, 0.1, 1.0, 50.0, 1000.0, 1e9};
  const auto size = [&] { return sizes[random.index(11)]; };
  int accepted = 0, refused = 0, stood = 0;
  for (int n = 0; n < 4000; ++n) {
    WorldDef def;
    def.width = random.index(4) == 0 ? size() : between(random, 0.5, 10.0);
    def.height = random.index(4) == 0 ? size() : between(random, 0.5, 10.0);
    const auto place = [&] {
      const double spread = random.index(8) == 0 ? 3.0 : 1.0;
      return Point{def.width * (0.5 + spread * (random.uniform() - 0.5)),
                   def.height * (0.5 + spread * (random.uniform() - 0.5))};
    };
    const Point shared = place();
    const auto count = random.index(6);
    for (unsigned i = 0; i < count; ++i) {
      const Point center = random.index(3) == 0 ? shared : place();
      const double scale = between(random, 0.01, 0.3) * std::min(def.width, def.height);
      switch (random.index(5)) {
        case 0:
          def.obstacles.push_back(Circle{center, random.index(3) == 0 ? size() : scale});
          break;
        case 1:
          def.obstacles.push_back(Rectangle{center, random.index(3) == 0 ? size() : scale,
                                            random.index(3) == 0 ? 0.01 : scale,
                                            between(random, -360, 360)});
          break;
        case 2: {  // a sliver
          const double length = between(random, 0.02, 10.0 * scale);
          def.obstacles.push_back(Polygon{{center,
                                           {center.x + length, center.y + 1e-5},
                                           {center.x + 0.5 * length, center.y + 2.1e-4 / length}}});
          break;
        }
        default: {
          Polygon polygon = random_polygon(random, center, scale);
          if (random.index(8) == 0) polygon.corners.push_back(polygon.corners.front());
          def.obstacles.push_back(polygon);
        }
      }
    }
    const Point start = place(), target = place();
    def.start = {start.x, start.y, random.index(4) == 0 ? size() : between(random, -360, 360)};
    def.target = target;
    RobotDef robot_def;
    robot_def.radius = random.index(3) == 0 ? size() : between(random, 0.01, 0.2);
    robot_def.speed = random.index(3) == 0 ? size() : between(random, 0.01, 1.0);
    robot_def.sample_time = random.index(6) == 0 ? size() : 0.5;
    robot_def.sonar_range = random.index(3) == 0 ? size() : 2.0;
    try {
      const Robot robot(World(def), robot_def);
      ++accepted;
      Pose pose = def.start;
      for (int i = 0; i < 20; ++i) {
        robot.sonar(pose);
        const int motion = static_cast<int>(random.index(5));
        pose = robot.step(pose, motion).pose;
        REQUIRE(robot.world().clearance({pose.x, pose.y}, true) >= robot_def.radius - 0.005);
      }
      ++stood;
    } catch (const InvalidValue&) {
      ++refused;
    }
  }
  MESSAGE(accepted << " hostile worlds accepted, in " << stood << " of them the robot fits, "
                   << refused << " refused");
  CHECK(stood > 300);
  CHECK(refused > 300);
}
