#include "devlearn/error.hpp"

#include <charconv>
#include <utility>

namespace devlearn {
namespace {

std::string got(const std::string& value, const std::string& allowed) {
  return ": got " + value + "; expected " + allowed;
}

}  // namespace

InvalidValue::InvalidValue(std::string quantity, std::string value, std::string allowed)
    : InvalidValue(quantity + got(value, allowed), quantity, value, allowed) {}

InvalidValue::InvalidValue(const std::string& message, std::string quantity, std::string value,
                           std::string allowed)
    : std::invalid_argument(message),
      quantity_(std::move(quantity)),
      value_(std::move(value)),
      allowed_(std::move(allowed)) {}

FileError::FileError(std::string file, std::string field, std::string value, std::string allowed)
    : InvalidValue(file + (field.empty() ? "" : ": " + field) + got(value, allowed), field, value,
                   allowed),
      file_(std::move(file)) {}

std::string to_text(double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  return std::string(digits, end);
}

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

}  // namespace devlearn
