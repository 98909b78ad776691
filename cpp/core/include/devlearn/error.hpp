#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

namespace devlearn {

/// A value or a call that devlearn refuses. It says which quantity, what was given, and what is
/// allowed; the object that refused is left as it was.
class InvalidValue : public std::invalid_argument {
 public:
  /// what() is made of the three.
  InvalidValue(std::string quantity, std::string value, std::string allowed);

  /// Which, such as `LearnerConfig.sigma`.
  const std::string& quantity() const noexcept { return quantity_; }
  /// What was given.
  const std::string& value() const noexcept { return value_; }
  /// What is allowed.
  const std::string& allowed() const noexcept { return allowed_; }

 protected:
  /// With a message of one's own.
  InvalidValue(const std::string& message, std::string quantity, std::string value,
               std::string allowed);

 private:
  std::string quantity_, value_, allowed_;
};

/// The same for a file: it also says which file and, where there is one, which field.
class FileError : public InvalidValue {
 public:
  /// what() is made of the four.
  FileError(std::string file, std::string field, std::string value, std::string allowed);

  /// Path of the file, or what stands for it.
  const std::string& file() const noexcept { return file_; }
  /// Path of the field within the file, such as `obstacles[2].radius`; empty for the whole file.
  const std::string& field() const noexcept { return quantity(); }

 private:
  std::string file_;
};

/// The shortest decimal text that reads back as `value`; for messages and files.
std::string to_text(double value);

[[noreturn]] void refuse_outside(std::string_view quantity, double value, char left, double low,
                                 double high, char right, std::string_view unit);

/// Throws InvalidValue unless `value` lies in [low, high] (so NaN never does); `unit` is for the
/// message.
inline void require_in(std::string_view quantity, double value, double low, double high,
                       std::string_view unit = "") {
  if (!(value >= low && value <= high)) refuse_outside(quantity, value, '[', low, high, ']', unit);
}
/// The same for the open interval (low, high).
inline void require_between(std::string_view quantity, double value, double low, double high,
                            std::string_view unit = "") {
  if (!(value > low && value < high)) refuse_outside(quantity, value, '(', low, high, ')', unit);
}
/// The same for the half-open interval (low, high].
inline void require_above(std::string_view quantity, double value, double low, double high,
                          std::string_view unit = "") {
  if (!(value > low && value <= high)) refuse_outside(quantity, value, '(', low, high, ']', unit);
}
[[noreturn]] void refuse_infinite(std::string_view quantity, double value);

/// Throws InvalidValue unless `value` is neither infinite nor NaN.
inline void require_finite(std::string_view quantity, double value) {
  if (!std::isfinite(value)) refuse_infinite(quantity, value);
}

[[noreturn]] void refuse_count(std::string_view quantity, long long value, long long low,
                               long long high);

/// Throws InvalidValue unless the whole number lies in [low, high].
inline void require_count(std::string_view quantity, long long value, long long low,
                          long long high) {
  if (value < low || value > high) refuse_count(quantity, value, low, high);
}

}  // namespace devlearn
