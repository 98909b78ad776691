#pragma once

#include <cmath>

#include "devlearn/math.hpp"

namespace devlearn {

/// A number as the sum of two doubles, of which the second is too small to show in the first.
struct TwoDoubles {
  double high = 0.0, low = 0.0;
};

inline TwoDoubles operator+(TwoDoubles a, TwoDoubles b) noexcept {
  const double sum = a.high + b.high, part = sum - a.high;
  const double low = (a.high - (sum - part)) + (b.high - part) + (a.low + b.low);
  return {sum + low, low - ((sum + low) - sum)};
}
inline TwoDoubles operator*(TwoDoubles a, TwoDoubles b) noexcept {
  const double product = a.high * b.high;
  const double low = std::fma(a.high, b.high, -product) + (a.high * b.low + a.low * b.high);
  return {product + low, low - ((product + low) - product)};
}
inline TwoDoubles operator/(TwoDoubles a, double b) noexcept {
  const double quotient = a.high / b;
  const double low = (std::fma(-quotient, b, a.high) + a.low) / b;
  return {quotient + low, low - ((quotient + low) - quotient)};
}

/// The unit vector of an angle in [0, 2 pi] radians, its components rounded correctly: what a good
/// C library's cosine and sine give, on every machine. direction() is half a unit coarser.
inline Direction fine_direction(double angle) noexcept {
  constexpr TwoDoubles kQuarter{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};  // pi / 2
  const auto quarter = static_cast<int>(angle / kQuarter.high + 0.5);
  const TwoDoubles x = TwoDoubles{angle} + kQuarter * TwoDoubles{-1.0 * quarter};
  const TwoDoubles negative_square = x * x * TwoDoubles{-1.0};
  // Taylor's series, the last terms first.
  TwoDoubles cosine{1.0}, sine{1.0};
  for (int n = 26; n >= 2; n -= 2) {
    cosine = TwoDoubles{1.0} + negative_square * cosine / (n * (n - 1.0));
    sine = TwoDoubles{1.0} + negative_square * sine / (n * (n + 1.0));
  }
  const double c = cosine.high, s = (x * sine).high;
  switch (quarter % 4) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

}  // namespace devlearn
