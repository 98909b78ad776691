#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "bindings.hpp"

namespace devlearn::python {

/// progress(done, total)
using Told = py::typing::Callable<py::object(std::int64_t, std::int64_t)>;

/// What Python is told of a run of so much in all, ten times a second at most, and asked: whether
/// to stop. With the GIL held.
class Progress {
 public:
  Progress(const std::optional<Told>& told, const std::optional<EventObject>& stop,
           std::int64_t total)
      : told_(told), stop_(stop), total_(total) {}

  /// Tells how much is done(); whether the run is to stop.
  template <typename Done>
  bool looks(const Done& done) {
    if (told_ && Clock::now() - last_ >= std::chrono::milliseconds(100)) {
      (*told_)(done(), total_);
      last_ = Clock::now();
    }
    return stopped_ = stop_ && stop_->is_set();
  }
  /// Tells of the end, if the run was not stopped.
  void end() const {
    if (told_ && !stopped_) (*told_)(total_, total_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  const std::optional<Told>& told_;
  const std::optional<EventObject>& stop_;
  std::int64_t total_;
  Clock::time_point last_ = Clock::now();
  bool stopped_ = false;
};

}  // namespace devlearn::python
