#pragma once

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "devlearn/version.hpp"

/// Snapshots of this kind that released versions saved, tests/golden/snapshots/VERSION_KIND, must
/// load for ever and have the future that stands beside them. DEVLEARN_UPDATE_GOLDEN adds this
/// version's, and never touches one that is there.
template <typename Save, typename Future>
void check_kept_snapshots(const std::string& kind, const Save& save, const Future& future) {
  const std::string folder = std::string(DEVLEARN_SOURCE_DIR) + "/tests/golden/snapshots/";
  const std::string now = folder + devlearn::version() + "_" + kind;
  if (std::getenv("DEVLEARN_UPDATE_GOLDEN") != nullptr &&
      !std::filesystem::exists(now + ".safetensors")) {
    save(now + ".safetensors");
    std::ofstream(now + ".txt") << future(now + ".safetensors");
  }
  int found = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::filesystem::path path = entry.path();
    if (path.extension() != ".safetensors" || path.stem().string().find(kind) == std::string::npos)
      continue;
    const std::string got = future(path.string());
    std::ifstream file(path.replace_extension(".txt"));
    const std::string expected(std::istreambuf_iterator<char>(file), {});
    CAPTURE(path.string());
    CHECK_FALSE(expected.empty());
    CHECK(got == expected);
    ++found;
  }
  CHECK(found > 0);
}
