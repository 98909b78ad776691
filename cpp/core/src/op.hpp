#pragma once

#include "arrays.hpp"

namespace devlearn {

// Eq. 7: op = sigma O + (1 - sigma) C', of every effective motion; C' is 0 for a motion whose
// curiosity is not active.
template <typename Orientations, typename Curiosities>
auto op(const Orientations& o, const Curiosities& c, double sigma) noexcept {
  return sigma * o + (1.0 - sigma) * c;
}

}  // namespace devlearn
