// A program's own instances of what devlearn computes with: of Eigen's expressions, and of whatever
// devlearn's headers define. Compiled with other flags, none of them may take the place of the
// library's.
#include <cstdint>
#include <vector>

#include "devlearn/choice.hpp"
#include "devlearn/eigen.hpp"
#include "devlearn/learner.hpp"
#include "devlearn/motor_memory.hpp"
#include "devlearn/random.hpp"

namespace {

template <typename Array>
double of_eigen(Array o, double sigma) {
  const Eigen::Index n = o.size();
  for (Eigen::Index j = 1; j < n; ++j) {  // Eq. 11, 9, 14
    o.head(j) *= static_cast<double>(j) / (j + 1.0);
    o(j) = 1.0 / (j + 1.0);
    o(j) += 0.3 * o(j);
    o.head(j + 1) /= o.head(j + 1).sum();
  }
  const auto c = Eigen::ArrayXd::NullaryExpr(n, [](Eigen::Index j) { return j == 1 ? 0.5 : 0.0; });
  const auto op = sigma * o + (1.0 - sigma) * c;  // Eq. 7
  const auto plain = sigma * o + (1.0 - sigma) * (0.0 * o);
  Eigen::ArrayXd all(n);
  all = op + plain;
  return all.maxCoeff() + op(0);
}

double of_devlearn() {
  std::vector<std::uint64_t> storage(devlearn::MotorMemory::bytes(4) / 8);
  devlearn::MotorMemory memory(storage.data(), 4);
  memory.clear();
  for (int place = 0; place < 3; ++place) memory.extend(place);
  memory.reject(3);
  memory.count_learning(1);
  memory.orient(1, 0.7);
  memory.orient(0, -0.3);
  memory.reduce();
  const devlearn::Curiosity curiosity(0.5, 1.0);
  devlearn::Random random(1, "instances");
  const devlearn::Candidates left = devlearn::candidates(memory);
  const auto draw = static_cast<int>(random.index(left.count()));
  const int place = devlearn::choose_motion(memory, left, draw, 0.3, curiosity);
  memory.abandon(0);
  return memory.orientation(0) + devlearn::choice_at(memory, place).motion + random.uniform();
}

}  // namespace

// Something of all of them, so that none is left out.
double instances() {
  Eigen::ArrayXd values = Eigen::ArrayXd::Ones(5), sef(5);
  devlearn::fill_evaluations({}, values, values, sef);
  const devlearn::Pose pose = devlearn::to_pose(devlearn::to_isometry({1.0, 2.0, 30.0}));
  return of_eigen(values, 0.3) + of_eigen(Eigen::Map<Eigen::ArrayXd>(values.data(), 5), 0.3) +
         of_devlearn() + sef(0) + pose.heading;
}
