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
/// is loaded goes on equal to the bit, in the middle of a round, too. Of functions of one's own the
/// file holds the names alone: who loads it gives them again.

/// What goes into a trial's snapshot besides the trial.
struct SaveOptions {
  const Record* record = nullptr;  ///< saved with the trial
  /// Whether the agent is saved, too. One without a state() cannot be: save it yourself, the trial
  /// without it, and give it to load_trial.
  bool agent = true;
  std::string note;  ///< any text in UTF-8, kept in the file
};

/// Written as a learner's is. Throws FileError; InvalidValue for an agent without a state, or with
/// one that a file cannot hold (too many arrays, names or texts that are no UTF-8), a
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

/// Who goes on in a trial that is loaded; by default the agent in the file.
struct LoadOptions {
  std::shared_ptr<Agent> agent;  ///< takes the place of the one in the file
  AgentMaker maker = nullptr;    ///< makes agents of one's own from what is in the file
  /// The functions that the file names, and no others. Where a name has a colon, what stands before
  /// it (in Python the module) may differ. Not the table, which is in the file.
  TrialParts parts = {};
};

/// Throws FileError, saying what is wrong, for whatever load_learner refuses, for a world, pose or
/// record that does not fit, for an agent of a kind that is not devlearn's and that no maker
/// knows, and for functions that are missing or have another name.
TrialSnapshot load_trial(const std::string& path, const LoadOptions& options = {});
TrialSnapshot load_trial(std::istream& stream, const LoadOptions& options = {});
TrialSnapshot load_trial(const std::byte* bytes, std::size_t size, const LoadOptions& options = {},
                         const std::string& source = "snapshot");

/// The record in a trial's snapshot, and what it was made in.
struct RecordSnapshot {
  std::optional<Record> record;  ///< where one was saved
  World world;                   ///< it happened in
  TrialConfig config;            ///< the trial's
  std::uint64_t seed;            ///< the trial's
  std::string note;              ///< as given to save
};

/// Needs neither the agent nor functions of one's own. Throws FileError.
RecordSnapshot load_record(const std::string& path);

}  // namespace devlearn
