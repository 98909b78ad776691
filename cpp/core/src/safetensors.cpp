#include "safetensors.hpp"

#include <algorithm>
#include <cstring>
#include <istream>
#include <limits>
#include <ostream>
#include <set>

#include "devlearn/error.hpp"
#include "excerpt.hpp"
#include "file.hpp"

namespace devlearn::safetensors {
namespace {

constexpr std::size_t kLengthBytes = 8;
constexpr std::size_t kLongestHeader = std::size_t{100} << 20;
constexpr std::size_t kMostKeys = 1000;  // of an object
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
std::uint64_t fnv(const std::byte* bytes, std::size_t size, std::uint64_t hash) {
  for (std::size_t i = 0; i < size; ++i) {
    hash = (hash ^ static_cast<std::uint64_t>(bytes[i])) * 0x100000001b3U;
  }
  return hash;
}

constexpr std::uint64_t kFnvStart = 0xcbf29ce484222325U;

std::string hexadecimal(std::uint64_t value) {
  std::string digits(kChecksumDigits, '0');
  for (std::size_t i = kChecksumDigits; i-- > 0; value >>= 4) {
    digits[i] = "0123456789abcdef"[value & 15];
  }
  return digits;
}

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

// Reads the header's text from left to right.
class Reader {
 public:
  Reader(const char* begin, const char* end, const std::string& source)
      : begin_(begin), next_(begin), end_(end), source_(source) {}

  [[noreturn]] void refuse(const std::string& what, const std::string& allowed) const {
    throw FileError(source_, "header, byte " + std::to_string(next_ - begin_), what, allowed);
  }

  char peek() {
    while (next_ != end_ && (*next_ == ' ' || *next_ == '\n' || *next_ == '\t' || *next_ == '\r')) {
      ++next_;
    }
    return next_ == end_ ? '\0' : *next_;
  }

  void expect(char letter) {
    if (peek() != letter) refuse(next_ == end_ ? "the end" : excerpt({*next_}), {letter});
    ++next_;
  }

  // Calls item() for each, between brackets, with commas between.
  template <typename Item>
  void list(char open, char close, const Item& item) {
    expect(open);
    if (peek() == close) {
      ++next_;
      return;
    }
    for (;;) {
      item();
      if (peek() != ',') break;
      ++next_;
    }
    expect(close);
  }

  // Calls member(key) for each, no key twice.
  template <typename Member>
  void object(const Member& member) {
    std::set<std::string> keys;
    list('{', '}', [&] {
      const std::string key = string();
      if (!keys.insert(key).second) refuse("the key " + excerpt(key) + " again", "each key once");
      if (keys.size() > kMostKeys) {
        refuse("another key", "at most " + std::to_string(kMostKeys) + " keys");
      }
      expect(':');
      member(key);
    });
  }

  std::string string() {
    expect('"');
    std::string text;
    while (next_ != end_ && *next_ != '"') {
      if (static_cast<unsigned char>(*next_) < 0x20) refuse("a control character", "an escape");
      if (*next_ == '\\') {
        ++next_;
        escape(text);
      } else {
        text += *next_++;
      }
    }
    if (next_ == end_) refuse("the end", "the end of a string first");
    ++next_;
    return text;
  }

  std::uint64_t whole_number() {
    peek();
    const char* const first = next_;
    std::uint64_t value = 0;
    for (; next_ != end_ && *next_ >= '0' && *next_ <= '9'; ++next_) {
      const auto digit = static_cast<std::uint64_t>(*next_ - '0');
      if (value > (std::numeric_limits<std::uint64_t>::max() - digit) / 10) {
        refuse("a number beyond 2^64 - 1", "a whole number of 64 bits");
      }
      value = value * 10 + digit;
    }
    if (next_ == first) refuse("no number", "a whole number, at least 0");
    return value;
  }

  void expect_end() {
    if (peek() != '\0' || next_ != end_) refuse("more text", "the end of the header");
  }

  const char* position() const { return next_; }

 private:
  void escape(std::string& text) {
    if (next_ == end_) refuse("the end", "an escape");
    static constexpr char kLetters[] = "\"\\/bfnrt", kMeant[] = "\"\\/\b\f\n\r\t";
    const char letter = *next_++;
    if (letter == 'u') {
      append_utf8(text, code_unit());
      return;
    }
    const char* const found = letter == '\0' ? nullptr : std::strchr(kLetters, letter);
    if (found == nullptr)
      refuse("an unknown escape", "one of \\\" \\\\ \\/ \\b \\f \\n \\r \\t \\u");
    text += kMeant[found - kLetters];
  }

  std::uint32_t code_unit() {
    std::uint32_t code = 0;
    for (int i = 0; i < 4; ++i, ++next_) {
      static constexpr char kDigits[] = "0123456789abcdefABCDEF";
      const char* const found =
          next_ == end_ || *next_ == '\0' ? nullptr : std::strchr(kDigits, *next_);
      if (found == nullptr) refuse("a broken escape", "four hexadecimal digits");
      const auto digit = static_cast<std::uint32_t>(found - kDigits);
      code = code * 16 + (digit < 16 ? digit : digit - 6);
    }
    return code;
  }

