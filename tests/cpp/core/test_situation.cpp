#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "devlearn/error.hpp"
#include "devlearn/random.hpp"
#include "devlearn/situation.hpp"
#include "refusal.hpp"

using namespace devlearn;

namespace {
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
}  // namespace

TEST_CASE("the paper's grid has 4800 situations, numbered by row, column and heading") {
  const SituationGrid grid;
  CHECK(grid.count() == 4800);
  CHECK(grid.situation(0.0, 0.0, 0.0) == 0);
  CHECK(grid.situation(0.1, 0.1, 30.0) == 1);
  CHECK(grid.situation(0.3, 0.1, 0.0) == 12);
  CHECK(grid.situation(0.1, 0.3, 0.0) == 240);
  CHECK(grid.situation(0.51, 0.515, 0.0) == (2 * 20 + 2) * 12);
  CHECK(grid.situation(4.9, 4.9, 330.0) == 4799);
}

TEST_CASE("a cell's border belongs to the cell above and to the right") {
  const SituationGrid grid;
  for (int k = 1; k < 20; ++k) {
    const double border = 0.25 * k;
    REQUIRE(grid.situation(border, 0.1, 0.0) == 12 * k);
    REQUIRE(grid.situation(std::nextafter(border, 0.0), 0.1, 0.0) == 12 * (k - 1));
    REQUIRE(grid.situation(0.1, border, 0.0) == 240 * k);
    REQUIRE(grid.situation(0.1, std::nextafter(border, 0.0), 0.0) == 240 * (k - 1));
  }
}

TEST_CASE("the arena's own far borders belong to the last cells") {
  const SituationGrid grid;
  CHECK(grid.situation(5.0, 5.0, 0.0) == 4788);
  CHECK(grid.situation(5.0, 0.0, 0.0) == 19 * 12);
  CHECK(grid.situation(0.0, 5.0, 0.0) == 19 * 240);
  // Also where the sides are no multiples of anything a double holds.
  Random random(10, "grids");
  for (int i = 0; i < 10000; ++i) {
    const double width = 1e-3 + 10.0 * random.uniform(), height = 1e-3 + 10.0 * random.uniform();
    const int columns = 1 + static_cast<int>(random.index(300));
    const int rows = 1 + static_cast<int>(random.index(300));
    const SituationGrid other(width, height, columns, rows, 1);
    REQUIRE(other.situation(width, height, 0.0) == other.count() - 1);
    REQUIRE(other.situation(std::nextafter(width, 0.0), std::nextafter(height, 0.0), 0.0) ==
            other.count() - 1);
  }
}

TEST_CASE("heading bins are centred on the multiples of 30 degrees and half-open") {
  const SituationGrid grid;
  for (int k = 0; k < 12; ++k) {
    CAPTURE(k);
    const double centre = 30.0 * k, upper = centre + 15.0;
    for (const double heading : {centre, centre - 14.999, centre + 14.999, centre - 15.0,
                                 std::nextafter(upper, 0.0), centre + 360.0, centre - 720.0}) {
      REQUIRE(grid.situation(0.1, 0.1, heading) == k);
    }
    REQUIRE(grid.situation(0.1, 0.1, upper) == (k + 1) % 12);
  }
  CHECK(grid.situation(0.1, 0.1, -0.0) == 0);
  CHECK(grid.situation(0.1, 0.1, -5e-324) == 0);
  CHECK(grid.situation(0.1, 0.1, std::nextafter(360.0, 0.0)) == 0);
}

TEST_CASE("every situation is the situation of its own centre, on any grid") {
  Random random(11, "centres");
  std::vector<SituationGrid> grids{SituationGrid(), SituationGrid(1.0, 3.0, 1, 1, 1),
                                   SituationGrid(0.7, 1000.0, 13, 7, 100)};
  for (int i = 0; i < 40; ++i) {
    grids.emplace_back(1e-3 + 100.0 * random.uniform(), 1e-3 + 100.0 * random.uniform(),
                       1 + static_cast<int>(random.index(30)),
                       1 + static_cast<int>(random.index(30)),
                       1 + static_cast<int>(random.index(40)));
  }
  for (const SituationGrid& grid : grids) {
    CHECK(grid.count() == SituationId{grid.columns()} * grid.rows() * grid.headings());
    for (SituationId id = 0; id < grid.count(); ++id) {
      const Pose centre = grid.centre(id);
      REQUIRE(grid.situation(centre.x, centre.y, centre.heading) == id);
    }
  }
  // The largest grid of all, at its ends and at random.
  const SituationGrid largest(1000.0, 1000.0, 100000, 100000, 3600);
  REQUIRE(largest.count() == 36000000000000);
  for (int i = 0; i < 100000; ++i) {
    SituationId id = static_cast<SituationId>(random.next() % 36000000000000U);
    if (i < 2) id = i == 0 ? 0 : largest.count() - 1;
    const Pose centre = largest.centre(id);
    REQUIRE(largest.situation(centre.x, centre.y, centre.heading) == id);
  }
}

