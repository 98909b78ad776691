#include <doctest/doctest.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "devlearn/math.hpp"
#include "devlearn/random.hpp"

using namespace devlearn;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLargest = std::numeric_limits<double>::max();

// FNV-1a over the bits of a number, too.
std::uint64_t hashed(std::uint64_t hash, double number) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &number, sizeof bits);
  for (int byte = 0; byte < 8; ++byte) {
    hash = (hash ^ ((bits >> (8 * byte)) & 0xffU)) * 0x100000001b3U;
  }
  return hash;
}

// The worst error seen over many arguments.
struct Worst {
  double ulps = 0.0;
  double at = 0.0;

  // Adds exponential(x) against the wider type's, in units of the last place of the truth.
  void add(double x) {
    const long double truth = std::exp(static_cast<long double>(x));
    const double y = exponential(x);
    double error = kInfinity;
    if (truth > kLargest) {
      // The nearest double is the largest or infinity; both are within 1 ulp only at the border.
      error = y == kInfinity ? 0.0 : kInfinity;
    } else if (std::isfinite(y)) {
      int exponent = 0;
      std::frexp(truth, &exponent);
      const int last_place = std::max(exponent - 53, -1074);
      error = static_cast<double>(std::fabs(std::ldexp(y - truth, -last_place)));
    }
    if (!(error <= ulps)) {
      ulps = error;
      at = x;
    }
  }
};

}  // namespace

TEST_CASE("the exponential is within 1 ulp of the truth on a dense grid of its whole range") {
  Worst worst;
  for (int i = -7460000; i <= 7110000; i += 7) worst.add(i * 1e-4);
  CAPTURE(worst.at);
  CHECK(worst.ulps <= 1.0);
}

TEST_CASE("the exponential is within 1 ulp of the truth at random arguments of all magnitudes") {
  Worst worst;
  Random random(3, "exponential");
  for (int i = 0; i < 1000000; ++i) {
    const double magnitude =
        std::ldexp(1.0 + random.uniform(), static_cast<int>(random.index(70)) - 60);
    worst.add(random.index(2) == 0 ? magnitude : -magnitude);
  }
  for (int i = 0; i < 1000000; ++i) worst.add(1455.0 * random.uniform() - 745.5);
  CAPTURE(worst.at);
  CHECK(worst.ulps <= 1.0);
}

TEST_CASE("the exponential is within 1 ulp where its reduction changes over, and at its ends") {
  Worst worst;
  const auto add_around = [&worst](double x) {
    double below = x, above = x;
    for (int i = 0; i < 20; ++i) {
      worst.add(below = std::nextafter(below, -kInfinity));
      worst.add(above = std::nextafter(above, kInfinity));
    }
  };
  constexpr long double kLn2 = 0.693147180559945309417232121458176568L;
  for (int k = -1076; k <= 1025; ++k) {
    add_around(static_cast<double>(k * kLn2));
    add_around(static_cast<double>((k + 0.5L) * kLn2));
  }
  for (const double x :
       {0.0, -708.3964185322641, -745.1332191019411, -745.2, 709.782712893384, 709.79}) {
    add_around(x);
  }
  CAPTURE(worst.at);
  CHECK(worst.ulps <= 1.0);
}

TEST_CASE("the exponential of special values is the special value it should be") {
  CHECK(exponential(0.0) == 1.0);
  CHECK(exponential(-0.0) == 1.0);
  CHECK(exponential(5e-324) == 1.0);
  CHECK(exponential(-5e-324) == 1.0);
  CHECK(exponential(kInfinity) == kInfinity);
  CHECK(exponential(kLargest) == kInfinity);
  CHECK(exponential(-kInfinity) == 0.0);
  CHECK(exponential(-kLargest) == 0.0);
  CHECK(std::isnan(exponential(kNaN)));
  // The last finite one and the first infinite one.
  CHECK(exponential(709.782712893384) < kInfinity);
  CHECK(exponential(std::nextafter(709.782712893384, kInfinity)) == kInfinity);
  // The last that rounds to a denormal above 0.
  CHECK(exponential(-745.13321910194110842) == 5e-324);
}

TEST_CASE("the exponential has the same bits on every machine") {
  // Over the bits of e^x. The expected number was computed once; a machine or a compiler
  // that disagrees would make other histories.
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (int i = -74600; i <= 71000; ++i) {
    hash = hashed(hash, exponential(i * 0.01 + i * 0x1p-40));
  }
  CHECK(hash == 2277129694902506377U);
}

TEST_CASE("a heading that is a multiple of 90 degrees has an exact unit vector") {
  for (int k = -4000; k <= 4000; ++k) {
    const Direction d = direction(90.0 * k);
    const int quarter = ((k % 4) + 4) % 4;
    REQUIRE(d.x == (quarter == 0 ? 1.0 : quarter == 2 ? -1.0 : 0.0));
    REQUIRE(d.y == (quarter == 1 ? 1.0 : quarter == 3 ? -1.0 : 0.0));
  }
  const Direction far = direction(360e12 + 90.0);
  CHECK(far.x == 0.0);
  CHECK(far.y == 1.0);
}

TEST_CASE("the unit vector of a heading has the same bits on every machine") {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (int i = -36000; i <= 72000; ++i) {
    const Direction d = direction(i * 0.01 + i * 0x1p-40);
    for (const double y : {d.x, d.y}) hash = hashed(hash, y);
  }
  CHECK(hash == 9588213832307420807U);
}

