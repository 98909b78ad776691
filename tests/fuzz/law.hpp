#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "devlearn/error.hpp"
#include "devlearn/learner.hpp"

// The laws that hold whatever a file says. A broken one ends the program: the fuzzer keeps the
// input.
namespace devlearn::fuzz {

inline void require(bool holds, const char* law) {
  if (holds) return;
  std::fprintf(stderr, "broken law: %s\n", law);
  std::abort();
}

/// A refusal says what was found and expected, and does not repeat a whole file.
inline void require_fit(const FileError& error) {
  require(!error.value().empty() && !error.allowed().empty(), "a refusal says what is wrong");
  require(std::string(error.what()).size() <= 2000, "a message is short");
}

inline void require_laws(const Learner& learner) {
  std::int64_t explored = 0, effective = 0;
  std::vector<int> seen(static_cast<std::size_t>(learner.config().motion_count));
  int situations = 0;
  for (const SituationId id : learner.situations()) {
    const SituationMemory memory = learner.situation(id);
    for (const auto* list : {&memory.effective, &memory.ineffective, &memory.unexplored}) {
      for (const int motion : *list) ++seen.at(static_cast<std::size_t>(motion));
    }
    ++situations;
    for (const int count : seen) require(count == situations, "the lists partition M");
    double sum = 0.0;
    for (const double o : memory.orientation) {
      require(o >= 0.0 && o <= 1.0, "orientations lie in [0, 1]");
      sum += o;
    }
    require(memory.effective.empty() || std::abs(sum - 1.0) <= 1e-9, "orientations sum to 1");
    for (const std::uint32_t n : memory.times_learned) require(n >= 1, "counts begin at 1");
    effective += static_cast<std::int64_t>(memory.effective.size());
    explored += static_cast<std::int64_t>(memory.effective.size() + memory.ineffective.size());
  }
  require(learner.effective_count() == effective, "NUM_M counts the effective");
  require(learner.explored_count() == explored, "NUM_RM counts the explored");
}

}  // namespace devlearn::fuzz
