#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

// What the targets for snapshots, the learner's and the trial's, have in common.
namespace devlearn::fuzz {

/// The input with its header length and checksum put right (docs/snapshot-format.md), so that what
/// lies behind that door is tested, too.
std::vector<std::byte> mended(const std::uint8_t* data, std::size_t size);

}  // namespace devlearn::fuzz
