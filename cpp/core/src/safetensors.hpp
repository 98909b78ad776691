#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "devlearn/state.hpp"

// The safetensors layout: eight bytes of header length (little-endian), a JSON header, then plain
// arrays.
namespace devlearn::safetensors {

using Array = StateArray;
using Arrays = StateArrays;
using Metadata = std::map<std::string, std::string>;

/// What a file holds; the arrays point into the bytes it was read from, or into what is saved.
struct Contents {
  Metadata metadata;
  Arrays arrays;
};

/// Throws InvalidValue for contents that could not be read again: too many, or arrays of other
/// types or sizes than they say.
void require_readable(const Contents& contents);

/// The file's bytes, piece by piece. The metadata's entry `checksum` is added: see docs. Throws
/// InvalidValue for a header that is too long to be read again.
using Write = std::function<void(const std::byte* data, std::size_t size)>;
void write(const Contents& contents, const Write& write);
/// To a path, as SideFile does it. Throws FileError.
void write(const Contents& contents, const std::string& path);
/// To a stream, which is in a failed state afterwards where it could not take everything.
void write(const Contents& contents, std::ostream& stream);
std::vector<std::byte> to_bytes(const Contents& contents);

/// A snapshot begins with so many bytes that say how long its header is.
constexpr std::size_t kLengthBytes = 8;
/// How long that is, where these are the first of `size` bytes. Throws FileError.
std::size_t header_length(const std::byte* bytes, std::uint64_t size, const std::string& source);
/// How many bytes of data a header describes. Throws FileError.
std::uint64_t data_described(std::string_view header, const std::string& source);

/// All of a file. What its header does not describe, or no memory here could hold, is refused
/// before it is read. Throws FileError.
std::vector<std::byte> read_file(const std::string& path);
/// All of a stream.
std::vector<std::byte> read_stream(std::istream& stream);

/// Checks everything that does not depend on what the arrays mean: lengths, offsets without overlap
/// or hole, dtypes, shapes, the checksum. Throws FileError naming `source`.
Contents read(const std::byte* bytes, std::size_t size, const std::string& source);

/// The values of an array that must be there, with this type and shape. Throws FileError.
template <typename T>
std::vector<T> values(const Contents& contents, const std::string& name, const Shape& shape,
                      const std::string& source, const char* dtype = dtype_of<T>()) {
  try {
    return values_of<T>(contents.arrays, name, shape, dtype);
  } catch (const InvalidValue& error) {
    throw FileError(source, error.quantity(), error.value(), error.allowed());
  }
}

/// A metadata entry that must be there. Throws FileError.
const std::string& entry(const Contents& contents, const std::string& name,
                         const std::string& source);

}  // namespace devlearn::safetensors