  void append_utf8(std::string& text, std::uint32_t code) {
    if (code >= 0xd800 && code < 0xdc00) {
      if (end_ - next_ < 6 || next_[0] != '\\' || next_[1] != 'u') {
        refuse("half a surrogate pair", "both halves");
      }
      next_ += 2;
      const std::uint32_t low = code_unit();
      if (low < 0xdc00 || low >= 0xe000) refuse("half a surrogate pair", "both halves");
      code = 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00);
    } else if (code >= 0xdc00 && code < 0xe000) {
      refuse("half a surrogate pair", "both halves");
    }
    const auto append = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
    if (code < 0x80) {
      append(code);
    } else if (code < 0x800) {
      append(0xc0 | code >> 6);
      append(0x80 | (code & 63));
    } else if (code < 0x10000) {
      append(0xe0 | code >> 12);
      append(0x80 | (code >> 6 & 63));
      append(0x80 | (code & 63));
    } else {
      append(0xf0 | code >> 18);
      append(0x80 | (code >> 12 & 63));
      append(0x80 | (code >> 6 & 63));
      append(0x80 | (code & 63));
    }
  }

  const char* begin_;
  const char* next_;
  const char* end_;
  const std::string& source_;
};

struct Range {
  std::uint64_t begin = 0, end = 0;
};

// Bytes of an array of this shape; no overflow.
std::uint64_t bytes_of(const Array& array, const std::string& field, const std::string& source) {
  std::uint64_t bytes = size_of(array.dtype);
  if (bytes == 0) {
    throw FileError(source, field + ".dtype", excerpt(array.dtype),
                    "one of F64, I64, U64, I32, U32, U16, U8, BOOL");
  }
  for (const std::uint64_t length : array.shape) {
    if (length != 0 && bytes > std::numeric_limits<std::uint64_t>::max() / length) {
      throw FileError(source, field + ".shape", "more than 2^64 bytes", "what the file holds");
    }
    bytes *= length;
  }
  return bytes;
}

}  // namespace

template <>
const char* dtype_of<double>() {
  return "F64";
}
template <>
const char* dtype_of<std::int64_t>() {
  return "I64";
}
template <>
const char* dtype_of<std::uint64_t>() {
  return "U64";
}
template <>
const char* dtype_of<std::int32_t>() {
  return "I32";
}
template <>
const char* dtype_of<std::uint32_t>() {
  return "U32";
}
template <>
const char* dtype_of<std::uint16_t>() {
  return "U16";
}
template <>
const char* dtype_of<std::uint8_t>() {
  return "U8";
}
template <>
const char* dtype_of<bool>() {
  return "BOOL";
}

namespace {

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
  std::map<const Array*, Range> ranges;
  std::uint64_t offset = 0;
  for (const Array* array : in_order(arrays)) {
    ranges[array] = {offset, offset + array->bytes};
    offset += array->bytes;
  }
  for (const auto& [name, array] : arrays) {
    text += "," + quoted(name) + ":{\"dtype\":" + quoted(array.dtype) + ",\"shape\":[";
    for (const std::uint64_t length : array.shape) {
      if (text.back() != '[') text += ',';
      text += std::to_string(length);
    }
    const Range range = ranges[&array];
    text += "],\"data_offsets\":[" + std::to_string(range.begin) + "," + std::to_string(range.end) +
            "]}";
  }
  text += "}";
  text.resize((text.size() + kAlignment - 1) / kAlignment * kAlignment, ' ');

  std::uint64_t hash = fnv(reinterpret_cast<const std::byte*>(text.data()), text.size(), kFnvStart);
  for (const Array* array : in_order(arrays)) hash = fnv(array->data, array->bytes, hash);
  text.replace(checksum_at, kChecksumDigits, hexadecimal(hash));

  std::vector<std::byte> bytes(kLengthBytes + text.size());
  for (std::size_t i = 0; i < kLengthBytes; ++i) {
    bytes[i] = static_cast<std::byte>(text.size() >> (8 * i) & 255);
  }
  std::memcpy(bytes.data() + kLengthBytes, text.data(), text.size());
  return bytes;
}

}  // namespace

void write(const Contents& contents, const Write& write) {
  const std::vector<std::byte> head = header(contents.metadata, contents.arrays);
  write(head.data(), head.size());
  for (const Array* array : in_order(contents.arrays)) write(array->data, array->bytes);
}

void write(const Contents& contents, const std::string& path) {
  SideFile file(path);
  write(contents, [&](const std::byte* data, std::size_t size) { file.write(data, size); });
  file.commit();
}

