#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "devlearn/math.hpp"
#include "devlearn/motor_memory.hpp"

using namespace devlearn;

namespace {

using List = MotorMemory::List;
using Motions = std::vector<int>;

// A memory with storage of its own, every motion unexplored.
struct Fresh {
  explicit Fresh(int motion_count)
      : storage(MotorMemory::bytes(motion_count) / 8, ~std::uint64_t{0}),
        memory(storage.data(), motion_count) {
    memory.clear();
  }

  // The same with these motions effective, in this order.
  Fresh(int motion_count, const Motions& effective) : Fresh(motion_count) {
    for (const int motion : effective) memory.extend(memory.place_of(motion));
  }

  std::vector<std::uint64_t> storage;
  MotorMemory memory;
};

void check_orientation(const MotorMemory& memory, const std::vector<double>& expected) {
  REQUIRE(memory.effective_count() == static_cast<int>(expected.size()));
  for (int j = 0; j < memory.effective_count(); ++j) {
    CHECK(memory.orientation(j) == doctest::Approx(expected[j]).epsilon(1e-15));
  }
}

}  // namespace

TEST_CASE("Eq. 3-4: a situation never experienced has every motion unexplored, ascending") {
  for (const int motion_count : {1, 2, 5, 100, 65535}) {
    const Fresh fresh(motion_count);
    const SituationMemory copy = fresh.memory.copy();
    Motions all(motion_count);
    std::iota(all.begin(), all.end(), 0);
    CHECK(copy.unexplored == all);
    CHECK(copy.effective.empty());
    CHECK(copy.ineffective.empty());
    CHECK(copy.orientation.empty());
    CHECK(copy.times_learned.empty());
    CHECK(fresh.memory.unexplored_count() == motion_count);
    CHECK(MotorMemory::bytes(motion_count) % 8 == 0);
  }
}

TEST_CASE("Eq. 3-4: each motion is found in the one list that holds it") {
  Fresh fresh(5, {3, 1});
  MotorMemory& memory = fresh.memory;
  memory.reject(memory.place_of(4));
  const List lists[] = {List::kEffective, List::kEffective, List::kIneffective, List::kUnexplored,
                        List::kUnexplored};
  const int motions[] = {3, 1, 4, 0, 2};
  for (int place = 0; place < 5; ++place) {
    CHECK(memory.motion(place) == motions[place]);
    CHECK(memory.list(place) == lists[place]);
    CHECK(memory.place_of(motions[place]) == place);
  }
}

TEST_CASE("Eq. 10, 12, 13: an extension appends the motion, learned once") {
  Fresh fresh(5, {3, 1});
  fresh.memory.count_learning(0);
  fresh.memory.extend(fresh.memory.place_of(4));
  const SituationMemory copy = fresh.memory.copy();
  CHECK(copy.effective == Motions{3, 1, 4});
  CHECK(copy.unexplored == Motions{0, 2});
  CHECK(copy.times_learned == std::vector<std::uint32_t>{2, 1, 1});
}

TEST_CASE("Eq. 11: an extension gives 1/(n+1) to the new motion and n/(n+1) of theirs to others") {
  Fresh fresh(5, {0});
  check_orientation(fresh.memory, {1.0});
  fresh.memory.extend(fresh.memory.place_of(1));
  check_orientation(fresh.memory, {0.5, 0.5});
  fresh.memory.orient(0, 0.5);  // 0.75/1.25, 0.5/1.25
  check_orientation(fresh.memory, {0.6, 0.4});
  fresh.memory.extend(fresh.memory.place_of(2));
  check_orientation(fresh.memory, {0.4, 0.8 / 3, 1.0 / 3});
  fresh.memory.extend(fresh.memory.place_of(3));
  check_orientation(fresh.memory, {0.3, 0.2, 0.25, 0.25});
}

TEST_CASE("Eq. 10-13: a retried motion leaves the ineffective list, the rest keeps its order") {
  Fresh fresh(5, {2});
  MotorMemory& memory = fresh.memory;
  for (const int motion : {4, 0, 3}) memory.reject(memory.place_of(motion));
  CHECK(memory.copy().ineffective == Motions{4, 0, 3});
  memory.extend(memory.place_of(0));
  CHECK(memory.copy().effective == Motions{2, 0});
  CHECK(memory.copy().ineffective == Motions{4, 3});
  CHECK(memory.copy().unexplored == Motions{1});
  check_orientation(memory, {0.5, 0.5});
}

