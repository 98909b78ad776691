#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

#include "devlearn/adaptive.hpp"
#include "devlearn/learner.hpp"

namespace devlearn {

/// A learner's snapshot: one file in the safetensors layout (docs/snapshot-format.md), which other
/// tools read, too. A learner that is loaded goes on equal to the bit.

/// Writes the file to the side, flushes it, renames it, flushes the folder: a full disk or a kill
/// at any moment leaves the previous file whole. Throws FileError.
void save(const Learner& learner, const std::string& path);
/// To a stream, which is in a failed state afterwards where it could not take everything.
void save(const Learner& learner, std::ostream& stream);
/// To memory.
std::vector<std::byte> to_bytes(const Learner& learner);

/// Throws FileError, saying what is wrong, for a file that is missing, cut off, damaged, foreign,
/// of a newer version, or that breaks a law of the method. What is read is bounded by the file.
Learner load_learner(const std::string& path);
Learner load_learner(std::istream& stream);
Learner load_learner(const std::byte* bytes, std::size_t size,
                     const std::string& source = "snapshot");

///@{
/// The same for an adaptive learner.
void save(const AdaptiveLearner& learner, const std::string& path);
void save(const AdaptiveLearner& learner, std::ostream& stream);
std::vector<std::byte> to_bytes(const AdaptiveLearner& learner);
AdaptiveLearner load_adaptive_learner(const std::string& path);
AdaptiveLearner load_adaptive_learner(std::istream& stream);
AdaptiveLearner load_adaptive_learner(const std::byte* bytes, std::size_t size,
                                      const std::string& source = "snapshot");
///@}

}  // namespace devlearn
