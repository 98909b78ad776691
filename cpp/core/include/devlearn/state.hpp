#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "devlearn/error.hpp"

namespace devlearn {

/// The lengths of an array; none for a single value.
using Shape = std::vector<std::uint64_t>;

/// A plain array of numbers, in rows (C order). Copies share the values, which never change.
struct StateArray {
  std::string dtype;  ///< F64, I64, U64, I32, U32, U16, U8, or BOOL (one byte, 0 or 1)
  Shape shape;        ///< as many values as the lengths make
  std::shared_ptr<const std::byte> data;  ///< the values
  std::size_t bytes = 0;                  ///< what they take
};

/// Arrays by name.
using StateArrays = std::map<std::string, StateArray>;

/// `dtype` of a C++ type.
template <typename T>
constexpr const char* dtype_of() {
  if constexpr (std::is_same_v<T, bool>) {
    return "BOOL";
  } else if constexpr (std::is_floating_point_v<T>) {
    static_assert(sizeof(T) == 8, "an array holds doubles");
    return "F64";
  } else {
    static_assert(std::is_integral_v<T> && (std::is_unsigned_v<T> || sizeof(T) >= 4),
                  "an array holds numbers of one of the types that dtype names");
    constexpr const char* kUnsigned[] = {"U8", "U16", "U32", "U64"};
    constexpr const char* kSigned[] = {nullptr, nullptr, "I32", "I64"};
    constexpr int kPower = sizeof(T) == 1 ? 0 : sizeof(T) == 2 ? 1 : sizeof(T) == 4 ? 2 : 3;
    return std::is_signed_v<T> ? kSigned[kPower] : kUnsigned[kPower];
  }
}

/// Values that someone else owns, as many as the shape says; `owner` keeps them.
template <typename T>
StateArray array_over(const T* values, Shape shape, const std::shared_ptr<const void>& owner) {
  std::size_t bytes = sizeof(T);
  for (const std::uint64_t length : shape) bytes *= static_cast<std::size_t>(length);
  return {dtype_of<T>(), std::move(shape),
          std::shared_ptr<const std::byte>(owner, reinterpret_cast<const std::byte*>(values)),
          bytes};
}

/// The values themselves. Throws InvalidValue unless they are as many as the shape says.
template <typename T>
StateArray array_of(std::vector<T> values, Shape shape) {
  std::uint64_t count = 1;
  for (const std::uint64_t length : shape) count *= length;
  if (values.size() != count) {
    refuse("array.shape", std::to_string(values.size()) + " values",
           std::to_string(count) + ", as many as the lengths make");
  }
  const auto owner = std::make_shared<const std::vector<T>>(std::move(values));
  return array_over(owner->data(), std::move(shape), owner);
}
/// Likewise, in one dimension.
template <typename T>
StateArray array_of(std::vector<T> values) {
  const Shape shape{values.size()};
  return array_of(std::move(values), shape);
}

/// An array that must be there, with this type and shape. Throws InvalidValue, by its name.
const StateArray& require_array(const StateArrays& arrays, const std::string& name,
                                const char* dtype, const Shape& shape);

/// Its values, as a copy.
template <typename T>
std::vector<T> values_of(const StateArrays& arrays, const std::string& name, const Shape& shape,
                         const char* dtype = dtype_of<T>()) {
  const StateArray& array = require_array(arrays, name, dtype, shape);
  std::vector<T> values(array.bytes / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), array.data.get(), array.bytes);
  return values;
}

}  // namespace devlearn
