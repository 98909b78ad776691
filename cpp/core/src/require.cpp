#include "devlearn/detail/require.hpp"

#include <string>

namespace devlearn {

void refuse_outside(std::string_view quantity, double value, char left, double low, double high,
                    char right, std::string_view unit) {
  std::string allowed = std::string("in ") + left + to_text(low) + ", " + to_text(high) + right;
  if (!unit.empty()) allowed.append(" ").append(unit);
  throw InvalidValue(std::string(quantity), to_text(value), allowed);
}

void refuse_infinite(std::string_view quantity, double value) {
  throw InvalidValue(std::string(quantity), to_text(value), "a finite number");
}

void refuse_count(std::string_view quantity, long long value, long long low, long long high) {
  throw InvalidValue(
      std::string(quantity), std::to_string(value),
      "a whole number in [" + std::to_string(low) + ", " + std::to_string(high) + "]");
}

void require_size(std::string_view quantity, std::size_t size, std::size_t expected) {
  if (size != expected) {
    throw InvalidValue(std::string(quantity), std::to_string(size) + " values",
                       std::to_string(expected) + " values");
  }
}

}  // namespace devlearn
