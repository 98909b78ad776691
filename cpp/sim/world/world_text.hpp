#pragma once

#include <string>

namespace devlearn {

/// Whether the bytes are valid UTF-8, which JSON text must be.
bool is_utf8(const std::string& text);

}  // namespace devlearn
