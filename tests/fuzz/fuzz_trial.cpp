#include <optional>

#include "devlearn/trial_snapshot.hpp"
#include "law.hpp"
#include "snapshot.hpp"

// Any bytes are refused with a FileError, or make a trial that obeys the laws of the method, saves
// to what loads equal, and goes on: both alike.
using namespace devlearn;

namespace {

std::optional<TrialSnapshot> loaded(const std::vector<std::byte>& bytes) {
  try {
    return load_trial(bytes.data(), bytes.size());
  } catch (const FileError& error) {
    fuzz::require_fit(error);
    return std::nullopt;
  }
}

std::vector<std::byte> saved(const TrialSnapshot& snapshot) {
  SaveOptions options;
  options.record = snapshot.record ? &*snapshot.record : nullptr;
  options.note = snapshot.note;
  return to_bytes(snapshot.trial, options);
}

// Some steps, into the record where there is one.
void go_on(TrialSnapshot& snapshot) {
  Record fresh;
  Record& record = snapshot.record ? *snapshot.record : fresh;
  RunOptions options;
  options.echoes = record.sonar_count > 0;
  try {
    snapshot.trial.run(record, 6, options);
    snapshot.trial.path_learning(record, 1, 6, options);
  } catch (const InvalidValue&) {
    // A choice that waits, a record of other echoes, the last round that can be counted.
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::optional<TrialSnapshot> snapshot = loaded(fuzz::mended(data, size));
  if (!snapshot) return 0;

  const std::vector<std::byte> bytes = saved(*snapshot);
  std::optional<TrialSnapshot> again = loaded(bytes);
  fuzz::require(again.has_value(), "what was saved loads");
  fuzz::require(saved(*again) == bytes, "what was saved loads equal");

  go_on(*snapshot);
  go_on(*again);
  fuzz::require(saved(*again) == saved(*snapshot), "both go on alike");
  if (const auto learner = snapshot->trial.learner()) fuzz::require_laws(*learner);
  return 0;
}
