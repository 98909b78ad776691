#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "devlearn/eigen.hpp"
#include "devlearn/random.hpp"
#include "refusal.hpp"

using namespace devlearn;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
using Ids = Eigen::Array<SituationId, Eigen::Dynamic, 1>;

Eigen::ArrayXd random_values(Random& random, Eigen::Index count, double most) {
  return Eigen::ArrayXd::NullaryExpr(count, [&] { return most * random.uniform(); });
}

}  // namespace

TEST_CASE("SEF of many pairs is that of each") {
  Random random(1, "pairs");
  StateEvaluation evaluation;
  for (const double a5 : {12.0, 0.0}) {
    evaluation.a5 = a5;
    const Eigen::ArrayXd goals = random_values(random, 500, 10.0);
    Eigen::ArrayXd obstacles = random_values(random, 500, 3.0);
    obstacles(7) = std::numeric_limits<double>::infinity();
    Eigen::ArrayXd sef(500);
    fill_evaluations(evaluation, goals, obstacles, sef);
    for (int i = 0; i < 500; ++i) REQUIRE(sef(i) == evaluation(goals(i), obstacles(i)));
  }
}

TEST_CASE("the situations of many poses are those of each, whatever memory they lie in") {
  Random random(2, "poses");
  const SituationGrid grid(4.0, 3.0, 16, 12, 8);
  Eigen::Matrix<double, 5, Eigen::Dynamic> log(5, 300);  // a pose is three rows of five
  log.row(1) = random_values(random, 300, 4.0);
  log.row(2) = random_values(random, 300, 3.0);
  log.row(3) = random_values(random, 300, 1000.0) - 500.0;
  std::vector<SituationId> ids(300, -1);
  fill_situations(grid, log.middleRows<3>(1), Eigen::Map<Ids>(ids.data(), 300));
  for (int i = 0; i < 300; ++i) {
    REQUIRE(ids[i] == grid.situation(log(1, i), log(2, i), log(3, i)));
  }
}

TEST_CASE("vectors serve as arrays do, and none is many enough") {
  const Eigen::Vector3d goals(1.0, 2.0, 3.0), obstacles(0.5, 0.6, 0.7);
  Eigen::VectorXd sef(3);
  fill_evaluations({}, goals.array(), obstacles.array(), sef.array());
  CHECK(sef(2) == StateEvaluation()(3.0, 0.7));
  Ids ids(0);
  fill_situations(SituationGrid(), Eigen::Matrix3Xd(3, 0), ids);
}

TEST_CASE("what does not fit or is refused leaves everything unwritten") {
  Eigen::ArrayXd goals = Eigen::ArrayXd::Constant(3, 1.0), obstacles = goals;
  Eigen::ArrayXd sef = Eigen::ArrayXd::Constant(3, -5.0), few(2);
  const Eigen::ArrayXd before = sef;
  const auto evaluate = [&] { fill_evaluations({}, goals, obstacles, sef); };
  check_refused([&] { fill_evaluations({}, goals, few, sef); }, "obstacle_distances", "2 values");
  check_refused([&] { fill_evaluations({}, goals, obstacles, few); }, "sef", "2 values");
  obstacles(2) = kNaN;
  check_refused(evaluate, "obstacle_distance[2]", "nan");
  goals(1) = -1.0;
  check_refused(evaluate, "goal_distance[1]", "-1");
  CHECK((sef == before).all());

  const SituationGrid grid;
  Eigen::Matrix3Xd poses = Eigen::Matrix3Xd::Constant(3, 4, 1.0);
  Ids ids = Ids::Constant(4, -1), more(5);
  check_refused([&] { fill_situations(grid, poses, more); }, "ids", "5 values");
  for (int row = 0; row < 3; ++row) {
    poses(row, 3) = row == 2 ? kNaN : 5.5;
    check_refused([&] { fill_situations(grid, poses, ids); },
                  row == 0   ? "x[3]"
                  : row == 1 ? "y[3]"
                             : "heading[3]",
                  row == 2 ? "nan" : "5.5");
    poses(row, 3) = 1.0;
  }
  CHECK((ids == -1).all());
}

TEST_CASE("a pose and its transform say the same") {
  Random random(3, "poses");
  for (int i = 0; i < 1000; ++i) {
    const Pose pose{10.0 * random.uniform(), -10.0 * random.uniform(), 360.0 * random.uniform()};
    const Eigen::Isometry2d world_of_robot = to_isometry(pose);
    const Direction ahead = direction(pose.heading);
    const Eigen::Vector2d nose = world_of_robot * Eigen::Vector2d(2.0, 0.0);
    REQUIRE(nose.x() == doctest::Approx(pose.x + 2.0 * ahead.x).epsilon(1e-14));
    REQUIRE(nose.y() == doctest::Approx(pose.y + 2.0 * ahead.y).epsilon(1e-14));
    REQUIRE(world_of_robot.linear().determinant() == doctest::Approx(1.0).epsilon(1e-14));
    const Pose back = to_pose(world_of_robot);
    REQUIRE(back.x == pose.x);
    REQUIRE(back.y == pose.y);
    REQUIRE(std::abs(back.heading - pose.heading) <= 1e-13 * 360.0);
  }
  for (int degrees = 0; degrees < 360; ++degrees) {
    const Pose pose{1.0, 2.0, static_cast<double>(degrees)};
    REQUIRE(to_pose(to_isometry(pose)) == pose);
  }
}

TEST_CASE("a transform that Eigen made of an angle is the pose of that many radians") {
  for (int i = -300; i <= 300; ++i) {
    const double yaw = 0.0311 * i;
    const Eigen::Isometry2d turned(Eigen::Translation2d(1.0, 2.0) * Eigen::Rotation2Dd(yaw));
    const Pose pose = to_pose(turned), expected = Pose::from_radians(1.0, 2.0, yaw);
    const double apart = std::abs(pose.heading - expected.heading);
    REQUIRE(std::min(apart, 360.0 - apart) <= 1e-12);
  }
}

TEST_CASE("no direction is made up where none is given") {
  for (const double strange : {std::nan(""), static_cast<double>(INFINITY)}) {
    check_refused([&] { to_isometry({1.0, 2.0, strange}); }, "heading", to_text(strange));
    Eigen::Isometry2d isometry = Eigen::Isometry2d::Identity();
    isometry.linear()(1, 0) = strange;
    check_refused([&] { to_pose(isometry); }, "linear.y", to_text(strange));
  }
  Eigen::Isometry2d nowhere = Eigen::Isometry2d::Identity();
  nowhere.linear().setZero();
  check_refused([&] { to_pose(nowhere); }, "linear", "zero");
}
