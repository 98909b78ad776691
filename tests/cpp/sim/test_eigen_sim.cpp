#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "core/refusal.hpp"
#include "devlearn/eigen_sim.hpp"
#include "devlearn/random.hpp"
#include "open_world.hpp"

using namespace devlearn;

TEST_CASE("the clearances of many points are those of each") {
  const World world = open_world();
  Random random(1, "points");
  const Eigen::Matrix2Xd points = Eigen::Matrix2Xd::NullaryExpr(
      2, 400, [&](Eigen::Index, Eigen::Index) { return 12.0 * random.uniform(); });
  Eigen::ArrayXd clearances(400);
  for (const bool walls_count : {false, true}) {
    fill_clearances(world, points, clearances, walls_count);
    for (int i = 0; i < 400; ++i) {
      REQUIRE(clearances(i) == world.clearance({points(0, i), points(1, i)}, walls_count));
    }
  }
  check_refused([&] { fill_clearances(world, points.leftCols(3), clearances); }, "clearances",
                "400 values");
  for (const double strange : {std::nan(""), -static_cast<double>(INFINITY)}) {
    Eigen::Matrix2Xd some = points.leftCols(3);
    some(1, 2) = strange;
    Eigen::ArrayXd untouched = Eigen::ArrayXd::Constant(3, -1.0);
    check_refused([&] { fill_clearances(world, some, untouched); }, "points.y[2]",
                  to_text(strange));
    CHECK((untouched == -1.0).all());
  }
}

TEST_CASE("echoes written into an array are those of the vector; what is refused writes none") {
  const Robot robot(open_world(), {});
  Eigen::ArrayXXd log = Eigen::ArrayXXd::Constant(5, 3, -1.0);
  const Pose pose{4.6, 6.4, 80.0};
  fill_echoes(robot, pose, log.col(1));
  const std::vector<double> echoes = robot.sonar(pose);
  for (int i = 0; i < 5; ++i) CHECK(log(i, 1) == echoes[i]);
  CHECK((log.col(0) == -1.0).all());
  CHECK((log.col(2) == -1.0).all());

  Eigen::ArrayXd four = Eigen::ArrayXd::Constant(4, -1.0);
  check_refused([&] { fill_echoes(robot, pose, four); }, "echoes", "4 values");
  CHECK((four == -1.0).all());
  CHECK_THROWS_AS(fill_echoes(robot, Pose{4.6, 6.8, 0.0}, log.col(2)), InvalidValue);
  CHECK((log.col(2) == -1.0).all());
}

TEST_CASE("a polygon of a matrix has its columns as corners") {
  Eigen::Matrix2Xd corners(2, 3);
  corners << 8.5, 9.5, 8.9,  //
      7.5, 7.4, 8.2;
  WorldDef def = open_world().def();
  def.obstacles.back() = to_polygon(corners);
  const World world(def);
  CHECK(world.to_json() == open_world().to_json());
}
