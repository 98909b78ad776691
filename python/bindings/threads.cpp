#include "threads.hpp"

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <utility>
#include <vector>

#include "agents.hpp"
#include "bindings.hpp"
#include "devlearn/adaptive_agent.hpp"
#include "devlearn/learner_agent.hpp"
#include "devlearn/task.hpp"
#include "devlearn/trial.hpp"

namespace devlearn::python {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

constexpr milliseconds kBetweenLooks{20};
// How long the end of the interpreter waits for other threads' runs.
constexpr milliseconds kPatience{2000};

struct Entry {
  const void* object;
  std::thread::id thread;  // none where the thread was left behind by a fork
  InHand::For what;
};
// Read and written with the GIL held. Never destroyed: threads may outlive static objects.
std::vector<Entry>& in_hand() {
  static auto* const entries = new std::vector<Entry>;
  return *entries;
}

// The end of the interpreter: first other threads' runs are ended, then no thread but the one that
// ends it takes the GIL any more.
std::atomic<bool> ending{false}, ended{false};
std::atomic<std::thread::id> ender{};
// Threads that are about to take the GIL.
std::atomic<int> entering{0};

bool is_elsewhere(const Entry& entry) { return entry.thread != std::this_thread::get_id(); }
// Whether the interpreter ends, and this thread is not the one that ends it.
bool is_late() { return ending && std::this_thread::get_id() != ender.load(); }

// With the GIL held.
void leave_if_late() {
  if (!is_late()) return;
  PyErr_SetNone(PyExc_SystemExit);
  throw py::error_already_set();
}

template <typename Take>
auto entered(const Take& take) {
  ++entering;
  if (ended && is_late()) {
    --entering;
    sleep_for_ever();
  }
  const auto state = take();
  --entering;
  return state;
}

void let_others_run() {
  const NoGil no_gil;
  std::this_thread::sleep_for(milliseconds(1));
}

// Called by atexit: non-daemon threads have ended.
void end() {
  ender = std::this_thread::get_id();
  ending = true;
  const auto patience_ends = Clock::now() + kPatience;
  const auto others_run = [] {
    return std::any_of(in_hand().begin(), in_hand().end(), [](const Entry& entry) {
      return is_elsewhere(entry) && entry.thread != std::thread::id();
    });
  };
  while (others_run() && Clock::now() < patience_ends) let_others_run();
  ended = true;
  do let_others_run();
  while (entering > 0);
}

// In a forked child only the thread that forked goes on. What others' runs had in hand stays so for
// ever.
void forget_threads() {
  entering = 0;
  auto& entries = in_hand();
  const auto left_whole = [](const Entry& entry) {
    return is_elsewhere(entry) && entry.what == InHand::For::kReading;
  };
  entries.erase(std::remove_if(entries.begin(), entries.end(), left_whole), entries.end());
  for (Entry& entry : entries) {
    if (is_elsewhere(entry)) entry.thread = std::thread::id();
  }
}

}  // namespace

