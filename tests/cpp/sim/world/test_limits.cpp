#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "core/refusal.hpp"
#include "devlearn/error.hpp"
#include "devlearn/trial.hpp"
#include "devlearn/world.hpp"

// Every limit that is stated can be reached, and what lies beyond it is refused.
using namespace devlearn;

namespace {

// A rod along an axis whose end is a centimetre wide, in decimal coordinates from a file.
std::string rod(int hundredth, bool upright) {
  const auto text = [](int hundredths) {
    const std::string digits = std::to_string(100 + hundredths % 100).substr(1);
    return std::to_string(hundredths / 100) + "." + digits;
  };
  const std::string low = text(hundredth), high = text(hundredth + 1);
  const auto corner = [&](const std::string& along, const std::string& across) {
    return upright ? "[" + across + ", " + along + "]" : "[" + along + ", " + across + "]";
  };
  return R"({"format": "devlearn-world", "version": 1, "arena": {"width": 5, "height": 5},)"
         R"("start": {"x": 4.5, "y": 4.5, "heading": 0}, "target": {"x": 4.6, "y": 4.6},)"
         R"("obstacles": [{"shape": "polygon", "corners": [)" +
         corner("1.0", low) + ", " + corner("1.5", low) + ", " + corner("1.5", high) + ", " +
         corner("1.0", high) + "]}]}";
}

World of_corners(std::vector<Point> corners) {
  WorldDef def;
  def.obstacles.push_back(Polygon{std::move(corners)});
  return World(def);
}

}  // namespace

TEST_CASE("walls one centimetre thick are accepted wherever they stand") {
  int refused = 0;
  for (int hundredth = 0; hundredth < 400; ++hundredth) {
    for (const bool upright : {false, true}) {
      try {
        World::parse(rod(hundredth, upright));
      } catch (const InvalidValue&) {
        ++refused;
      }
    }
  }
  CHECK(refused == 0);
}

TEST_CASE("corners nearer than a centimetre are refused") {
  CHECK_THROWS_AS(of_corners({{1.0, 1.0}, {2.0, 1.0}, {2.0, 1.0099999}, {1.0, 1.0099999}}),
                  InvalidValue);
}

TEST_CASE("the least polygon is a square of a centimetre, anywhere") {
  for (const double x : {0.02, 1.1, 2.31, 3.777}) {
    of_corners({{x, x}, {x + 0.01, x}, {x + 0.01, x + 0.01}, {x, x + 0.01}});
  }
}

TEST_CASE("a ring that ends with its first corner is the polygon without it") {
  const World closed = of_corners({{1.0, 1.0}, {2.0, 1.0}, {2.0, 2.0}, {1.0, 1.0}});
  const World open = of_corners({{1.0, 1.0}, {2.0, 1.0}, {2.0, 2.0}});
  CHECK(closed.to_json() == open.to_json());
  CHECK(closed.clearance({2.5, 1.5}) == open.clearance({2.5, 1.5}));
  // Nothing is left of this one.
  CHECK_THROWS_AS(of_corners({{1.0, 1.0}, {2.0, 1.0}, {1.0, 1.0}}), InvalidValue);
}

TEST_CASE("a million points in all are the most, whether of outlines, holes or thin walls") {
  WorldDef def;
  def.width = def.height = 1000.0;
  const auto row = [](double y, int count) {
    std::vector<Point> points;
    for (int i = 0; i < count; ++i) points.push_back({10.0 + 0.01 * i, y + (i % 2) * 0.01});
    return points;
  };
  for (int i = 0; i < 8; ++i) def.obstacles.push_back(Polyline{row(10.0 + i, 100'000 - 2)});
  Polygon comb{row(30.0, 100'000 - 2)};
  comb.corners.push_back({1011.0, 35.0});
  comb.corners.push_back({9.0, 35.0});
  comb.holes.push_back(row(32.0, 100'000 - 2));
  comb.holes.back().push_back({1010.0, 34.0});
  comb.holes.back().push_back({10.0, 34.0});
  def.obstacles.push_back(comb);
  def.obstacles.push_back(Polyline{row(40.0, 16)});
  const World most(def);
  CHECK(most.clearance({500.0, 31.0}) == 0.0);
  CHECK(most.clearance({500.0, 32.5}) == doctest::Approx(0.49).epsilon(0.03));
  def.obstacles.push_back(Polyline{row(50.0, 2)});
  try {
    World{def};
    FAIL_CHECK("accepted");
  } catch (const InvalidValue& e) {
    CHECK(e.quantity() == "obstacles");
    CHECK(e.value().find("1000002") != std::string::npos);
  }
}

TEST_CASE("the last round can be begun and lived in, and no further one") {
  constexpr std::int32_t kLast = 1 << 30;
  Trial trial{World()};
  trial.resume(trial.environment().state().place, kLast - 1, false);
  Record record;
  trial.path_learning(record, 1, 5);
  CHECK(trial.round() == kLast);
  CHECK(record.rounds.back().round == kLast);
  trial.run(record, 3);
  record.validate();
  CHECK_THROWS_AS(trial.begin_round(), InvalidValue);
  CHECK(trial.round() == kLast);
  trial.run(record, 1);
  CHECK_THROWS_AS(trial.resume(trial.environment().state().place, kLast + 1, false), InvalidValue);
}
