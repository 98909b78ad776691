#pragma once

#include <string>
#include <vector>

#include "devlearn/learner.hpp"
#include "safetensors.hpp"

// How a learner's state stands in a snapshot, its own or a trial's.
namespace devlearn {

/// Adds the state's entries and arrays. The arrays point into `state` and `random`.
void describe(const LearnerState& state, const std::vector<std::uint64_t>& random,
              safetensors::Metadata& metadata, safetensors::Arrays& arrays);

/// The reverse, checked against every law by building the learner. Throws FileError.
Learner learner_of(const safetensors::Contents& contents, const std::string& source);

/// Entries that every snapshot has: its format and version, and devlearn's.
safetensors::Metadata preamble(const std::string& format);
/// Throws FileError unless the contents are of this format, and of a version that is known.
void require_format(const safetensors::Contents& contents, const std::string& format,
                    const std::string& source);

/// Values in a metadata entry. Throw FileError.
double number_entry(const safetensors::Contents& contents, const std::string& name,
                    const std::string& source);
std::uint64_t whole_entry(const safetensors::Contents& contents, const std::string& name,
                          const std::string& source);

/// The whole of a file, bounded by its size. Throws FileError.
std::vector<std::byte> read_file(const std::string& path);

}  // namespace devlearn