TEST_CASE("a rejected motion goes to the end of the ineffective list, the unexplored keep order") {
  Fresh fresh(4);
  for (const int motion : {2, 0}) fresh.memory.reject(fresh.memory.place_of(motion));
  CHECK(fresh.memory.copy().ineffective == Motions{2, 0});
  CHECK(fresh.memory.copy().unexplored == Motions{1, 3});
  CHECK(fresh.memory.effective_count() == 0);
}

TEST_CASE("Eq. 9: orientations have the values worked out by hand") {
  Fresh three(5, {0, 1, 2});
  three.memory.orient(1, 0.5);  // 1 + 1/6: (1/2)/(7/6), (1/3)/(7/6)
  check_orientation(three.memory, {2.0 / 7, 3.0 / 7, 2.0 / 7});

  Fresh two(5, {0, 1});
  two.memory.orient(0, -0.5);  // 1 - 1/4: (1/4)/(3/4), (1/2)/(3/4)
  check_orientation(two.memory, {1.0 / 3, 2.0 / 3});

  // SMF = 2 with the paper's eta: D = 1 - e^-0.1 = 0.095162581964040427
  Fresh paper(5, {0, 1});
  paper.memory.orient(0, 1.0 - exponential(-0.05 * 2.0));
  check_orientation(paper.memory, {0.52271007099478491, 0.47728992900521509});
}

TEST_CASE("Eq. 9: D = 0 changes nothing, D = 1 stays within [0, 1], D = -1 leaves nothing") {
  Fresh fresh(5, {0, 1});
  fresh.memory.orient(0, 0.0);
  check_orientation(fresh.memory, {0.5, 0.5});
  fresh.memory.orient(0, 1.0);
  check_orientation(fresh.memory, {2.0 / 3, 1.0 / 3});
  fresh.memory.orient(1, -1.0);
  check_orientation(fresh.memory, {1.0, 0.0});
}

TEST_CASE("Eq. 9: a sole motion keeps orientation 1 whatever D is") {
  Fresh fresh(5, {3});
  for (const double d : {1.0, 0.3, 0.0, -0.999999, -1.0}) {
    fresh.memory.orient(0, d);
    CHECK(fresh.memory.orientation(0) == 1.0);
  }
  CHECK(fresh.memory.reduce() == 0);
  CHECK(fresh.memory.effective_count() == 1);
}

TEST_CASE("Eq. 9: rounding errors never pile up, however often motions are weakened in turn") {
  // In exact arithmetic the sum stays 1; taken as printed, each D < 0 multiplies what rounding
  // left.
  for (const double d : {-0.01, -0.05, -0.2}) {
    CAPTURE(d);
    Fresh fresh(5, {0, 1, 2, 3, 4});
    for (int i = 0; i < 100000; ++i) fresh.memory.orient(i % 5, d);
    double sum = 0.0;
    for (int j = 0; j < 5; ++j) sum += fresh.memory.orientation(j);
    CHECK(sum == doctest::Approx(1.0).epsilon(1e-12));
  }
}

TEST_CASE("Eq. 14-17: motions below 1/(3 n) leave, the rest is renormalised and keeps its order") {
  Fresh fresh(5, {4, 2, 0});
  MotorMemory& memory = fresh.memory;
  memory.count_learning(0);
  memory.count_learning(2);
  memory.count_learning(2);
  memory.orient(1, -0.7);  // (1/10)/(23/30) = 3/23, above 1/9
  CHECK(memory.reduce() == 0);
  check_orientation(memory, {10.0 / 23, 3.0 / 23, 10.0 / 23});
  memory.orient(1, -0.5);  // 3/46 over 1 - 3/46: 3/43, below 1/9
  CHECK(memory.reduce() == 1);
  CHECK(memory.copy().effective == Motions{4, 0});
  CHECK(memory.copy().ineffective == Motions{2});
  CHECK(memory.copy().times_learned == std::vector<std::uint32_t>{2, 3});
  check_orientation(memory, {0.5, 0.5});
}

