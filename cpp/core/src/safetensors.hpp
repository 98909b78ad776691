#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <iosfwd>
#include <map>
#include <string>
#include <utility>
#include <vector>

// The safetensors layout: eight bytes of header length (little-endian), a JSON header, then plain
// arrays.
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

/// A view of values that someone else owns, as many as the shape says.
template <typename T>
Array array_of(const T* values, std::vector<std::uint64_t> shape) {
  std::size_t bytes = sizeof(T);
  for (const std::uint64_t length : shape) bytes *= length;
  return {dtype_of<T>(), std::move(shape), reinterpret_cast<const std::byte*>(values), bytes};
}

/// What a file holds; the arrays point into the bytes it was read from, or into what is saved.
struct Contents {
  Metadata metadata;
  Arrays arrays;
};

/// The file's bytes, piece by piece. The metadata's entry `checksum` is added: see docs.
using Write = std::function<void(const std::byte* data, std::size_t size)>;
void write(const Contents& contents, const Write& write);
/// To a path, as SideFile does it. Throws FileError.
void write(const Contents& contents, const std::string& path);
/// To a stream, which is in a failed state afterwards where it could not take everything.
void write(const Contents& contents, std::ostream& stream);
std::vector<std::byte> to_bytes(const Contents& contents);

/// All of a stream.
std::vector<std::byte> read_stream(std::istream& stream);

/// Checks everything that does not depend on what the arrays mean: lengths, offsets without overlap
/// or hole, dtypes, shapes, the checksum. Throws FileError naming `source`.
Contents read(const std::byte* bytes, std::size_t size, const std::string& source);

/// An array that must be there, with this dtype and shape. Throws FileError.
const Array& array(const Contents& contents, const std::string& name, const char* dtype,
                   const std::vector<std::uint64_t>& shape, const std::string& source);

/// Its values.
template <typename T>
std::vector<T> values(const Contents& contents, const std::string& name,
                      const std::vector<std::uint64_t>& shape, const std::string& source,
                      const char* dtype = dtype_of<T>()) {
  const Array& found = array(contents, name, dtype, shape, source);
  std::vector<T> result(found.bytes / sizeof(T));
  if (found.bytes > 0) std::memcpy(result.data(), found.data, found.bytes);
  return result;
}

/// A metadata entry that must be there. Throws FileError.
const std::string& entry(const Contents& contents, const std::string& name,
                         const std::string& source);

}  // namespace devlearn::safetensors
