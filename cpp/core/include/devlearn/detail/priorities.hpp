#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace devlearn::detail {

/// A queue of mappings by priority; of equal ones, the lower number first. A binary heap that knows
/// where each mapping stands.
class Priorities {
 public:
  /// For so many mappings; there is room for them.
  void resize(std::size_t mappings) { place_.resize(mappings, kAbsent); }
  void reserve(std::size_t mappings) {
    place_.reserve(mappings);
    heap_.reserve(mappings);
  }

  bool empty() const noexcept { return heap_.empty(); }

  /// 0 where it has none.
  double priority(std::uint32_t mapping) const noexcept {
    return place_[mapping] == kAbsent ? 0.0 : heap_[place_[mapping]].priority;
  }

  /// Lets a mapping's priority be at least this.
  void raise(std::uint32_t mapping, double priority) noexcept {
    std::uint32_t place = place_[mapping];
    if (place == kAbsent) {
      place = static_cast<std::uint32_t>(heap_.size());
      heap_.push_back({priority, mapping});
    } else if (heap_[place].priority >= priority) {
      return;
    } else {
      heap_[place].priority = priority;
    }
    up(place);
  }

  /// Takes out the first.
  std::uint32_t pop() noexcept {
    const std::uint32_t first = heap_.front().mapping;
    take(first);
    return first;
  }

  /// Takes a mapping out, if it is there.
  void take(std::uint32_t mapping) noexcept {
    const std::uint32_t place = place_[mapping];
    if (place == kAbsent) return;
    place_[mapping] = kAbsent;
    const Entry last = heap_.back();
    heap_.pop_back();
    if (last.mapping == mapping) return;
    put(place, last);
    up(place);
    down(place_[last.mapping]);
  }

  std::size_t bytes_used() const noexcept {
    return heap_.size() * sizeof(Entry) + place_.size() * sizeof(std::uint32_t);
  }
  std::size_t bytes() const noexcept {
    return heap_.capacity() * sizeof(Entry) + place_.capacity() * sizeof(std::uint32_t);
  }

 private:
  struct Entry {
    double priority;
    std::uint32_t mapping;
  };
  static bool before(const Entry& a, const Entry& b) noexcept {
    return a.priority > b.priority || (a.priority == b.priority && a.mapping < b.mapping);
  }
  void put(std::uint32_t place, const Entry& entry) noexcept {
    heap_[place] = entry;
    place_[entry.mapping] = place;
  }
  void up(std::uint32_t place) noexcept {
    const Entry entry = heap_[place];
    while (place > 0 && before(entry, heap_[(place - 1) / 2])) {
      put(place, heap_[(place - 1) / 2]);
      place = (place - 1) / 2;
    }
    put(place, entry);
  }
  void down(std::uint32_t place) noexcept {
    const Entry entry = heap_[place];
    const auto size = static_cast<std::uint32_t>(heap_.size());
    for (std::uint32_t child = 2 * place + 1; child < size; child = 2 * place + 1) {
      if (child + 1 < size && before(heap_[child + 1], heap_[child])) ++child;
      if (!before(heap_[child], entry)) break;
      put(place, heap_[child]);
      place = child;
    }
    put(place, entry);
  }

  static constexpr std::uint32_t kAbsent = 0xffffffffU;
  std::vector<Entry> heap_;
  std::vector<std::uint32_t> place_;  // a mapping: in heap_
};

}  // namespace devlearn::detail