TEST_CASE("Eq. 14-17: the threshold is 1/(3 n), to the last digits") {
  for (int n = 2; n <= 5; ++n) {
    // From 1/n, this D leads to 1/(3 n): 3 (1 + D) = 1 + D/n.
    const double d = -2.0 / (3.0 - 1.0 / n);
    for (const double nudge : {1e-12, -1e-12}) {
      CAPTURE(n);
      CAPTURE(nudge);
      Fresh fresh(5);
      while (fresh.memory.effective_count() < n) fresh.memory.extend(fresh.memory.tried_count());
      fresh.memory.orient(0, d + nudge);
      CHECK(fresh.memory.reduce() == (nudge > 0.0 ? 0 : 1));
    }
  }
}

TEST_CASE("Eq. 14: the rest is divided by 1 - o_b, so that its proportions remain") {
  Fresh fresh(5, {0, 1, 2});
  MotorMemory& memory = fresh.memory;
  memory.orient(0, 0.5);   // 3/7 2/7 2/7
  memory.orient(2, -0.9);  // (3/7, 2/7, 0.2/7) / (5.2/7) = 15/26 10/26 1/26
  CHECK(memory.reduce() == 1);
  check_orientation(memory, {0.6, 0.4});  // (15/26, 10/26) / (1 - 1/26)
}

TEST_CASE("Eq. 14-17: several leave at once in their order, by the threshold of before") {
  Fresh fresh(5, {4, 3, 2, 1});
  MotorMemory& memory = fresh.memory;
  // Proportions 0.1 : 1 : 0.1 : 1, so that two have 1/22, below 1/12.
  memory.orient(0, -0.9);
  memory.orient(2, -0.9);
  CHECK(memory.reduce() == 2);
  CHECK(memory.copy().effective == Motions{3, 1});
  CHECK(memory.copy().ineffective == Motions{4, 2});
  check_orientation(memory, {0.5, 0.5});
}

TEST_CASE("a reduction does not cascade onto the threshold of fewer motions") {
  Fresh fresh(5, {0, 1, 2, 3});
  MotorMemory& memory = fresh.memory;
  // Proportions 1 : 1 : 0.22 : 0.01. The third has 0.099, between 1/12, the threshold before the
  // fourth leaves, and 1/9, the one after.
  memory.orient(2, -0.78);
  memory.orient(3, -0.99);
  CHECK(memory.reduce() == 1);
  CHECK(memory.copy().effective == Motions{0, 1, 2});
  CHECK(memory.orientation(2) == doctest::Approx(0.22 / 2.22).epsilon(1e-14));
  CHECK(memory.orientation(2) < 1.0 / 9);
  // The next step's reduction sees it.
  CHECK(memory.reduce() == 1);
  CHECK(memory.copy().effective == Motions{0, 1});
}

TEST_CASE("an abandoned motion leaves whatever its orientation, the rest as in Eq. 14") {
  Fresh fresh(5, {0, 1, 2});
  MotorMemory& memory = fresh.memory;
  memory.orient(0, 0.5);  // 3/7 2/7 2/7
  memory.abandon(1);
  CHECK(memory.copy().effective == Motions{0, 2});
  CHECK(memory.copy().ineffective == Motions{1});
  check_orientation(memory, {0.6, 0.4});
  memory.abandon(0);
  check_orientation(memory, {1.0});
  memory.abandon(0);
  CHECK(memory.effective_count() == 0);
  CHECK(memory.copy().ineffective == Motions{1, 0, 2});
  CHECK(memory.copy().unexplored == Motions{3, 4});
}

TEST_CASE("a motion that comes back is learned anew") {
  Fresh fresh(2, {1, 0});
  for (int i = 0; i < 6; ++i) fresh.memory.count_learning(0);
  fresh.memory.abandon(0);
  fresh.memory.extend(fresh.memory.place_of(1));
  CHECK(fresh.memory.copy().effective == Motions{0, 1});
  CHECK(fresh.memory.copy().times_learned == std::vector<std::uint32_t>{1, 1});
}

TEST_CASE("the largest memory holds 65 535 motions") {
  Fresh fresh(65535, {65534, 0});
  while (fresh.memory.unexplored_count() > 0) fresh.memory.reject(fresh.memory.tried_count());
  CHECK(fresh.memory.effective_count() == 2);
  CHECK(fresh.memory.ineffective_count() == 65533);
  CHECK(fresh.memory.motion(2) == 1);
  CHECK(fresh.memory.motion(65534) == 65533);
  fresh.memory.extend(fresh.memory.place_of(65533));
  CHECK(fresh.memory.copy().effective == Motions{65534, 0, 65533});
}
