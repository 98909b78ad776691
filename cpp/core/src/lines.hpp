#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>

namespace devlearn {

/// Appends a line of a table.
template <typename... Values>
void append(std::string& text, const char* format, Values... values) {
  char line[160];
  const int length = std::snprintf(line, sizeof line, format, values...);
  if (length > 0) {
    text.append(line, std::min<std::size_t>(static_cast<std::size_t>(length), sizeof line - 1));
  }
}

}  // namespace devlearn
