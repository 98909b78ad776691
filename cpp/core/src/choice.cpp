#include "devlearn/choice.hpp"

#include <algorithm>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
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

void AllowedMotions::require(int motion_count) const {
  require_size("allowed", count_, static_cast<std::size_t>(motion_count));
  if (std::find(allowed_, allowed_ + count_, true) == allowed_ + count_) {
    throw InvalidValue("allowed", "no motion", "at least one that is true");
  }
}

int winner(const MotorMemory& memory, int curious, double sigma, const Curiosity& curiosity,
           AllowedMotions allowed) noexcept {
  const int n = memory.effective_count();
  const double active = curiosity(memory.times_learned(curious));
  const ConstArray o(memory.orientations(), n);
  const auto c =
      Eigen::ArrayXd::NullaryExpr(n, [=](Eigen::Index j) { return j == curious ? active : 0.0; });
  const auto op = devlearn::op(o, c, sigma);
  int best = nth_allowed(memory, 0, 0, allowed);
  double highest = op(best);
  for (int j = best + 1; j < n; ++j) {
    if (!allowed(memory.motion(j))) continue;
    const double value = op(j);
    if (value > highest) {
      highest = value;
      best = j;
    }
  }
  return best;
}

int place_in_order(const MotorMemory& memory, int n, AllowedMotions allowed) noexcept {
  int motion = 0;
  while (!allowed(motion) || n-- > 0) ++motion;
  return memory.place_of(motion);
}

}  // namespace devlearn
