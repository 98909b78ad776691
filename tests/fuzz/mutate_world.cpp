#include <algorithm>

#include "mutate.hpp"

using namespace devlearn;

namespace {

// Sets a piece of the text, between brackets of one kind, once more behind itself.
void repeat_piece(std::string& text, Random& random) {
  const char* const brackets = random.index(2) == 0 ? "{}" : "[]";
  const auto from = random.index(static_cast<std::uint32_t>(text.size()) + 1);
  const std::size_t begin = text.find(brackets[0], from);
  if (begin == text.npos) return;
  const std::size_t end = text.find(brackets[1], begin);
  if (end == text.npos) return;
  text.insert(end + 1, ", " + text.substr(begin, end + 1 - begin));
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  Random random(seed, "mutations");
  std::string text(reinterpret_cast<const char*>(data), size);
  for (auto count = 1 + random.index(4); count > 0; --count) {
    switch (random.index(8)) {
      case 0:
      case 1:
        fuzz::mutate_bytes(text);
        break;
      case 2:
        repeat_piece(text, random);
        break;
      default:
        fuzz::mutate_number(text, random);
    }
  }
  return fuzz::put(text, data, max_size);
}
