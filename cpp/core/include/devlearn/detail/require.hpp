#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "devlearn/error.hpp"

namespace devlearn {

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

[[noreturn]] void refuse_situation(std::int64_t situation);

/// Throws InvalidValue for a negative situation.
inline void require_situation(std::int64_t situation) {
  if (situation < 0) refuse_situation(situation);
}

/// Throws InvalidValue unless there are so many values.
void require_size(std::string_view quantity, std::uint64_t size, std::uint64_t expected);

using RequireOne = void (*)(const void* require, std::size_t i);
void require_each(std::size_t count, const void* require, RequireOne one);

/// What require(i) refuses of many values, 0 <= i < count, is refused with its place i.
template <typename Require>
void require_each(std::size_t count, const Require& require) {
  require_each(count, &require,
               [](const void* given, std::size_t i) { (*static_cast<const Require*>(given))(i); });
}

}  // namespace devlearn
