#include <algorithm>
#include <chrono>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "bindings.hpp"

namespace devlearn::python {
namespace {

std::recursive_timed_mutex turn;

struct InHand {
  const Learner* learner;
  std::thread::id thread;
};
// Read and written with the GIL held.
std::vector<InHand> in_hand;

}  // namespace

Turn::Turn() {
  while (!turn.try_lock_for(std::chrono::milliseconds(20))) {
    const py::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

Turn::~Turn() { turn.unlock(); }

InRun::InRun(std::shared_ptr<Learner> learner) : learner_(std::move(learner)) {
  if (learner_) {
    const Idle not_in_another_run(*learner_);
    in_hand.push_back({learner_.get(), std::this_thread::get_id()});
  }
}

InRun::~InRun() {
  const auto mine = std::find_if(in_hand.begin(), in_hand.end(), [&](const InHand& entry) {
    return entry.learner == learner_.get() && entry.thread == std::this_thread::get_id();
  });
  if (mine != in_hand.end()) in_hand.erase(mine);
}

Idle::Idle(Learner& learner) : learner_(&learner) {
  for (const InHand& entry : in_hand) {
    if (entry.learner == &learner && entry.thread != std::this_thread::get_id()) {
      throw InvalidValue("Learner", "a call while another thread runs a trial with it",
                         "a call before or after the run, or on a copy");
    }
  }
}

}  // namespace devlearn::python
