#include "devlearn/choice.hpp"

#include "devlearn/math.hpp"

namespace devlearn {

double curiosity(double times_learned, double c1, double c2) noexcept {
  return 1.0 / (1.0 + exponential(c1 * (times_learned - c2)));
}

Curiosity::Curiosity(double c1, double c2) noexcept : c1_(c1), c2_(c2) {
  for (std::size_t n = 0; n < first_.size(); ++n) {
    first_[n] = curiosity(static_cast<double>(n), c1, c2);
  }
}

}  // namespace devlearn
