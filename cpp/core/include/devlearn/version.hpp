#pragma once

#include "devlearn/detail/cpp17.hpp"

namespace devlearn {

/// The version of the library, `major.minor.patch`.
const char* version() noexcept;
/// The commit it was built from, with `-dirty` where the tree had changes; `unknown` where neither
/// git nor a source distribution tells.
const char* commit() noexcept;

}  // namespace devlearn
