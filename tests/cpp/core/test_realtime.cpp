#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <new>
#include <set>
#include <vector>

// Eigen gets its memory elsewhere, and says here when.
#define EIGEN_RUNTIME_NO_MALLOC
#define eigen_assert(holds) static_cast<void>((holds) || ++allocations)
static long allocations = 0;

#include "corridor.hpp"
#include "devlearn/adaptive.hpp"
#include "devlearn/eigen.hpp"
#include "devlearn/learner.hpp"
#include "devlearn/random.hpp"
#include "devlearn/snapshot.hpp"

// Laws of a control loop: when the learner allocates, and what it is left with where it cannot.
// This program replaces operator new, so these laws live apart from the others;
// check_symbols.cmake sees to it that the learner gets memory in no other way.
using namespace devlearn;

namespace {

constexpr long kNever = -1;
long failing = kNever;  // how many allocations succeed before the one that fails

// Not every C library has aligned_alloc: what malloc gave is noted in front of the memory.
void* allocate(std::size_t size, std::size_t alignment) {
  ++allocations;
  if (failing == 0) throw std::bad_alloc();
  if (failing > 0) --failing;
  void* const given = std::malloc(sizeof(void*) + alignment + size);
  if (given == nullptr) throw std::bad_alloc();
  const auto first = reinterpret_cast<std::uintptr_t>(given) + sizeof(void*);
  auto* const memory = reinterpret_cast<void**>((first + alignment - 1) / alignment * alignment);
  memory[-1] = given;
  return memory;
}

void release(void* memory) noexcept {
  if (memory != nullptr) std::free(static_cast<void**>(memory)[-1]);
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }

namespace {

template <typename F>
long allocations_in(const F& call) {
  const long before = allocations;
  Eigen::internal::set_is_malloc_allowed(false);
  call();
  Eigen::internal::set_is_malloc_allowed(true);
  return allocations - before;
}

// Makes the k-th allocation of a call fail, for every k until the call succeeds; check() is called
// after each failure. How many there were.
template <typename F, typename Check>
long fail_each(const F& call, const Check& check) {
  for (long k = 0;; ++k) {
    failing = k;
    bool failed = false;
    try {
      call();
    } catch (const std::bad_alloc&) {
      failed = true;
    }
    failing = kNever;
    if (!failed) return k;
    check();
  }
}

LearnerConfig with_motions(LearnerConfig config, int motion_count) {
  config.motion_count = motion_count;
  return config;
}

const std::vector<LearnerConfig> kConfigs{
    LearnerConfig::paper(), LearnerConfig::step5(), with_motions(LearnerConfig::paper(), 1),
    with_motions(LearnerConfig::paper(), 64), with_motions(LearnerConfig::step5(), 300)};

// Ids from all over their range, and neighbours.
std::vector<SituationId> some_ids(std::size_t count) {
  Random random(1, "ids");
  std::set<SituationId> ids;
  while (ids.size() < count) {
    ids.insert(random.index(2) == 0 ? static_cast<SituationId>(random.next() >> 1)
                                    : static_cast<SituationId>(ids.size()));
  }
  return {ids.begin(), ids.end()};
}

// What the steps met, without allocating.
struct Met {
  bool events[5]{}, kinds[3]{};
  long reduced = 0;
};

// One step of every kind there is, with an outcome of every kind; mostly failures, so that
// situations become exhausted.
void step(Learner& learner, SituationId id, Random& random, Met* met = nullptr) {
  static constexpr double kOutcomes[] = {0.0, 2.0, 50.0, 1e300, -0.1, -1.0, -1.0, -50.0, -1e300};
  const double smf = kOutcomes[random.index(std::size(kOutcomes))];
  const int motion =
      static_cast<int>(random.index(static_cast<std::uint32_t>(learner.config().motion_count)));
  Development development;
  Choice choice;
  switch (random.index(5)) {
    case 0:
      development = learner.update(id, motion, smf);
      break;
    case 1:
      choice = learner.choose(id);
      learner.cancel();
      break;
    case 2:
      choice = learner.choose(id);
      development = learner.learn(smf, motion);
      break;
    default:
      choice = learner.choose(id);
      development = learner.learn(smf);
  }
  if (met != nullptr) {
    met->events[static_cast<int>(development.event)] = true;
    if (choice.motion >= 0) met->kinds[static_cast<int>(choice.kind)] = true;
    met->reduced += development.reduced;
  }
}

// Whether two learners are the same now, and after some more steps.
void require_alike(Learner a, Learner b) {
  REQUIRE(to_bytes(a) == to_bytes(b));
  Random random_a(2, "future"), random_b(2, "future");
  for (int i = 0; i < 20; ++i) {
    if (a.pending()) a.cancel();
    if (b.pending()) b.cancel();
    step(a, i % 7, random_a);
    step(b, i % 7, random_b);
  }
  REQUIRE(to_bytes(a) == to_bytes(b));
}

// 150 rounds of an adaptive learner along a corridor whose door opens, and every other call that
// there is in between; look() after each step.
template <typename Look>
void adaptive_rounds(AdaptiveLearner& learner, const Look& look) {
  Random random(3, "corridor");
  for (int round = 0; round < 150; ++round) {
    learner.begin_round();
    Corridor at;
    at.place = random.index(20) == 0 ? 12 : 0;
    at.door = round >= 70;
    for (int step = 0; !at.arrived() && step < 300; ++step) {
      const bool mask[] = {true, random.index(2) == 0, random.index(2) == 0, true};
      const AllowedMotions allowed =
          random.index(20) == 0 ? AllowedMotions(mask) : AllowedMotions();
      const Choice choice = learner.choose(at.situation(), at.estimate(), allowed);
      if (random.index(50) == 0) {
        learner.cancel();
        continue;
      }
      const Corridor::Came came = at.step(choice.motion);
      learner.learn(came.cost, at.situation(), at.arrived() ? 0.0 : at.estimate(), came.touched);
      if (random.index(200) == 0) learner.update(3, 1, 2.0, 2, 9.0);
      if (random.index(2000) == 0 && at.place > 5) learner.forget(0);
      learner.best(at.situation());
      look();
    }
    if (random.index(10) != 0) learner.end_round(at.arrived());
  }
}

}  // namespace

TEST_CASE("up to the reserved situations nothing is allocated, whatever is met") {
  Met met;
  for (const std::size_t count : {1U, 14U, 15U, 1000U}) {
    const std::vector<SituationId> ids = some_ids(count + 1);
    for (const LearnerConfig& config : kConfigs) {
      Learner learner(config, count);
      learner.reserve(count);
      Random random(count, "steps");
      const long allocated = allocations_in([&] {
        for (std::size_t i = 0; i < count; ++i) {
          for (int again = 0; again < 8; ++again) step(learner, ids[i], random, &met);
          step(learner, ids[random.index(static_cast<std::uint32_t>(i + 1))], random, &met);
        }
      });
      CHECK(learner.situations_experienced() == count);
      CHECK(allocated == 0);
      // The count counts.
      CHECK(allocations_in([&] { learner.choose(ids[count]); }) > 0);
    }
  }
  for (const bool event : met.events) CHECK(event);
  for (const bool kind : met.kinds) CHECK(kind);
  CHECK(met.reduced > 0);
}

TEST_CASE("a copy into a learner that has room allocates nothing, nor do best, forget and masks") {
  Learner learner(LearnerConfig::paper(), 4), spare;
  learner.reserve(500);
  spare.reserve(600);
  const std::vector<SituationId> ids = some_ids(500);
  Random random(4, "steps");
  const bool allowed[] = {true, false, true, true, false};
  const long allocated = allocations_in([&] {
    for (const SituationId id : ids) {
      learner.choose(id, allowed);
      learner.learn(random.uniform() - 0.4);
      learner.best(id);
      if (random.index(4) == 0) learner.forget(id);
      if (random.index(50) == 0) spare = learner;
    }
    spare = learner;
  });
  CHECK(allocated == 0);
  require_alike(learner, spare);
  // The count counts.
  Learner small;
  CHECK(allocations_in([&] { small = learner; }) > 0);
}

TEST_CASE("beyond the reserved situations allocations grow with the logarithm of their number") {
  for (const std::size_t reserved : {0U, 1000U}) {
    Learner learner;
    learner.reserve(reserved);
    const auto add = [&](SituationId begin, SituationId end) {
      return allocations_in([&] {
        for (SituationId id = begin; id < end; ++id) learner.update(id * 1000003, 0, 1.0);
      });
    };
    // So many between a number of situations and its double.
    constexpr long kMost = 8;
    CHECK(add(0, 1024) <= 10 * kMost);
    for (SituationId count = 1024; count < 200000; count *= 2)
      CHECK(add(count, 2 * count) <= kMost);
  }
}

TEST_CASE("a failed allocation leaves the learner unchanged, and able to go on") {
  for (const LearnerConfig& config : kConfigs) {
    Learner learner(config, 5), twin = learner;
    Random outcomes(5, "outcomes");
    long failures = 0;
    for (const SituationId id : some_ids(70)) {
      const Learner before = learner;
      const auto unchanged = [&] { require_alike(learner, before); };
      const double smf = outcomes.uniform() - 0.5;
      if (outcomes.index(2) == 0) {
        failures += fail_each([&] { learner.choose(id); }, unchanged);
        learner.learn(smf);
        twin.choose(id);
        twin.learn(smf);
      } else {
        failures += fail_each([&] { learner.update(id, 0, smf); }, unchanged);
        twin.update(id, 0, smf);
      }
    }
    CHECK(failures > 5);
    require_alike(learner, twin);
  }
}

TEST_CASE("a reservation, a copy, an assignment or a snapshot that fails changes nothing") {
  Learner learner(LearnerConfig::paper(), 6);
  Random random(6, "steps");
  for (const SituationId id : some_ids(100)) step(learner, id, random);
  learner.choose(3);
  const Learner before = learner;
  const std::vector<std::byte> bytes = to_bytes(learner);
  const auto unchanged = [&] { require_alike(learner, before); };

  CHECK(fail_each([&] { learner.reserve(5000); }, unchanged) > 0);
  CHECK(fail_each([&] { Learner copy = learner; }, unchanged) > 0);
  CHECK(fail_each([&] { learner.state(); }, unchanged) > 0);
  CHECK(fail_each([&] { learner.situation(7); }, unchanged) > 0);
  CHECK(fail_each([&] { to_bytes(learner); }, unchanged) > 0);
  CHECK(fail_each([&] { load_learner(bytes.data(), bytes.size()); }, unchanged) > 0);

  Learner other(LearnerConfig::step5(), 7);
  other.update(1, 2, 3.0);
  const Learner other_before = other;
  CHECK(fail_each([&] { other = learner; }, [&] { require_alike(other, other_before); }) > 0);
  require_alike(other, learner);
  unchanged();
}

TEST_CASE("what is computed of many is filled in without allocating") {
  const Eigen::ArrayXd goals = Eigen::ArrayXd::LinSpaced(100, 0.0, 5.0), obstacles = goals;
  Eigen::Matrix<double, 4, Eigen::Dynamic> log(4, 100);
  log.setOnes();
  Eigen::ArrayXXd sef(100, 2);
  Eigen::Array<SituationId, Eigen::Dynamic, 1> ids(100);
  const SituationGrid grid;
  Pose pose;
  CHECK(allocations_in([&] {
          fill_evaluations({}, goals.tail(50), obstacles.head(50), sef.col(1).tail(50));
          fill_situations(grid, log.middleRows<3>(1).leftCols(70), ids.head(70));
          pose = to_pose(to_isometry(Pose::from_radians(1.0, 2.0, 3.0)));
        }) == 0);
  CHECK(ids(69) == grid.situation(1.0, 1.0, 1.0));
  // The count counts.
  CHECK(allocations_in([&] { fill_evaluations({}, goals + 1.0, obstacles, sef.col(0)); }) > 0);
}

TEST_CASE("up to the reserved situations and outcomes an adaptive learner allocates nothing") {
  for (const int curious_every : {0, 2}) {
    for (const int sweep_limit : {0, 10}) {
      AdaptiveConfig config = four_motions();
      config.patience = 0;
      config.tolerance = 0.5;
      config.enough = 1.0;
      config.recollections = 1;
      config.curious_every = curious_every;
      config.stale_after = 10;
      config.sweep_limit = sweep_limit;
      bool by_habit = false, deviated = false, homeward = false, curious = false, swept = false;
      std::size_t outcomes = 0;
      AdaptiveLearner twin(config, 1);
      adaptive_rounds(twin, [&] {
        const AdaptiveState state = twin.state();
        outcomes = std::max(outcomes, twin.outcomes());
        by_habit = by_habit || state.round.by_habit;
        deviated = deviated || state.round.deviated;
        homeward = homeward || state.round.decisions_home >= 0;
        curious = curious || state.round.curious;
        swept = swept || state.falling.under_way() || state.hope.under_way();
      });
      CHECK(by_habit);
      CHECK(deviated);
      CHECK(homeward);
      CHECK(twin.optimism() < config.optimism);
      CHECK(curious == (curious_every > 0));
      CHECK(swept == (sweep_limit > 0));

      AdaptiveLearner learner(config, 1);
      learner.reserve(twin.situations_experienced(), outcomes);
      CHECK(allocations_in([&] { adaptive_rounds(learner, [] {}); }) == 0);
      CHECK(to_bytes(learner) == to_bytes(twin));
      // The count counts.
      CHECK(allocations_in([&] { learner.update(1'000'000, 0, 1.0, 2'000'000, 1.0, 1.0); }) > 0);
    }
  }
}
