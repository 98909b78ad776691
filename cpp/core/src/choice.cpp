#include "devlearn/choice.hpp"

#include "devlearn/math.hpp"
#include "op.hpp"

namespace devlearn {

double curiosity(double times_learned, double c1, double c2) noexcept {
  return 1.0 / (1.0 + exponential(c1 * (times_learned - c2)));
}

Curiosity::Curiosity(double c1, double c2) noexcept : c1_(c1), c2_(c2) {
  for (std::size_t n = 0; n < first_.size(); ++n) {
    first_[n] = curiosity(static_cast<double>(n), c1, c2);
  }
}

int winner(const MotorMemory& memory, int curious, double sigma,
           const Curiosity& curiosity) noexcept {
  const int n = memory.effective_count();
  const double active = curiosity(memory.times_learned(curious));
  const ConstArray o(memory.orientations(), n);
  const auto c =
      Eigen::ArrayXd::NullaryExpr(n, [=](Eigen::Index j) { return j == curious ? active : 0.0; });
  const auto op = devlearn::op(o, c, sigma);
  int best = 0;
  double highest = op(0);
  for (int j = 1; j < n; ++j) {
    const double value = op(j);
    if (value > highest) {
      highest = value;
      best = j;
    }
  }
  return best;
}

}  // namespace devlearn