TEST_CASE("the centre of a situation is the middle of its cell and bin") {
  const Pose centre = SituationGrid().centre((3 * 20 + 2) * 12 + 7);
  CHECK(centre.x == 0.625);
  CHECK(centre.y == 0.875);
  CHECK(centre.heading == 210.0);
}

TEST_CASE("a grid elsewhere gives the situations of the same grid at (0, 0)") {
  Random random(4, "elsewhere");
  for (const Point origin : {Point{256.0, -128.0}, {-1e7, 1e7}, {0.1, -0.3}}) {
    const SituationGrid here(5.0, 4.0, 20, 16, 12), there(5.0, 4.0, 20, 16, 12, origin);
    CHECK(there.origin() == origin);
    CHECK(there.count() == here.count());
    for (SituationId id = 0; id < here.count(); ++id) {
      const Pose centre = here.centre(id), other = there.centre(id);
      REQUIRE(other == Pose{origin.x + centre.x, origin.y + centre.y, centre.heading});
      REQUIRE(there.situation(other.x, other.y, other.heading) == id);
    }
    CHECK(there.situation(origin.x, origin.y, 0.0) == 0);
    CHECK(there.situation(origin.x + 5.0, origin.y + 4.0, 330.0) == there.count() - 1);
  }
  // To the border, where the shift takes no bit.
  const SituationGrid here, there(5.0, 5.0, 20, 20, 12, {256.0, -128.0});
  for (int i = 0; i < 10000; ++i) {
    const double x = 5.0 * std::floor(random.uniform() * 0x1p20) * 0x1p-20;
    const double y = 0.25 * random.index(21), heading = 360.0 * random.uniform();
    REQUIRE(there.situation(x + 256.0, y - 128.0, heading) == here.situation(x, y, heading));
  }
}

TEST_CASE("a pose outside the arena has no situation") {
  const SituationGrid grid;
  check_refused([&] { grid.situation(-5e-324, 1.0, 0.0); }, "x", "-5e-324");
  check_refused([&] { grid.situation(std::nextafter(5.0, 6.0), 1.0, 0.0); }, "x",
                "5.000000000000001");
  check_refused([&] { grid.situation(kNaN, 1.0, 0.0); }, "x", "nan");
  check_refused([&] { grid.situation(1.0, -0.25, 0.0); }, "y", "-0.25");
  check_refused([&] { grid.situation(1.0, kInfinity, 0.0); }, "y", "inf");
  check_refused([&] { grid.situation(1.0, kNaN, 0.0); }, "y", "nan");
  check_refused([&] { grid.situation(1.0, 1.0, kNaN); }, "heading", "nan");
  check_refused([&] { grid.situation(1.0, 1.0, -kInfinity); }, "heading", "-inf");
}

TEST_CASE("a situation that the grid does not have has no centre") {
  const SituationGrid grid;
  check_refused([&] { grid.centre(-1); }, "situation", "-1");
  check_refused([&] { grid.centre(4800); }, "situation", "4800");
}

TEST_CASE("a grid refuses sides and numbers of cells out of range") {
  for (const double bad : {0.0, -1.0, std::nextafter(1e4, 1e5), kInfinity, kNaN}) {
    check_refused([=] { SituationGrid(bad, 5.0); }, "SituationGrid.width", to_text(bad));
    check_refused([=] { SituationGrid(5.0, bad); }, "SituationGrid.height", to_text(bad));
  }
  for (const int bad : {0, -1, 100001}) {
    check_refused([=] { SituationGrid(5, 5, bad, 1, 1); }, "SituationGrid.columns",
                  std::to_string(bad));
    check_refused([=] { SituationGrid(5, 5, 1, bad, 1); }, "SituationGrid.rows",
                  std::to_string(bad));
  }
  for (const int bad : {0, -1, 3601}) {
    check_refused([=] { SituationGrid(5, 5, 1, 1, bad); }, "SituationGrid.headings",
                  std::to_string(bad));
  }
}

