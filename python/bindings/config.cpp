#include "config.hpp"

#include <sstream>

namespace devlearn::python {

std::string in_lines(const std::string& text) {
  constexpr std::size_t kWidth = 92;
  std::string lines, line;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!line.empty() && line.size() + 1 + word.size() > kWidth) {
      lines += "    " + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return lines + "    " + line + "\n";
}

}  // namespace devlearn::python