void write(const Contents& contents, std::ostream& stream) {
  write(contents, [&](const std::byte* data, std::size_t size) {
    stream.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  });
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

Contents read(const std::byte* bytes, std::size_t size, const std::string& source) {
  const auto refuse = [&](const std::string& field, const std::string& value,
                          const std::string& allowed) -> void {
    throw FileError(source, field, value, allowed);
  };
  if (size < kLengthBytes) {
    refuse("", std::to_string(size) + " bytes", "a snapshot: at least 8 bytes");
  }
  std::uint64_t length = 0;
  for (std::size_t i = kLengthBytes; i-- > 0;) {
    length = length << 8 | static_cast<std::uint64_t>(bytes[i]);
  }
  if (length > size - kLengthBytes || length > kLongestHeader) {
    refuse("header length", std::to_string(length),
           "at most " + std::to_string(std::min(size - kLengthBytes, kLongestHeader)) +
               " bytes; the file is cut off, or no snapshot");
  }
  const auto* const text = reinterpret_cast<const char*>(bytes) + kLengthBytes;
  const std::byte* const data = bytes + kLengthBytes + length;
  const std::uint64_t data_size = size - kLengthBytes - length;

  Contents contents;
  std::vector<std::pair<Range, std::string>> ranges;
  std::size_t checksum_at = 0;
  Reader reader(text, text + length, source);
  reader.object([&](const std::string& name) {
    if (name == kMetadata) {
      reader.object([&](const std::string& key) {
        contents.metadata[key] = reader.string();
        if (key == kChecksum) {
          checksum_at = static_cast<std::size_t>(reader.position() - text) - 1 - kChecksumDigits;
        }
      });
      return;
    }
    Array array;
    std::vector<std::uint64_t> offsets;
    reader.object([&](const std::string& key) {
      if (key == "dtype") {
        array.dtype = reader.string();
      } else if (key == "shape") {
        reader.list('[', ']', [&] { array.shape.push_back(reader.whole_number()); });
      } else if (key == "data_offsets") {
        reader.list('[', ']', [&] { offsets.push_back(reader.whole_number()); });
      } else {
        reader.refuse("the key " + excerpt(key), "dtype, shape and data_offsets");
      }
    });
    if (offsets.size() != 2 || offsets[0] > offsets[1] || offsets[1] > data_size) {
      refuse(excerpt(name) + ".data_offsets", "a range outside the file",
             "[begin, end] within the " + std::to_string(data_size) + " bytes of data");
    }
    if (bytes_of(array, excerpt(name), source) != offsets[1] - offsets[0]) {
      refuse(excerpt(name) + ".shape", std::to_string(offsets[1] - offsets[0]) + " bytes",
             "as many as dtype and shape make");
    }
    array.data = data + offsets[0];
    array.bytes = offsets[1] - offsets[0];
    ranges.push_back({{offsets[0], offsets[1]}, name});
    contents.arrays[name] = std::move(array);
  });
  reader.expect_end();

  std::sort(ranges.begin(), ranges.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first.begin, a.first.end) < std::pair(b.first.begin, b.first.end);
  });
  std::uint64_t covered = 0;
  for (const auto& [range, name] : ranges) {
    if (range.begin != covered) {
      refuse(excerpt(name) + ".data_offsets", std::to_string(range.begin),
             std::to_string(covered) + ": arrays side by side");
    }
    covered = range.end;
  }
  if (covered != data_size) {
    refuse("", std::to_string(data_size - covered) + " bytes beyond the last array", "none");
  }

  // Over the header with the checksum's digits as zeros, and the data.
  const std::string& found = entry(contents, kChecksum, source);
  if (found.size() != kChecksumDigits) refuse(kChecksum, excerpt(found), "16 hexadecimal digits");
  std::string zeroed(text, length);
  zeroed.replace(checksum_at, kChecksumDigits, kChecksumDigits, '0');
  const std::uint64_t hash =
      fnv(data, data_size,
          fnv(reinterpret_cast<const std::byte*>(zeroed.data()), zeroed.size(), kFnvStart));
  if (found != hexadecimal(hash)) {
    refuse(kChecksum, excerpt(found), hexadecimal(hash) + "; the file was damaged");
  }
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

const Array& array(const Contents& contents, const std::string& name, const char* dtype,
                   const std::vector<std::uint64_t>& shape, const std::string& source) {
  const auto found = contents.arrays.find(name);
  if (found == contents.arrays.end()) throw FileError(source, name, "nothing", "an array");
  const auto shown = [](const std::string& type, const std::vector<std::uint64_t>& lengths) {
    std::string text = type;
    for (const std::uint64_t length : lengths) text += " x " + std::to_string(length);
    return text;
  };
  const Array& array = found->second;
  if (array.dtype != dtype || array.shape != shape) {
    throw FileError(source, name, excerpt(shown(array.dtype, array.shape)), shown(dtype, shape));
  }
  return array;
}

}  // namespace devlearn::safetensors