TEST_CASE("a grid refuses an origin further than 10 000 km") {
  for (const double bad : {1.1e7, -1.1e7, kInfinity, kNaN}) {
    check_refused(
        [=] {
          SituationGrid(5, 5, 1, 1, 1, {bad, 0.0});
        },
        "SituationGrid.origin.x", to_text(bad));
    check_refused(
        [=] {
          SituationGrid(5, 5, 1, 1, 1, {0.0, bad});
        },
        "SituationGrid.origin.y", to_text(bad));
  }
}

TEST_CASE("poses are equal when place and heading are") {
  CHECK(Pose{1, 2, 3} == Pose{1, 2, 3});
  CHECK(Pose{1, 2, 3} != Pose{0, 2, 3});
  CHECK(Pose{1, 2, 3} != Pose{1, 0, 3});
  CHECK(Pose{1, 2, 3} != Pose{1, 2, 0});
}

TEST_CASE("a heading in radians comes in as degrees in [0, 360), and goes out in (-pi, pi]") {
  constexpr double kPi = 3.14159265358979323846;
  CHECK(Pose::from_radians(1.0, 2.0, 0.0) == Pose{1.0, 2.0, 0.0});
  CHECK(Pose::from_radians(1.0, 2.0, kPi / 2.0).heading == 90.0);
  CHECK(Pose::from_radians(1.0, 2.0, -kPi / 2.0).heading == 270.0);
  CHECK(Pose::from_radians(1.0, 2.0, -kPi).heading == 180.0);
  CHECK(Pose::from_radians(1.0, 2.0, kPi / 6.0).heading == 30.0);
  CHECK(Pose{0.0, 0.0, 180.0}.yaw() == kPi);
  CHECK(Pose{0.0, 0.0, -180.0}.yaw() == kPi);
  CHECK(Pose{0.0, 0.0, 270.0}.yaw() == -kPi / 2.0);
  Random random(11, "yaws");
  for (int i = 0; i < 100000; ++i) {
    const double yaw = kPi * (1.0 - 2.0 * random.uniform());
    const double back = Pose::from_radians(0.0, 0.0, yaw).yaw();
    REQUIRE(back > -kPi);
    REQUIRE(back <= kPi);
    REQUIRE(std::abs(back - yaw) <= 4e-15);
    const double turns = Pose::from_radians(0.0, 0.0, yaw + 20.0 * kPi).yaw();
    REQUIRE(std::abs(turns - yaw) <= 4e-14);
  }
  check_refused([] { Pose::from_radians(0.0, 0.0, kInfinity); }, "yaw", "inf");
  check_refused([] { Pose::from_radians(0.0, 0.0, kNaN); }, "yaw", "nan");
}

TEST_CASE("what lies outside is in the nearest cell where it is clamped, and refused elsewhere") {
  const SituationGrid refusing(4.0, 3.0, 8, 6, 12, {-1.0, 2.0});
  const SituationGrid clamping(4.0, 3.0, 8, 6, 12, {-1.0, 2.0}, Outside::kClamp);
  Random random(9, "poses");
  for (int i = 0; i < 20000; ++i) {
    const double x = -1.0 + 4.0 * (3.0 * random.uniform() - 1.0);
    const double y = 2.0 + 3.0 * (3.0 * random.uniform() - 1.0);
    const double heading = 720.0 * random.uniform() - 360.0;
    const double near_x = std::min(std::max(x, -1.0), 3.0),
                 near_y = std::min(std::max(y, 2.0), 5.0);
    CHECK(clamping.situation(x, y, heading) == refusing.situation(near_x, near_y, heading));
    if (x != near_x || y != near_y) {
      CHECK_THROWS_AS(refusing.situation(x, y, heading), InvalidValue);
    }
  }
  CHECK(clamping.situation(1e300, -1e300, 0.0) == clamping.situation(3.0, 2.0, 0.0));
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    CHECK_THROWS_AS(clamping.situation(bad, 3.0, 0.0), InvalidValue);
    CHECK_THROWS_AS(clamping.situation(1.0, bad, 0.0), InvalidValue);
    CHECK_THROWS_AS(clamping.situation(1.0, 3.0, bad), InvalidValue);
  }
}

TEST_CASE("a robot that has radians says so by name") {
  const SituationGrid grid;
  for (int degrees = 0; degrees < 360; degrees += 7) {
    const double yaw = degrees * 3.14159265358979323846 / 180.0;
    CHECK(grid.situation(Pose::from_radians(1.0, 2.0, yaw)) == grid.situation(1.0, 2.0, degrees));
  }
}
