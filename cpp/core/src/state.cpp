#include "devlearn/state.hpp"

#include "excerpt.hpp"

namespace devlearn {

const StateArray& require_array(const StateArrays& arrays, const std::string& name,
                                const char* dtype, const Shape& shape) {
  const auto found = arrays.find(name);
  if (found == arrays.end()) throw InvalidValue(name, "nothing", "an array");
  const auto shown = [](const std::string& type, const Shape& lengths) {
    std::string text = type;
    for (const std::uint64_t length : lengths) text += " x " + std::to_string(length);
    return text;
  };
  const StateArray& array = found->second;
  if (array.dtype != dtype || array.shape != shape) {
    throw InvalidValue(name, excerpt(shown(array.dtype, array.shape)), shown(dtype, shape));
  }
  return array;
}

}  // namespace devlearn
