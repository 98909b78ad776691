#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "devlearn/evaluation.hpp"
#include "devlearn/random.hpp"
#include "refusal.hpp"

using namespace devlearn;

namespace {
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
}  // namespace

TEST_CASE("Eq. 6: SEF has the values worked out by hand") {
  const StateEvaluation sef;
  // At the target and far from obstacles: a1.
  CHECK(sef(0.0, kInfinity) == 20.0);
  // (20 - 0.3 * 4) - 0
  CHECK(sef(2.0, kInfinity) == doctest::Approx(18.8).epsilon(1e-15));
  // At an obstacle's surface the push is 0.2 e^5 = 29.682631820515...
  CHECK(sef(0.0, 0.0) == doctest::Approx(20.0 - 29.682631820515321).epsilon(1e-14));
  // Where a5 d_o = a4 the push is a3: (20 - 0.3) - 0.2
  CHECK(sef(1.0, 5.0 / 12.0) == doctest::Approx(19.5).epsilon(1e-15));
  // (20 - 0.3 * 0.25) - 0.2 e^(5 - 12 * 0.5) = 19.925 - 0.2 / e
  CHECK(sef(0.5, 0.5) == doctest::Approx(19.925 - 0.07357588823428847).epsilon(1e-15));
  // Other parameters, each in its place: (1 - 2 * 9) - 3 e^(4 - 5 * 2)
  const StateEvaluation other{1.0, 2.0, 3.0, 4.0, 5.0};
  CHECK(other(3.0, 2.0) == doctest::Approx(-17.0 - 3.0 * 0.0024787521766663584).epsilon(1e-15));
}

TEST_CASE("Eq. 6: SEF grows towards the target and away from obstacles") {
  const StateEvaluation sef;
  Random random(2, "sef");
  int wrong = 0;
  for (int i = 0; i < 100000; ++i) {
    const double goal = 7.0 * random.uniform(), obstacle = 2.0 * random.uniform();
    wrong += !(sef(goal + 0.01, obstacle) < sef(goal, obstacle));
    wrong += !(sef(goal, obstacle + 0.01) > sef(goal, obstacle));
  }
  CHECK(wrong == 0);
}

TEST_CASE("Eq. 6: without obstacles there is no push, whatever the parameters") {
  StateEvaluation sef;
  sef.a4 = 100.0;
  CHECK(sef(1.0, kInfinity) == 19.7);
  // A push that does not decay reaches as far as obstacles do.
  sef = {20.0, 0.3, 0.2, 0.0, 0.0};
  CHECK(std::isfinite(sef(1.0, kInfinity)));
}

TEST_CASE("Eq. 6: SEF is finite at every distance and with every parameter that is allowed") {
  for (const double a1 : {-1e6, 1e6}) {
    for (const double a2 : {0.0, 1e6}) {
      for (const double a3 : {0.0, 1e6}) {
        for (const double a4 : {-100.0, 100.0}) {
          for (const double a5 : {0.0, 5e-324, 1e6}) {
            const StateEvaluation sef{a1, a2, a3, a4, a5};
            REQUIRE_NOTHROW(sef.validate());
            for (const double goal : {0.0, 1e6}) {
              for (const double obstacle : {0.0, 1e308, kInfinity}) {
                REQUIRE(std::isfinite(sef(goal, obstacle)));
              }
            }
          }
        }
      }
    }
  }
}

TEST_CASE("a scaled SEF is the paper's at the same shares of the arena and of the radius") {
  CHECK(StateEvaluation::scaled(5.0, 0.1) == StateEvaluation{});
  const StateEvaluation paper, desk = StateEvaluation::scaled(1.2, 0.037);
  for (const double share : {0.0, 0.1, 0.5, 1.0, 1.4}) {
    for (const double radii : {1.0, 1.5, 4.0, 10.0}) {
      CHECK(desk(share * 1.2, radii * 0.037) ==
            doctest::Approx(paper(share * 5.0, radii * 0.1)).epsilon(1e-12));
    }
  }
  // What can be asked for can be had.
  for (const double arena : {0.01, 1.0, 1e6}) {
    for (const double radius : {1e-5, arena / 2.0}) {
      CHECK_NOTHROW(StateEvaluation::scaled(arena, radius).validate());
    }
  }
  check_refused([] { StateEvaluation::scaled(0.009, 0.001); }, "StateEvaluation.scaled.arena",
                "0.009");
  check_refused([] { StateEvaluation::scaled(kNaN, 0.1); }, "StateEvaluation.scaled.arena", "nan");
  check_refused([] { StateEvaluation::scaled(1.2, 0.61); }, "StateEvaluation.scaled.radius",
                "0.61");
  check_refused([] { StateEvaluation::scaled(1.2, 0.0); }, "StateEvaluation.scaled.radius", "0");
}

TEST_CASE("SEF refuses distances that are none") {
  const StateEvaluation sef;
  check_refused([&] { sef(-1e-9, 1.0); }, "goal_distance", "-1e-09");
  check_refused([&] { sef(1000001.0, 1.0); }, "goal_distance", "1000001");
  check_refused([&] { sef(kInfinity, 1.0); }, "goal_distance", "inf");
  check_refused([&] { sef(kNaN, 1.0); }, "goal_distance", "nan");
  check_refused([&] { sef(1.0, -1e-9); }, "obstacle_distance", "-1e-09");
  check_refused([&] { sef(1.0, -kInfinity); }, "obstacle_distance", "-inf");
  check_refused([&] { sef(1.0, kNaN); }, "obstacle_distance", "nan");
}

TEST_CASE("SEF refuses each parameter out of its range") {
  struct Field {
    const char* name;
    double StateEvaluation::*member;
    double low, high;
  };
  for (const Field& field : {Field{"StateEvaluation.a1", &StateEvaluation::a1, -1e6, 1e6},
                             Field{"StateEvaluation.a2", &StateEvaluation::a2, 0.0, 1e6},
                             Field{"StateEvaluation.a3", &StateEvaluation::a3, 0.0, 1e6},
                             Field{"StateEvaluation.a4", &StateEvaluation::a4, -100.0, 100.0},
                             Field{"StateEvaluation.a5", &StateEvaluation::a5, 0.0, 1e6}}) {
    StateEvaluation sef;
    for (const double good : {field.low, field.high}) {
      sef.*field.member = good;
      CHECK_NOTHROW(sef.validate());
    }
    for (const double bad : {std::nextafter(field.low, -kInfinity),
                             std::nextafter(field.high, kInfinity), kInfinity, -kInfinity, kNaN}) {
      sef.*field.member = bad;
      check_refused([&] { sef.validate(); }, field.name, to_text(bad));
    }
  }
}

TEST_CASE("evaluations are equal when every parameter is") {
  CHECK(StateEvaluation{} == StateEvaluation{});
  for (double StateEvaluation::*member :
       {&StateEvaluation::a1, &StateEvaluation::a2, &StateEvaluation::a3, &StateEvaluation::a4,
        &StateEvaluation::a5}) {
    StateEvaluation other;
    other.*member += 1.0;
    CHECK(other != StateEvaluation{});
    CHECK_FALSE(other == StateEvaluation{});
  }
}
