#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

// The safetensors layout: eight bytes of header length (little-endian), a JSON header, then plain
// arrays. Of JSON it needs two levels of objects, strings and whole numbers; reading just those,
// without recursion, bounds what a hostile file can do and keeps core free of a JSON library.
namespace devlearn::safetensors {

/// One plain array, in rows. dtype is safetensors' name: F64, I64, U64, I32, U32, U16, U8, BOOL.
struct Array {
  std::string dtype;
  std::vector<std::uint64_t> shape;
  const std::byte* data = nullptr;
  std::size_t bytes = 0;
};

using Metadata = std::map<std::string, std::string>;
using Arrays = std::map<std::string, Array>;

/// dtype of a C++ type.
template <typename T>
const char* dtype_of();

template <typename T>
Array array_of(const std::vector<T>& values, std::vector<std::uint64_t> shape) {
  return {dtype_of<T>(), std::move(shape), reinterpret_cast<const std::byte*>(values.data()),
          values.size() * sizeof(T)};
}

/// The header's eight bytes and its text. The metadata's entry `checksum` is added: see docs.
std::vector<std::byte> header(Metadata metadata, const Arrays& arrays);

/// The arrays in the order in which they follow the header.
std::vector<const Array*> in_order(const Arrays& arrays);

/// What a file holds; the arrays point into the bytes it was read from.
struct Contents {
  Metadata metadata;
  Arrays arrays;
};

/// Checks everything that does not depend on what the arrays mean: lengths, offsets without overlap
/// or hole, dtypes, shapes, the checksum. Throws FileError naming `source`.
Contents read(const std::byte* bytes, std::size_t size, const std::string& source);

/// The values of an array that must be there, with this dtype and shape. Throws FileError.
template <typename T>
std::vector<T> values(const Contents& contents, const std::string& name,
                      const std::vector<std::uint64_t>& shape, const std::string& source);

/// A metadata entry that must be there. Throws FileError.
const std::string& entry(const Contents& contents, const std::string& name,
                         const std::string& source);

}  // namespace devlearn::safetensors
