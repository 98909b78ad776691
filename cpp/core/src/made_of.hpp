#pragma once

#include <string>

#include "devlearn/error.hpp"

namespace devlearn {

/// What `make` makes of a file's values; what it refuses is refused as the file's fault.
template <typename Make>
auto made_of(const std::string& source, const Make& make) -> decltype(make()) {
  try {
    return make();
  } catch (const FileError&) {
    throw;
  } catch (const InvalidValue& error) {
    throw FileError(source, error.quantity(), error.value(), error.allowed());
  }
}

}  // namespace devlearn
