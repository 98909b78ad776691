#include <doctest/doctest.h>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "devlearn/random.hpp"

using namespace devlearn;

namespace {

// The generator once more, from the papers of its authors, in one function each.
std::uint64_t split_mix(std::uint64_t& x) {
  x += 0x9e3779b97f4a7c15ULL;
  std::uint64_t z = x;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

std::uint64_t rotl(std::uint64_t x, int k) { return (x << k) | (x >> (64 - k)); }

std::uint64_t xoshiro(std::uint64_t (&s)[4]) {
  const std::uint64_t result = rotl(s[0] + s[3], 23) + s[0];
  const std::uint64_t t = s[1] << 17;
  s[2] ^= s[0];
  s[3] ^= s[1];
  s[1] ^= s[2];
  s[0] ^= s[3];
  s[2] ^= t;
  s[3] = rotl(s[3], 45);
  return result;
}

// Uniform on {0, ..., count - 1} by the plainest rejection there is.
std::uint32_t plain_index(Random& random, std::uint32_t count) {
  // Of the 2^32 values v, those whose v * count mod 2^32 falls below 2^32 mod count are one too
  // many for some result.
  const std::uint64_t surplus = (std::uint64_t{1} << 32) % count;
  for (;;) {
    const std::uint64_t product = (random.next() >> 32) * count;
    if ((product & 0xffffffffULL) >= surplus) return static_cast<std::uint32_t>(product >> 32);
  }
}

}  // namespace

TEST_CASE("the generator gives the published outputs of xoshiro256++") {
  Random random(Random::State{1, 2, 3, 4});
  for (const std::uint64_t expected :
       {41943041ULL, 58720359ULL, 3588806011781223ULL, 3591011842654386ULL, 9228616714210784205ULL,
        9973669472204895162ULL, 14011001112246962877ULL, 12406186145184390807ULL,
        15849039046786891736ULL, 10450023813501588000ULL}) {
    CHECK(random.next() == expected);
  }
}

TEST_CASE("the generator agrees with an independent one from the same state") {
  std::uint64_t state[4] = {0x0123456789abcdefULL, 42, ~0ULL, 0x8000000000000000ULL};
  Random random(Random::State{state[0], state[1], state[2], state[3]});
  for (int i = 0; i < 10000; ++i) REQUIRE(random.next() == xoshiro(state));
  CHECK(random.state() == Random::State{state[0], state[1], state[2], state[3]});
}

TEST_CASE("a stream is seeded by SplitMix64 from the scrambled seed and the FNV-1a of its name") {
  std::uint64_t x = 1234567;
  REQUIRE(split_mix(x) == 6457827717110365317ULL);  // published
  for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0}}) {
    for (const std::string stream : {"agent", "world", "noise", ""}) {
      std::uint64_t name = 14695981039346656037ULL;
      for (const char c : stream) {
        name ^= static_cast<unsigned char>(c);
        name *= 1099511628211ULL;
      }
      std::uint64_t seeder = seed;
      std::uint64_t mixed = split_mix(seeder) ^ name;
      Random::State expected;
      for (std::uint64_t& word : expected) word = split_mix(mixed);
      CHECK(Random(seed, stream).state() == expected);
    }
  }
}

TEST_CASE("seeds and streams each give draws of their own") {
  std::set<std::uint64_t> first;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    for (const char* stream : {"agent", "world", "noise"})
      first.insert(Random(seed, stream).next());
  }
  CHECK(first.size() == 3000);
}

TEST_CASE("equal seeds and streams give equal draws, and a copy goes on alike") {
  Random a(7, "agent"), b(7, "agent");
  for (int i = 0; i < 100; ++i) REQUIRE(a.next() == b.next());
  Random copy = a;
  for (int i = 0; i < 100; ++i) REQUIRE(copy.index(5) == a.index(5));
}

TEST_CASE("a uniform draw is the upper 53 bits of one output, in [0, 1)") {
  Random random(8, "uniform"), twin = random;
  double low = 1.0, high = 0.0, sum = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const double u = random.uniform();
    REQUIRE(u * 9007199254740992.0 == static_cast<double>(twin.next() / 2048));
    low = std::min(low, u);
    high = std::max(high, u);
    sum += u;
  }
  CHECK(low >= 0.0);
  CHECK(high < 1.0);
  // The mean of 1e5 draws has a standard deviation of 0.00091.
  CHECK(sum / 1e5 == doctest::Approx(0.5).epsilon(0.01));
  // All 64 bits set make the largest.
  CHECK(Random(Random::State{0, 0, 0, 0}).uniform() == 0.0);
}

TEST_CASE("an index stays below its count, reaches every value and agrees with plain rejection") {
  for (const std::uint32_t count :
       {1U, 2U, 3U, 5U, 9U, 1000U, 65535U, 0x80000001U, 0xc0000001U, 0xffffffffU}) {
    CAPTURE(count);
    Random random(9, "index"), twin = random;
    std::set<std::uint32_t> seen;
    for (int i = 0; i < 20000; ++i) {
      const std::uint32_t drawn = random.index(count);
      REQUIRE(drawn < count);
      REQUIRE(drawn == plain_index(twin, count));
      if (count <= 1000) seen.insert(drawn);
    }
    if (count <= 1000) CHECK(seen.size() == count);
  }
}
