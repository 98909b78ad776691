#include "snapshot.hpp"

#include <algorithm>
#include <string>
#include <string_view>

namespace devlearn::fuzz {
namespace {

constexpr std::size_t kLengthBytes = 8, kDigits = 16;
constexpr std::string_view kEntry = "\"checksum\":\"";

std::uint64_t fnv(const std::vector<std::byte>& bytes, std::size_t from) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (std::size_t i = from; i < bytes.size(); ++i) {
    hash = (hash ^ static_cast<std::uint64_t>(bytes[i])) * 0x100000001b3U;
  }
  return hash;
}

}  // namespace

std::vector<std::byte> mended(const std::uint8_t* data, std::size_t size) {
  const auto* const first = reinterpret_cast<const std::byte*>(data);
  std::vector<std::byte> bytes(first, first + size);
  if (size < kLengthBytes) return bytes;

  std::uint64_t length = 0;
  for (std::size_t i = kLengthBytes; i-- > 0;) length = length << 8 | data[i];
  // A wrong length is as good as any other, but for a last byte that only ever refuses.
  length %= std::max<std::uint64_t>(1, size - kLengthBytes + 1);
  for (std::size_t i = 0; i < kLengthBytes; ++i) {
    bytes[i] = static_cast<std::byte>(length >> (8 * i) & 255);
  }

  const std::string_view header(reinterpret_cast<const char*>(data) + kLengthBytes,
                                static_cast<std::size_t>(length));
  const std::size_t found = header.find(kEntry);
  const std::size_t digits = kLengthBytes + found + kEntry.size();
  if (found == header.npos || digits + kDigits > kLengthBytes + length) return bytes;
  for (std::size_t i = 0; i < kDigits; ++i) bytes[digits + i] = static_cast<std::byte>('0');
  std::uint64_t hash = fnv(bytes, kLengthBytes);
  for (std::size_t i = kDigits; i-- > 0; hash >>= 4) {
    bytes[digits + i] = static_cast<std::byte>("0123456789abcdef"[hash & 15]);
  }
  return bytes;
}

}  // namespace devlearn::fuzz
