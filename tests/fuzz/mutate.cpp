#include "mutate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <utility>
#include <vector>

#include "devlearn/error.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace devlearn::fuzz {
namespace {

constexpr const char* kDigits = "0123456789";
constexpr const char* kSpecial[] = {"0",
                                    "-0.0",
                                    "1",
                                    "-1",
                                    "0.5",
                                    "0.01",
                                    "1e-300",
                                    "1e300",
                                    "1e999",
                                    "1000",
                                    "100000",
                                    "65535",
                                    "65536",
                                    "4294967295",
                                    "9223372036854775807",
                                    "18446744073709551615"};

// Where the numbers of a text begin and end.
std::vector<std::pair<std::size_t, std::size_t>> numbers_of(const std::string& text) {
  std::vector<std::pair<std::size_t, std::size_t>> numbers;
  std::size_t begin = text.find_first_of(kDigits);
  while (begin != text.npos) {
    const std::size_t end = std::min(text.find_first_not_of("0123456789.eE+-", begin), text.size());
    if (begin > 0 && text[begin - 1] == '-') --begin;
    numbers.emplace_back(begin, end);
    begin = text.find_first_of(kDigits, end);
  }
  return numbers;
}

std::string near(double value, Random& random) {
  switch (random.index(5)) {
    case 0:
      return to_text(std::nextafter(value, random.index(2) == 0 ? -1e308 : 1e308));
    case 1:
      return to_text(-value);
    case 2:
      return to_text(value * (random.index(2) == 0 ? 0.5 : 2.0));
    case 3:
      return to_text(value + 0.01 * (static_cast<double>(random.index(21)) - 10.0));
    default:
      return to_text(value + random.uniform() - 0.5);
  }
}

}  // namespace

void mutate_bytes(std::string& text) {
  const std::size_t size = text.size();
  text.resize(size + 32);
  text.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(text.data()), size, text.size()));
}

void mutate_number(std::string& text, Random& random) {
  const auto numbers = numbers_of(text);
  if (numbers.empty()) return;
  const auto any = [&] {
    return numbers[random.index(static_cast<std::uint32_t>(numbers.size()))];
  };
  const auto [begin, end] = any();
  std::string other;
  switch (random.index(4)) {
    case 0:
      other = kSpecial[random.index(std::size(kSpecial))];
      break;
    case 1: {
      const auto [first, last] = any();
      other = text.substr(first, last - first);
      break;
    }
    default:
      other = near(std::strtod(text.substr(begin, end - begin).c_str(), nullptr), random);
  }
  text.replace(begin, end - begin, other);
}

std::size_t put(const std::string& text, std::uint8_t* data, std::size_t max_size) {
  const std::size_t size = std::min(text.size(), max_size);
  std::copy_n(text.begin(), size, data);
  return size;
}

}  // namespace devlearn::fuzz
