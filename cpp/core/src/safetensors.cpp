#include "safetensors.hpp"

#include <algorithm>
#include <cstring>
#include <istream>
#include <limits>
#include <optional>
#include <ostream>
#include <string_view>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "excerpt.hpp"
#include "json.hpp"

namespace devlearn::safetensors {
namespace {

constexpr json::Limits kHeader{std::size_t{100} << 20, 3, 100'000};
constexpr std::size_t kChecksumDigits = 16;
constexpr std::size_t kAlignment = 8;

constexpr const char* kChecksum = "checksum";
constexpr const char* kMetadata = "__metadata__";

std::size_t size_of(const std::string& dtype) {
  static const std::map<std::string, std::size_t> sizes{{"F64", 8}, {"I64", 8}, {"U64", 8},
                                                        {"I32", 4}, {"U32", 4}, {"U16", 2},
                                                        {"U8", 1},  {"BOOL", 1}};
  const auto found = sizes.find(dtype);
  return found == sizes.end() ? 0 : found->second;
}

// FNV-1a, 64 bits: any single changed byte changes it.
std::uint64_t fnv(std::uint64_t hash, const void* data, std::size_t size) {
  const auto* const bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 0x100000001b3U;
  return hash;
}
std::uint64_t fnv(std::uint64_t hash, std::string_view text) {
  return fnv(hash, text.data(), text.size());
}

constexpr std::uint64_t kFnvStart = 0xcbf29ce484222325U;

std::string hexadecimal(std::uint64_t value) {
  std::string digits(kChecksumDigits, '0');
  for (std::size_t i = kChecksumDigits; i-- > 0; value >>= 4) {
    digits[i] = "0123456789abcdef"[value & 15];
  }
  return digits;
}

// Unlike json::quoted, with \u for every control character: so that bytes stay what they were.
std::string quoted(const std::string& text) {
  std::string json = "\"";
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    if (letter == '"' || letter == '\\') {
      json += '\\';
      json += letter;
    } else if (code < 0x20) {
      json += "\\u" + hexadecimal(code).substr(kChecksumDigits - 4);
    } else {
      json += letter;
    }
  }
  return json + '"';
}

constexpr const char* kTypes = "one of F64, I64, U64, I32, U32, U16, U8, BOOL";

// Bytes that an array of this type and shape takes, if 64 bits can count them.
std::optional<std::uint64_t> bytes_of(const Array& array) {
  std::uint64_t bytes = size_of(array.dtype);
  for (const std::uint64_t length : array.shape) {
    if (length != 0 && bytes > std::numeric_limits<std::uint64_t>::max() / length) {
      return std::nullopt;
    }
    bytes *= length;
  }
  return bytes;
}

// The largest elements first, so that every array is aligned to its own.
std::vector<const Array*> in_order(const Arrays& arrays) {
  std::vector<const Array*> order;
  for (const auto& [name, array] : arrays) order.push_back(&array);
  std::stable_sort(order.begin(), order.end(), [](const Array* a, const Array* b) {
    return size_of(a->dtype) > size_of(b->dtype);
  });
  return order;
}

// Eight bytes of length, and the header.
std::vector<std::byte> header(Metadata metadata, const Arrays& arrays) {
  metadata[kChecksum] = std::string(kChecksumDigits, '0');
  std::string text = "{" + quoted(kMetadata) + ":{";
  std::size_t checksum_at = 0;
  for (const auto& [key, value] : metadata) {
    if (text.back() != '{') text += ',';
    text += quoted(key) + ":";
    if (key == kChecksum) checksum_at = text.size() + 1;
    text += quoted(value);
  }
  text += "}";
  std::map<const Array*, std::uint64_t> begins;
  std::uint64_t offset = 0;
  for (const Array* array : in_order(arrays)) {
    begins[array] = offset;
    offset += array->bytes;
  }
  for (const auto& [name, array] : arrays) {
    text += "," + quoted(name) + ":{\"dtype\":" + quoted(array.dtype) + ",\"shape\":[";
    for (const std::uint64_t length : array.shape) {
      if (text.back() != '[') text += ',';
      text += std::to_string(length);
    }
    const std::uint64_t begin = begins[&array];
    text += "],\"data_offsets\":[" + std::to_string(begin) + "," +
            std::to_string(begin + array.bytes) + "]}";
  }
  text += "}";
  text.resize((text.size() + kAlignment - 1) / kAlignment * kAlignment, ' ');
  require_count("header", static_cast<long long>(text.size()), 0, kHeader.bytes);

  std::uint64_t hash = fnv(kFnvStart, text);
  for (const Array* array : in_order(arrays)) hash = fnv(hash, array->data.get(), array->bytes);
  text.replace(checksum_at, kChecksumDigits, hexadecimal(hash));

  std::vector<std::byte> bytes(kLengthBytes + text.size());
  for (std::size_t i = 0; i < kLengthBytes; ++i) {
    bytes[i] = static_cast<std::byte>(text.size() >> (8 * i) & 255);
  }
  std::memcpy(bytes.data() + kLengthBytes, text.data(), text.size());
  return bytes;
}

}  // namespace

void require_readable(const Contents& contents) {
  std::size_t values = 3 + contents.metadata.size();  // the header, the metadata, the checksum
  for (const auto& [name, array] : contents.arrays) {
    if (size_of(array.dtype) == 0) {
      throw InvalidValue(excerpt(name) + ".dtype", excerpt(array.dtype), kTypes);
    }
    if (bytes_of(array) != array.bytes) {
      throw InvalidValue(excerpt(name) + ".shape", std::to_string(array.bytes) + " bytes",
                         "as many as dtype and shape make");
    }
    values += 6 + array.shape.size();  // an array, its dtype, shape, and data_offsets with two
  }
  require_count("texts and arrays", static_cast<long long>(values), 0, kHeader.values);
}

void write(const Contents& contents, const Write& write) {
  const std::vector<std::byte> head = header(contents.metadata, contents.arrays);
  write(head.data(), head.size());
  for (const Array* array : in_order(contents.arrays)) write(array->data.get(), array->bytes);
}

void write(const Contents& contents, std::ostream& stream) {
  write(contents, [&](const std::byte* data, std::size_t size) {
    stream.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  });
}

std::size_t header_length(const std::byte* bytes, std::uint64_t size, const std::string& source) {
  if (size < kLengthBytes) {
    throw FileError(source, "", std::to_string(size) + " bytes", "a snapshot: at least 8 bytes");
  }
  std::uint64_t length = 0;
  for (std::size_t i = kLengthBytes; i-- > 0;) {
    length = length << 8 | static_cast<std::uint64_t>(bytes[i]);
  }
  if (length > size - kLengthBytes) {
    throw FileError(source, "header length", std::to_string(length),
                    "at most " + std::to_string(size - kLengthBytes) +
                        " bytes; the file is cut off, or no snapshot");
  }
  if (length > kHeader.bytes) {
    throw FileError(source, "header length", std::to_string(length),
                    "at most " + std::to_string(kHeader.bytes) + " bytes");
  }
  return static_cast<std::size_t>(length);
}

std::uint64_t data_described(std::string_view header, const std::string& source) {
  const json::Document document(header, source, kHeader, "header");
  std::uint64_t described = 0;
  document.root().each_field([&](const std::string& name, const json::Node& field) {
    if (name == kMetadata) return;
    const json::Node offsets = field["data_offsets"];
    if (offsets.size() == 2) described = std::max(described, offsets[1].whole_number());
  });
  return described;
}

std::vector<std::byte> to_bytes(const Contents& contents) {
  std::vector<std::byte> bytes;
  write(contents, [&](const std::byte* data, std::size_t size) {
    bytes.insert(bytes.end(), data, data + size);
  });
  return bytes;
}

std::vector<std::byte> read_stream(std::istream& stream) {
  std::vector<std::byte> bytes;
  char part[1 << 16];
  while (stream.read(part, sizeof part), stream.gcount() > 0) {
    const auto* const data = reinterpret_cast<const std::byte*>(part);
    bytes.insert(bytes.end(), data, data + stream.gcount());
  }
  return bytes;
}

namespace {

// An array as the header describes it.
Array array_at(const json::Node& described, const std::byte* data, std::size_t data_size) {
  described.require_known({"dtype", "shape", "data_offsets"});
  Array array;
  const json::Node dtype = described["dtype"], shape = described["shape"];
  array.dtype = dtype.text();
  if (size_of(array.dtype) == 0) dtype.refuse(kTypes);
  shape.each_element(
      [&](const json::Node& element) { array.shape.push_back(element.whole_number()); });
  const std::optional<std::uint64_t> bytes = bytes_of(array);
  if (!bytes) shape.refuse("more than 2^64 bytes", "what the file holds");

  const json::Node offsets = described["data_offsets"];
  if (offsets.size() != 2) offsets.refuse("[begin, end]");
  const std::uint64_t begin = offsets[0].whole_number(), end = offsets[1].whole_number();
  if (begin > end || end > data_size) {
    offsets.refuse("a range outside the file",
                   "[begin, end] within the " + std::to_string(data_size) + " bytes of data");
  }
  if (*bytes != end - begin) {
    shape.refuse(std::to_string(end - begin) + " bytes", "as many as dtype and shape make");
  }
  array.data = {std::shared_ptr<const void>(), data + begin};
  array.bytes = static_cast<std::size_t>(end - begin);
  return array;
}

Contents described_by(const json::Node& header, const std::byte* data, std::size_t data_size) {
  Contents contents;
  header.each_field([&](const std::string& name, const json::Node& field) {
    if (name != kMetadata) {
      contents.arrays[name] = array_at(field, data, data_size);
      return;
    }
    field.each_field([&](const std::string& key, const json::Node& value) {
      contents.metadata[key] = value.text();
    });
  });
  return contents;
}

// Arrays lie side by side, and fill the data.
void require_gapless(const Arrays& arrays, const std::byte* data, std::size_t data_size,
                     const std::string& source) {
  std::vector<const Arrays::value_type*> order;
  for (const auto& named : arrays) order.push_back(&named);
  std::sort(order.begin(), order.end(), [](const auto* a, const auto* b) {
    return std::pair(a->second.data.get(), a->second.bytes) <
           std::pair(b->second.data.get(), b->second.bytes);
  });
  std::size_t covered = 0;
  for (const auto* named : order) {
    const auto begin = static_cast<std::size_t>(named->second.data.get() - data);
    if (begin != covered) {
      throw FileError(source, excerpt(named->first) + ".data_offsets", std::to_string(begin),
                      std::to_string(covered) + ": arrays side by side");
    }
    covered += named->second.bytes;
  }
  if (covered != data_size) {
    throw FileError(source, "",
                    std::to_string(data_size - covered) + " bytes beyond the last array", "none");
  }
}

// It is over the header with the checksum's own digits as zeros, and the data.
void require_checksum(const std::string& found, std::string_view header, const std::byte* data,
                      std::size_t data_size, const std::string& source) {
  const std::size_t place = header.find('"' + found + '"');
  if (found.size() != kChecksumDigits || place == header.npos) {
    throw FileError(source, kChecksum, excerpt(found), "16 hexadecimal digits");
  }
  std::uint64_t hash = fnv(kFnvStart, header.substr(0, place + 1));
  hash = fnv(hash, std::string(kChecksumDigits, '0'));
  hash = fnv(hash, header.substr(place + 1 + kChecksumDigits));
  hash = fnv(hash, data, data_size);
  if (found != hexadecimal(hash)) {
    throw FileError(source, kChecksum, excerpt(found),
                    hexadecimal(hash) + "; the file was damaged");
  }
}

}  // namespace

Contents read(const std::byte* bytes, std::size_t size, const std::string& source) {
  const std::size_t length = header_length(bytes, size, source);
  const std::string_view header(reinterpret_cast<const char*>(bytes) + kLengthBytes, length);
  const std::byte* const data = bytes + kLengthBytes + length;
  const std::size_t data_size = size - kLengthBytes - length;

  const json::Document document(header, source, kHeader, "header");
  Contents contents = described_by(document.root(), data, data_size);
  require_gapless(contents.arrays, data, data_size, source);
  require_checksum(entry(contents, kChecksum, source), header, data, data_size, source);
  return contents;
}

const std::string& entry(const Contents& contents, const std::string& name,
                         const std::string& source) {
  const auto found = contents.metadata.find(name);
  if (found == contents.metadata.end()) {
    throw FileError(source, std::string(kMetadata) + "." + name, "nothing", "an entry");
  }
  return found->second;
}

}  // namespace devlearn::safetensors
