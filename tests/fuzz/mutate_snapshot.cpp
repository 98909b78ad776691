#include <algorithm>
#include <cstring>
#include <iterator>
#include <map>
#include <memory>
#include <vector>

#include "devlearn/error.hpp"
#include "mutate.hpp"
#include "safetensors.hpp"
#include "snapshot.hpp"

using namespace devlearn;

namespace {

constexpr const char* kTypes[] = {"F64", "I64", "U64", "I32", "U32", "U16", "U8", "BOOL", "F32"};
constexpr std::uint64_t kWords[] = {0,
                                    1,
                                    2,
                                    0xffff,
                                    0xffffffff,
                                    0x7fffffffffffffff,
                                    0x8000000000000000,  // the least I64, and -0.0
                                    0xffffffffffffffff,
                                    0x3ff0000000000000,   // 1.0
                                    0x3fe0000000000000,   // 0.5
                                    0x3fefffffffffffff,   // just below 1.0
                                    0x7ff0000000000000,   // infinite
                                    0x7ff8000000000000};  // NaN

// A snapshot taken to pieces.
class Pieces {
 public:
  explicit Pieces(const safetensors::Contents& contents) : metadata_(contents.metadata) {
    for (const auto& [name, array] : contents.arrays) {
      const auto* const first = reinterpret_cast<const char*>(array.data.get());
      arrays_[name] = {array.dtype, array.shape, std::string(first, array.bytes)};
    }
  }

  void mutate(Random& random) {
    if (metadata_.empty() || arrays_.empty()) return;
    switch (random.index(12)) {
      case 0:
        fuzz::mutate_bytes(any(metadata_, random));
        break;
      case 1:
      case 2:
      case 3:
        fuzz::mutate_number(any(metadata_, random), random);
        break;
      case 4:
        any(metadata_, random) = any(metadata_, random);
        break;
      case 5:
        resize(random);
        break;
      case 6:
        rename(random);
        break;
      case 7:
        reshape(any(arrays_, random), random);
        break;
      default:
        set_element(any(arrays_, random), random);
    }
  }

  std::string text() const {
    safetensors::Contents contents{metadata_, {}};
    for (const auto& [name, piece] : arrays_) {
      const auto* const first = reinterpret_cast<const std::byte*>(piece.data.data());
      contents.arrays[name] = {
          piece.dtype, piece.shape, {std::shared_ptr<const void>(), first}, piece.data.size()};
    }
    const std::vector<std::byte> bytes = safetensors::to_bytes(contents);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

 private:
  struct Piece {
    std::string dtype;
    Shape shape;
    std::string data;
  };

  template <typename Map>
  static typename Map::mapped_type& any(Map& map, Random& random) {
    return std::next(map.begin(), random.index(static_cast<std::uint32_t>(map.size())))->second;
  }

  static std::size_t rows_of(const Piece& piece) {
    return piece.shape.empty() ? 0 : static_cast<std::size_t>(piece.shape[0]);
  }

  // One element gets another one's bits, a special value, or others.
  static void set_element(Piece& piece, Random& random) {
    const std::size_t width = piece.dtype.find("64") != std::string::npos   ? 8
                              : piece.dtype.find("32") != std::string::npos ? 4
                              : piece.dtype.find("16") != std::string::npos ? 2
                                                                            : 1;
    const auto count = static_cast<std::uint32_t>(piece.data.size() / width);
    if (count == 0) return;
    char* const element = piece.data.data() + random.index(count) * width;
    switch (random.index(3)) {
      case 0:
        std::memmove(element, piece.data.data() + random.index(count) * width, width);
        break;
      case 1:
        std::memcpy(element, &kWords[random.index(std::size(kWords))], width);
        break;
      default:
        element[random.index(static_cast<std::uint32_t>(width))] =
            static_cast<char>(random.index(256));
    }
  }

  static void reshape(Piece& piece, Random& random) {
    switch (random.index(3)) {
      case 0:
        piece.dtype = kTypes[random.index(std::size(kTypes))];
        break;
      case 1:
        piece.shape.push_back(random.index(3));
        break;
      default:
        if (!piece.shape.empty()) piece.shape.back() = kWords[random.index(std::size(kWords))];
    }
  }

  void rename(Random& random) {
    const auto chosen =
        std::next(arrays_.begin(), random.index(static_cast<std::uint32_t>(arrays_.size())));
    std::string name = chosen->first;
    fuzz::mutate_bytes(name);
    Piece piece = std::move(chosen->second);
    if (random.index(2) == 0) arrays_.erase(chosen);
    arrays_[name] = std::move(piece);
  }

  // All arrays of as many rows as one has get a row more or less, and the entries that say so.
  void resize(Random& random) {
    const std::size_t rows = rows_of(any(arrays_, random));
    if (rows == 0) return;
    const bool more = random.index(2) == 0;
    const auto row = random.index(static_cast<std::uint32_t>(rows));
    for (auto& [name, piece] : arrays_) {
      if (rows_of(piece) != rows) continue;
      const std::size_t width = piece.data.size() / rows;
      if (more) {
        piece.data.insert(row * width, piece.data, row * width, width);
      } else {
        piece.data.erase(row * width, width);
      }
      piece.shape[0] = more ? rows + 1 : rows - 1;
    }
    for (auto& [key, value] : metadata_) {
      if (value == std::to_string(rows)) value = std::to_string(more ? rows + 1 : rows - 1);
    }
  }

  safetensors::Metadata metadata_;
  std::map<std::string, Piece> arrays_;
};

std::string mutated(const std::uint8_t* data, std::size_t size, Random& random) {
  const std::vector<std::byte> bytes = fuzz::mended(data, size);
  std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (random.index(8) == 0) {
    fuzz::mutate_bytes(text);
    return text;
  }
  try {
    Pieces pieces(safetensors::read(bytes.data(), bytes.size(), ""));
    for (auto count = 1 + random.index(4); count > 0; --count) pieces.mutate(random);
    return pieces.text();
  } catch (const FileError&) {
    fuzz::mutate_bytes(text);
    return text;
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  Random random(seed, "mutations");
  return fuzz::put(mutated(data, size, random), data, max_size);
}