#if LDBL_MANT_DIG > DBL_MANT_DIG  // otherwise there is nothing more exact to compare with
TEST_CASE("the unit vector of a heading is the cosine and the sine to the last bits") {
  constexpr long double kDegree = 3.14159265358979323846264338327950288L / 180.0L;
  double worst = 0.0;
  const auto add = [&](double heading) {
    const Direction d = direction(heading);
    const long double angle = heading * kDegree;
    worst = std::max({worst, static_cast<double>(std::fabs(d.x - std::cos(angle))),
                      static_cast<double>(std::fabs(d.y - std::sin(angle)))});
  };
  for (int i = 0; i <= 360000; ++i) add(i * 1e-3);
  Random random(4, "direction");
  for (int i = 0; i < 500000; ++i) add(360.0 * random.uniform());
  CHECK(worst <= 2.3e-16);  // 1 ulp of 1
}
#endif

TEST_CASE("headings of the 30-degree grid have unit vectors symmetric to the last bit") {
  for (int k = 0; k < 12; ++k) {
    const Direction d = direction(30.0 * k), opposite = direction(30.0 * (k + 6));
    const Direction mirrored = direction(-30.0 * k), turned = direction(30.0 * (k + 3));
    CAPTURE(k);
    CHECK(opposite.x == -d.x);
    CHECK(opposite.y == -d.y);
    CHECK(mirrored.x == d.x);
    CHECK(mirrored.y == -d.y);
    CHECK(turned.x == -d.y);
    CHECK(turned.y == d.x);
  }
}

TEST_CASE("a heading in [0, 360) is wrapped to itself, others by whole turns, exactly") {
  CHECK(wrapped_heading(0.0) == 0.0);
  CHECK_FALSE(std::signbit(wrapped_heading(-0.0)));
  CHECK(wrapped_heading(360.0) == 0.0);
  CHECK(wrapped_heading(-360.0) == 0.0);
  CHECK_FALSE(std::signbit(wrapped_heading(-360.0)));
  CHECK(wrapped_heading(-30.0) == 330.0);
  CHECK(wrapped_heading(750.0) == 30.0);
  const double below = std::nextafter(360.0, 0.0);
  CHECK(wrapped_heading(below) == below);
  for (int k = -50000; k <= 50000; ++k) {
    const int heading = 30 * k;
    REQUIRE(wrapped_heading(heading) == ((heading % 360) + 360) % 360);
  }
}

TEST_CASE(
    "a wrapped heading is the double nearest to the true one, exact from above, and below 360") {
  Random random(5, "headings");
  int wrong = 0;
  for (int i = 0; i < 300000; ++i) {
    const double magnitude =
        std::ldexp(random.uniform(), static_cast<int>(random.index(200)) - 100);
    const double heading = random.index(2) == 0 ? magnitude : -magnitude;
    // fmod is exact, and so is its sum with 360 in the wider type, as good as.
    const long double remainder = std::fmod(heading, 360.0);
    const long double truth = remainder < 0.0L ? 360.0L + remainder : remainder;
    const double wrapped = wrapped_heading(heading);
    const long double error = std::fabs(std::remainder(wrapped - truth, 360.0L));
    wrong += !(error <= 0x1.001p-45L && wrapped >= 0.0 && wrapped < 360.0);
    wrong += heading > 0.0 && error != 0.0L;
  }
  CHECK(wrong == 0);
  CHECK(wrapped_heading(-5e-324) == 0.0);
  CHECK(wrapped_heading(kLargest) == std::fmod(kLargest, 360.0));
}

TEST_CASE("the heading of a vector is that which its unit vector has") {
  for (int degrees = 0; degrees < 360; ++degrees) {
    REQUIRE(heading_of(direction(degrees)) == degrees);
  }
  constexpr long double kPi = 3.14159265358979323846264338327950288L;
  Random random(9, "vectors");
  for (int i = 0; i < 200000; ++i) {
    const double length = std::ldexp(1.0, static_cast<int>(random.index(200)) - 100);
    const double x = length * (2.0 * random.uniform() - 1.0);
    const double y = length * (2.0 * random.uniform() - 1.0);
    long double truth = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
    if (truth < 0.0L) truth += 2.0L * kPi;
    const double heading = heading_of({x, y});
    REQUIRE(heading >= 0.0);
    REQUIRE(heading < 360.0);
    REQUIRE(std::abs(static_cast<double>(heading - truth * 180.0L / kPi)) <= 1.2e-13);
  }
}

TEST_CASE("the heading of a vector along an axis is exact, and that of none is 0") {
  for (const double length : {1e-100, 0.3, 1.0, 7e100}) {
    CHECK(heading_of({length, 0.0}) == 0.0);
    CHECK(heading_of({length, -0.0}) == 0.0);
    CHECK(heading_of({0.0, length}) == 90.0);
    CHECK(heading_of({-length, 0.0}) == 180.0);
    CHECK(heading_of({-length, -0.0}) == 180.0);
    CHECK(heading_of({0.0, -length}) == 270.0);
  }
  CHECK(heading_of({1.0, -1e-300}) == 0.0);
  CHECK(heading_of({0.0, 0.0}) == 0.0);
}
