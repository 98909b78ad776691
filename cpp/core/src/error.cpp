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

void refuse(std::string quantity, std::string value, std::string allowed) {
  throw InvalidValue(std::move(quantity), std::move(value), std::move(allowed));
}

std::string to_text(double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  return std::string(digits, end);
}

}  // namespace devlearn
