#pragma once

#include <algorithm>
#include <string>

namespace devlearn {

/// Text of unknown origin, cut and in ASCII, fit for a message.
inline std::string excerpt(std::string text) {
  constexpr std::size_t kLongest = 160;
  if (text.empty()) return "\"\"";
  if (text.size() > kLongest) text.replace(kLongest, std::string::npos, "...");
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

}  // namespace devlearn