void sleep_for_ever() {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

NoGil::NoGil() : state_(PyEval_SaveThread()) {}
NoGil::~NoGil() {
  entered([&] {
    PyEval_RestoreThread(state_);
    return 0;
  });
}

Gil::Gil()
    : state_(PyGILState_Check() ? PyGILState_Ensure()
                                : entered([] { return PyGILState_Ensure(); })) {}
Gil::~Gil() {
  // Before Python 3.14 the end of the interpreter unwinds the threads that want the GIL. No
  // noexcept function on the way survives that.
  if (!PyGILState_Check()) sleep_for_ever();
  PyGILState_Release(state_);
}

void hear_signals() {
  leave_if_late();
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

void take_a_breath() {
  constexpr int kBetweenLooks = 1 << 15;
  // A thread that waits for the GIL asks for it after 5 ms. One that is woken more often than that,
  // and finds it taken again, never asks.
  constexpr milliseconds kBetweenBreaths{10};
  thread_local int values = 0;
  thread_local Clock::time_point last;
  if (++values < kBetweenLooks) return;
  values = 0;
  const auto now = Clock::now();
  if (now - last < kBetweenBreaths) return;
  last = now;
  { const NoGil others_run; }
  hear_signals();
}

bool Watch::operator()() {
  const auto now = Clock::now();
  if (now - looked_ < kBetweenLooks && !is_late()) return false;
  const Gil gil;
  try {
    hear_signals();
    const bool over = also_ && also_();
    looked_ = Clock::now();
    return over;
  } catch (...) {
    raised_ = std::current_exception();
    return true;
  }
}

void require_free(const void* object, const char* name, InHand::For what) {
  for (;;) {
    const auto other = std::find_if(in_hand().begin(), in_hand().end(), [&](const Entry& entry) {
      const bool both_read = what == InHand::For::kReading && entry.what == what;
      return entry.object == object && is_elsewhere(entry) && !both_read;
    });
    if (other == in_hand().end()) return;
    if (other->thread == std::thread::id()) {
      throw InvalidValue(name, "one that another thread ran when this process was forked",
                         "one made since, or a copy made before");
    }
    if (other->what == InHand::For::kRunning) {
      throw InvalidValue(name, "a call while another thread's run has it in hand",
                         "a call before or after the run, or on a copy");
    }
    let_others_run();
    hear_signals();
  }
}

InHand::InHand(const Trial& trial, For what) : InHand() {
  take(&trial, "Trial", what);
  take(*trial.agent(), what);
}

InHand::InHand(const Learner& learner, For what) : InHand() { take(&learner, "Learner", what); }
InHand::InHand(const AdaptiveLearner& learner, For what) : InHand() {
  take(&learner, "AdaptiveLearner", what);
}

InHand::InHand(const Tally* tally) : InHand() {
  if (tally == nullptr) return;
  // Where an agent runs another trial, the two would count into each other's rounds.
  const bool here = std::any_of(in_hand().begin(), in_hand().end(), [&](const Entry& entry) {
    return entry.object == tally && !is_elsewhere(entry);
  });
  if (here) throw InvalidValue("Tally", "one that a run under way counts into", "another, or none");
  take(tally, "Tally", For::kRunning);
}

InHand::InHand(const Batch& batch) : InHand() { take(&batch, "Batch", For::kRunning); }

InHand::InHand(const Task& task, const Agent& agent) : InHand() {
  take(&task, "Task", For::kRunning);
  take(agent, For::kRunning);
}

// What Python knows of it: a learner is itself, whoever it chooses for.
void InHand::take(const Agent& agent, For what) {
  if (const auto* const of_learner = dynamic_cast<const LearnerAgent*>(&agent)) {
    take(of_learner->learner().get(), "Learner", what);
  } else if (const auto* const of_adaptive = dynamic_cast<const AdaptiveAgent*>(&agent)) {
    take(of_adaptive->learner().get(), "AdaptiveLearner", what);
  } else if (const char* const own = own_name(agent)) {
    take(&agent, own, what);
  }
}

void InHand::take(const void* object, const char* name, For what) {
  leave_if_late();
  require_free(object, name, what);
  mine_.push_back(object);
  in_hand().push_back({object, std::this_thread::get_id(), what});
}

InHand::~InHand() {
  for (const void* object : mine_) {
    const auto entry = std::find_if(in_hand().begin(), in_hand().end(), [&](const Entry& e) {
      return e.object == object && !is_elsewhere(e);
    });
    if (entry != in_hand().end()) in_hand().erase(entry);
  }
}

void require_idle(const void* learner, const char* name) {
  if (!in_hand().empty()) require_free(learner, name, InHand::For::kRunning);
}

void bind_threads(py::module_&) {
  static const int handled = pthread_atfork(nullptr, nullptr, &forget_threads);
  if (handled != 0) throw std::bad_alloc();
  py::module_::import("atexit").attr("register")(py::cpp_function(&end));
}

}  // namespace devlearn::python
