#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>

#include "devlearn/batch.hpp"
#include "devlearn/eigen_sim.hpp"
#include "open_world.hpp"

// This program puts itself in malloc's place, by which operator new, Eigen and Box2D get memory.
namespace {
long allocations = 0;
}
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* malloc(std::size_t size) noexcept {
  ++allocations;
  return __libc_malloc(size);
}

using namespace devlearn;

TEST_CASE("clearances and echoes are filled in without allocating, once the sonars are made") {
  const Robot robot(open_world(), {});
  Eigen::ArrayXXd echoes = Eigen::ArrayXXd::Zero(5, 2);
  Eigen::ArrayXd clearances(100);
  const Eigen::Matrix2Xd points = Eigen::Matrix2Xd::Constant(2, 100, 4.0);
  const auto allocations_in = [](const auto& call) {
    const long before = allocations;
    call();
    return allocations - before;
  };
  const auto fill = [&] {
    fill_echoes(robot, {4.6, 6.4, 80.0}, echoes.col(1));
    fill_clearances(robot.world(), points, clearances, true);
  };
  CHECK(allocations_in(fill) > 0);  // the count counts
  CHECK(allocations_in(fill) == 0);
  CHECK(echoes(2, 1) > 0.0);
}

TEST_CASE("a batch steps and begins episodes without allocating, where nothing is touched") {
  WorldDef def;
  def.obstacles = {Circle{{2.5, 4.0}, 0.3}};
  BatchConfig episodes;
  episodes.step_limit = 12;  // round in a circle
  episodes.autoreset = Autoreset::kSameStep;
  episodes.sonars = true;
  def.start = {2.5, 2.5, 0.0};
  Batch batch(World(def), 3, {}, episodes);
  const std::int64_t motions[] = {3, 1, 3};
  batch.step(motions);
  const long before = allocations;
  for (int step = 0; step < 100; ++step) batch.step(motions);
  CHECK(allocations == before);
}
