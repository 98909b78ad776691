#pragma once

// So many of a law's cases, or an eighth of them under sanitizers: these watch memory, which takes
// ten times as long and no great numbers.
constexpr int many(int cases) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return cases / 8;
#else
  return cases;
#endif
}
