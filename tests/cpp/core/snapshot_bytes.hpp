#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

/// A snapshot's bytes taken apart, to be told lies that its checksum does not give away.
struct SnapshotBytes {
  std::string header;
  std::vector<std::byte> data;

  explicit SnapshotBytes(const std::vector<std::byte>& bytes) {
    std::size_t length = 0;
    for (std::size_t i = 8; i-- > 0;) length = length << 8 | static_cast<std::size_t>(bytes[i]);
    header.assign(reinterpret_cast<const char*>(bytes.data()) + 8, length);
    data.assign(bytes.begin() + 8 + static_cast<std::ptrdiff_t>(length), bytes.end());
  }

  /// Puts a text in the header in place of another; false where that is not there.
  bool replace(const std::string& from, const std::string& to) {
    const std::size_t at = header.find(from);
    if (at == std::string::npos) return false;
    header.replace(at, from.size(), to);
    return true;
  }

  /// An entry's value.
  std::string entry(const std::string& name) const {
    const std::size_t at = header.find("\"" + name + "\":\"") + name.size() + 4;
    return header.substr(at, header.find('"', at) - at);
  }
  bool set_entry(const std::string& name, const std::string& value) {
    return replace("\"" + name + "\":\"" + entry(name) + "\"",
                   "\"" + name + "\":\"" + value + "\"");
  }

  /// Where an array's values stand in the data.
  std::size_t begin(const std::string& array) const {
    const std::size_t at = header.find("\"data_offsets\":[", header.find("\"" + array + "\":{"));
    return std::stoul(header.substr(at + 16));
  }
  template <typename T>
  void set(const std::string& array, std::size_t i, T value) {
    std::memcpy(data.data() + begin(array) + i * sizeof(T), &value, sizeof(T));
  }

  /// The bytes again, with a checksum that fits: FNV-1a over the header with the checksum's digits
  /// as zeros, and the data.
  std::vector<std::byte> mended() const {
    std::string text = header;
    const std::size_t at = text.find("\"checksum\":\"");
    if (at != std::string::npos) text.replace(at + 12, 16, 16, '0');
    std::uint64_t hash = 0xcbf29ce484222325U;
    const auto add = [&](std::byte byte) {
      hash = (hash ^ static_cast<std::uint64_t>(byte)) * 0x100000001b3U;
    };
    for (const char letter : text) add(static_cast<std::byte>(letter));
    for (const std::byte byte : data) add(byte);
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
    if (at != std::string::npos) text.replace(at + 12, 16, digits);
    std::vector<std::byte> bytes(8);
    for (std::size_t i = 0; i < 8; ++i) bytes[i] = static_cast<std::byte>(text.size() >> 8 * i);
    for (const char letter : text) bytes.push_back(static_cast<std::byte>(letter));
    bytes.insert(bytes.end(), data.begin(), data.end());
    return bytes;
  }
};
