#pragma once

// Included first by the headers that all others stand on.
#if (defined(_MSVC_LANG) ? _MSVC_LANG : __cplusplus) < 201703L
#error "devlearn needs C++17 or later: compile with -std=c++17 (with CMake, cxx_std_17)"
#endif
