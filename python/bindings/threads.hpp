#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <exception>
#include <functional>
#include <memory>
#include <vector>

#include "devlearn/adaptive.hpp"
#include "devlearn/learner.hpp"

// How calls from several Python threads, from a child forked during a run, and at the end of the
// interpreter come out.
namespace py = pybind11;

namespace devlearn {
class Agent;
class Batch;
class Task;
class Tally;
class Trial;
}  // namespace devlearn

namespace devlearn::python {

/// The GIL given up while this lives: other Python threads run meanwhile.
class NoGil {
 public:
  NoGil();
  ~NoGil();
  NoGil(const NoGil&) = delete;
  NoGil& operator=(const NoGil&) = delete;

 private:
  PyThreadState* state_;
};

/// The GIL held while this lives, whether it was or not.
class Gil {
 public:
  Gil();
  ~Gil();
  Gil(const Gil&) = delete;
  Gil& operator=(const Gil&) = delete;

 private:
  PyGILState_STATE state_;
};

/// Sleeps until the process ends: what becomes of a thread that would need the GIL of an
/// interpreter that has ended.
[[noreturn]] void sleep_for_ever();

/// Throws what Ctrl-C raises, and SystemExit in a thread that is not the one that ends the
/// interpreter. With the GIL held.
void hear_signals();

/// Where Python's arguments are gone through with the GIL held, called for each value: every now
/// and then other threads have their turn, and signals are heard, whose exception is thrown.
void take_a_breath();

/// What a long call asks every now and then, without the GIL, and ends where it is true. Every
/// 20 ms it looks for signals, and calls `also` with the GIL held, where true ends the call too.
/// What one of them raises is kept for rethrow().
class Watch {
 public:
  explicit Watch(std::function<bool()> also = {}) : also_(std::move(also)) {}
  bool operator()();
  /// Throws what ended the call, if anything was raised. With the GIL held.
  void rethrow() const {
    if (raised_) std::rethrow_exception(raised_);
  }

 private:
  std::function<bool()> also_;
  std::chrono::steady_clock::time_point looked_ = std::chrono::steady_clock::now();
  std::exception_ptr raised_;
};

/// Marks a trial, its agent, a learner, a tally, or a batch, while it lives, as in the hands of
/// this thread: of a run that changes it, or of one that reads it. A run is refused what another
/// thread has in hand, and waits for who only reads it. Made and ended with the GIL held.
class InHand {
 public:
  enum class For : bool { kReading, kRunning };
  InHand(const Trial& trial, For what);
  InHand(const Learner& learner, For what);
  InHand(const AdaptiveLearner& learner, For what);
  /// Of a run, which is refused one that any other run counts into; null: of nothing.
  explicit InHand(const Tally* tally);
  /// Of a step or a reset of one.
  explicit InHand(const Batch& batch);
  /// Of an agent's run through a task.
  InHand(const Task& task, const Agent& agent);
  ~InHand();
  InHand(const InHand&) = delete;
  InHand& operator=(const InHand&) = delete;

 private:
  InHand() = default;
  void take(const void* object, const char* name, For what);
  void take(const Agent& agent, For what);
  std::vector<const void*> mine_;
};

/// Throws InvalidValue where another thread's run has the object in hand; a run waits for a thread
/// that only reads it.
void require_free(const void* object, const char* name, InHand::For what);

/// Throws InvalidValue where another thread's run has any of this kind in hand.
void require_idle(const void* learner, const char* name);

/// A learner that Python calls; refused while another thread's run has it in hand.
template <typename L>
class IdleOf {
 public:
  IdleOf() = default;
  IdleOf(L& learner, const char* name) : learner_(&learner) { require_idle(&learner, name); }
  L* operator->() const { return learner_; }
  L& operator*() const { return *learner_; }

 private:
  L* learner_ = nullptr;
};
using Idle = IdleOf<Learner>;

void bind_threads(py::module_& m);

}  // namespace devlearn::python
