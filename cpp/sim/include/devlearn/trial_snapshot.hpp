#pragma once

#include <cstddef>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devlearn/record.hpp"
#include "devlearn/trial.hpp"

namespace devlearn {

/// A trial's snapshot: world, configuration, seed, pose, round and agent with its generator, in one
/// file like a learner's (docs/snapshot-format.md), and the record so far if wanted. A trial that
/// is loaded goes on equal to the bit, in the middle of a round, too.

/// What goes into a trial's snapshot besides the trial.
struct SaveOptions {
  const Record* record = nullptr;  ///< saved with the trial
  /// Only the paper's learner and RandomAgent can be saved. Save an agent of your own yourself, the
  /// trial without it, and give it to load_trial.
  bool agent = true;
  std::string note;  ///< any text in UTF-8, kept in the file
};

/// Written as a learner's is. Throws FileError; InvalidValue for an agent that cannot be saved, a
/// record that Record::validate refuses, a note that is no UTF-8, or while a call into the trial is
/// under way.
void save(const Trial& trial, const std::string& path, const SaveOptions& options = {});
void save(const Trial& trial, std::ostream& stream, const SaveOptions& options = {});
std::vector<std::byte> to_bytes(const Trial& trial, const SaveOptions& options = {});

/// What a trial's snapshot holds.
struct TrialSnapshot {
  Trial trial;                   ///< goes on equal to the bit
  std::optional<Record> record;  ///< where one was saved
  std::string note;              ///< as given to save
};

/// `agent` takes the place of the one in the file. Throws FileError, saying what is wrong, for
/// whatever load_learner refuses, and for a world, pose or record that does not fit.
TrialSnapshot load_trial(const std::string& path, std::shared_ptr<Agent> agent = nullptr);
TrialSnapshot load_trial(std::istream& stream, std::shared_ptr<Agent> agent = nullptr);
TrialSnapshot load_trial(const std::byte* bytes, std::size_t size,
                         std::shared_ptr<Agent> agent = nullptr,
                         const std::string& source = "snapshot");

}  // namespace devlearn
