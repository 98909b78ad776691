#include <doctest/doctest.h>

#include <cstddef>

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
