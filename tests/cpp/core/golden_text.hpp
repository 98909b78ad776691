#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

// What a golden file says: a hash of all lines (FNV-1a), their number, and the first and last ones.
inline std::string golden_text(const std::vector<std::string>& lines, std::size_t first,
                               std::size_t last) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const std::string& line : lines) {
    for (const char letter : line + "\n") {
      hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3U;
    }
  }
  char digits[20];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  std::string text =
      std::string("hash ") + digits + " of " + std::to_string(lines.size()) + " lines\n";
  for (std::size_t i = 0; i < first; ++i) text += lines[i] + "\n";
  text += "...\n";
  for (std::size_t i = lines.size() - last; i < lines.size(); ++i) text += lines[i] + "\n";
  return text;
}
