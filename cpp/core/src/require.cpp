#include "devlearn/detail/require.hpp"

#include <string>

#include "devlearn/detail/fields.hpp"

namespace devlearn {

void require_each(std::size_t count, const void* require, RequireOne one) {
  std::size_t i = 0;
  try {
    for (; i < count; ++i) one(require, i);
  } catch (const InvalidValue& error) {
    throw InvalidValue(error.quantity() + "[" + std::to_string(i) + "]", error.value(),
                       error.allowed());
  }
}

void refuse_outside(std::string_view quantity, double value, char left, double low, double high,
                    char right, std::string_view unit) {
  const detail::Interval allowed{low, high, left == '[', right == ']', unit};
  throw InvalidValue(std::string(quantity), to_text(value), allowed.text());
}

void refuse_infinite(std::string_view quantity, double value) {
  throw InvalidValue(std::string(quantity), to_text(value), "a finite number");
}

void refuse_count(std::string_view quantity, long long value, long long low, long long high) {
  throw InvalidValue(std::string(quantity), std::to_string(value), detail::whole(low, high).text());
}

void refuse_situation(std::int64_t situation) {
  throw InvalidValue("situation", std::to_string(situation), "a whole number in [0, 2^63 - 1]");
}

void require_size(std::string_view quantity, std::uint64_t size, std::uint64_t expected) {
  if (size != expected) {
    throw InvalidValue(std::string(quantity), std::to_string(size) + " values",
                       std::to_string(expected) + " values");
  }
}

}  // namespace devlearn
