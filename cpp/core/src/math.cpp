#include "devlearn/math.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace devlearn {
namespace {

// Horner's rule, highest power first.
template <int N>
constexpr double polynomial(double x, const double (&coefficients)[N]) noexcept {
  double sum = coefficients[0];
  for (int i = 1; i < N; ++i) sum = sum * x + coefficients[i];
  return sum;
}

constexpr double kPi = 3.14159265358979323846;

// Taylor series, enough for a double on [-pi/4, pi/4].
constexpr double kSine[] = {-1.0 / 1307674368000, 1.0 / 6227020800, -1.0 / 39916800, 1.0 / 362880,
                            -1.0 / 5040,          1.0 / 120,        -1.0 / 6};
constexpr double kCosine[] = {
    1.0 / 20922789888000, -1.0 / 87178291200, 1.0 / 479001600, -1.0 / 3628800,
    1.0 / 40320,          -1.0 / 720,         1.0 / 24};

// The same within a degree of 0.
constexpr double kArctangent[] = {1.0 / 9, -1.0 / 7, 1.0 / 5, -1.0 / 3};

// Of a heading in [0, 360) degrees.
constexpr Direction unit_vector(double heading) noexcept {
  const double nearest = heading / 90.0 + 0.5;
  const int quarter = static_cast<int>(nearest);
  const double x = (heading - 90.0 * quarter) * (kPi / 180.0), square = x * x;
  const double c = 1.0 - (0.5 * square - square * square * polynomial(square, kCosine));
  const double s = x + x * (square * polynomial(square, kSine));
  switch (quarter % 4) {
    case 0:
      return {c, s};
    case 1:
      return {0.0 - s, c};
    case 2:
      return {0.0 - c, 0.0 - s};
    default:
      return {s, 0.0 - c};
  }
}

constexpr auto kWholeDegrees = [] {
  std::array<Direction, 360> vectors{};
  for (std::size_t degrees = 0; degrees < vectors.size(); ++degrees) {
    vectors[degrees] = unit_vector(static_cast<double>(degrees));
  }
  return vectors;
}();

}  // namespace

double exponential(double x) noexcept {
  // e^x = 2^k e^r with |r| <= ln(2)/2; ln 2 is split so that x - k ln2 keeps its low bits.
  constexpr double kInverseLn2 = 1.44269504088896340736;
  constexpr double kLn2High = 0x1.62e42fee00000p-1;
  constexpr double kLn2Low = 0x1.a39ef35793c76p-33;
  if (std::isnan(x)) return x;
  if (x > 709.79) return std::numeric_limits<double>::infinity();
  if (x < -745.2) return 0.0;

  const double nearest = x * kInverseLn2 + 0.5;
  int power_of_two = static_cast<int>(nearest);
  if (power_of_two > nearest) --power_of_two;
  const double k = power_of_two;
  const double high = x - k * kLn2High;
  const double low = k * kLn2Low;
  const double r = high - low;
  const double lost = (high - r) - low;  // what rounding r dropped
  static constexpr double c[] = {1.0 / 6227020800, 1.0 / 479001600, 1.0 / 39916800, 1.0 / 3628800,
                                 1.0 / 362880,     1.0 / 40320,     1.0 / 5040,     1.0 / 720,
                                 1.0 / 120,        1.0 / 24,        1.0 / 6,        0.5};
  const double power = 1.0 + (r + (r * r * polynomial(r, c) + lost));
  if (power_of_two < -1021 || power_of_two > 1023) return std::ldexp(power, power_of_two);
  // 2^k by its bits: the product is no subnormal and so exact.
  const auto bits = static_cast<std::uint64_t>(power_of_two + 1023) << 52;
  double scale = 0.0;
  std::memcpy(&scale, &bits, sizeof scale);
  return power * scale;
}

double wrapped_heading(double heading) noexcept {
  if (heading >= 0.0 && heading < 360.0) return heading + 0.0;  // no -0
  double wrapped = std::fmod(heading, 360.0);
  if (wrapped < 0.0) wrapped += 360.0;
  // A tiny negative heading rounds up to 360.
  return wrapped < 360.0 ? wrapped + 0.0 : 0.0;
}

Direction direction(double heading) noexcept {
  const double wrapped = wrapped_heading(heading);
  const int degrees = static_cast<int>(wrapped);
  return degrees == wrapped ? kWholeDegrees[static_cast<std::size_t>(degrees)]
                            : unit_vector(wrapped);
}

double heading_of(Direction vector) noexcept {
  // Near enough to say from which whole degree to measure.
  const double x = std::abs(vector.x), y = std::abs(vector.y);
  const double least = std::min(x, y), most = std::max(x, y);
  if (most == 0.0) return 0.0;
  const double tangent = least / most;
  double near = tangent * (45.0 + 15.64 * (1.0 - tangent));
  if (y > x) near = 90.0 - near;
  if (vector.x < 0.0) near = 180.0 - near;
  if (vector.y < 0.0) near = 360.0 - near;
  const auto degrees = static_cast<int>(std::lround(near));

  // The rest, less than a degree, by its tangent t: arctan t as a Taylor series.
  const Direction whole = kWholeDegrees[static_cast<std::size_t>(degrees % 360)];
  const double t =
      (whole.x * vector.y - whole.y * vector.x) / (whole.x * vector.x + whole.y * vector.y);
  const double rest = t + t * (t * t * polynomial(t * t, kArctangent));
  return wrapped_heading(degrees + rest * (180.0 / kPi));
}

}  // namespace devlearn
