#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace devlearn::detail {

/// What became of each mapping: next situations, how often, and at what loss in sum. An outcome is
/// in two chains: of its mapping, oldest first, and of those that lead to its next situation.
class OutcomeStore {
 public:
  static constexpr std::uint32_t kGoal = 0xffffffffU;  ///< the next "situation" that is the goal

  struct Outcome {
    std::uint32_t mapping;
    std::uint32_t next;     ///< situation, or kGoal
    double sum;             ///< of losses
    std::uint32_t times;    ///< that it came out so; stops at 2^32 - 1
    std::uint32_t sibling;  ///< the next outcome of the mapping
    std::uint32_t leading;  ///< the next outcome that leads to the same situation
  };

  /// Chains for so many mappings and situations; there is room for them.
  void resize(std::size_t mappings, std::size_t situations) {
    of_.resize(mappings, kNone);
    times_.resize(mappings, 0);
    to_.resize(situations, kNone);
  }
  void reserve_chains(std::size_t mappings, std::size_t situations) {
    of_.reserve(mappings);
    times_.reserve(mappings);
    to_.reserve(situations);
  }
  /// For so many in all, and the one that make_room() keeps free.
  void reserve(std::size_t outcomes) { each_.reserve(outcomes + 1); }

  /// Room for one more, so that add() allocates nothing.
  void make_room() {
    if (free_ == kNone && each_.size() == each_.capacity()) {
      each_.reserve(std::max<std::size_t>(64, 2 * each_.size()));
    }
  }

  /// So many outcomes at once. An outcome that is new is the mapping's last.
  void add(std::uint32_t mapping, std::uint32_t next, double loss, std::uint32_t times = 1) {
    times_[mapping] = sum_of(times_[mapping], times);
    std::uint32_t last = kNone;
    for (std::uint32_t i = of_[mapping]; i != kNone; i = each_[i].sibling) {
      if (each_[i].next == next) {
        Outcome& known = each_[i];
        known.sum += loss;
        known.times = sum_of(known.times, times);
        return;
      }
      last = i;
    }
    std::uint32_t& to = next == kGoal ? to_goal_ : to_[next];
    const Outcome outcome{mapping, next, loss, times, kNone, to};
    std::uint32_t added = free_;
    if (added == kNone) {
      added = static_cast<std::uint32_t>(each_.size());
      each_.push_back(outcome);
    } else {
      free_ = each_[added].sibling;
      --freed_;
      each_[added] = outcome;
    }
    to = added;
    (last == kNone ? of_[mapping] : each_[last].sibling) = added;
  }

  /// Forgets a mapping's outcomes.
  void clear(std::uint32_t mapping) noexcept {
    for (std::uint32_t i = of_[mapping]; i != kNone;) {
      Outcome& outcome = each_[i];
      std::uint32_t* link = outcome.next == kGoal ? &to_goal_ : &to_[outcome.next];
      while (*link != i) link = &each_[*link].leading;
      *link = outcome.leading;
      const std::uint32_t rest = outcome.sibling;
      outcome.sibling = free_;
      free_ = i;
      ++freed_;
      i = rest;
    }
    of_[mapping] = kNone;
    times_[mapping] = 0;
  }

  /// How many outcomes of a mapping are remembered, those that came again included; stops at
  /// 2^32 - 1.
  std::uint32_t times(std::uint32_t mapping) const noexcept { return times_[mapping]; }
  bool any(std::uint32_t mapping) const noexcept { return times_[mapping] != 0; }

  /// visit(outcome) for each of a mapping, oldest first.
  template <typename Visit>
  void each_of(std::uint32_t mapping, const Visit& visit) const {
    for (std::uint32_t i = of_[mapping]; i != kNone; i = each_[i].sibling) visit(each_[i]);
  }
  /// visit(mapping) for each that has led to a situation.
  template <typename Visit>
  void each_to(std::uint32_t situation, const Visit& visit) const {
    for (std::uint32_t i = to_[situation]; i != kNone; i = each_[i].leading)
      visit(each_[i].mapping);
  }

  std::size_t size() const noexcept { return each_.size() - freed_; }
  std::size_t bytes_used() const noexcept {
    return size() * sizeof(Outcome) +
           (of_.size() + times_.size() + to_.size()) * sizeof(std::uint32_t);
  }
  std::size_t bytes() const noexcept {
    return each_.capacity() * sizeof(Outcome) +
           (of_.capacity() + times_.capacity() + to_.capacity()) * sizeof(std::uint32_t);
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;
  static std::uint32_t sum_of(std::uint32_t a, std::uint32_t b) noexcept {
    return b > 0xffffffffU - a ? 0xffffffffU : a + b;
  }

  std::vector<Outcome> each_;
  std::vector<std::uint32_t> of_;     // a mapping: its first outcome
  std::vector<std::uint32_t> times_;  // a mapping's, in all
  std::vector<std::uint32_t> to_;     // a situation: the newest outcome that leads to it
  std::uint32_t to_goal_ = kNone;
  std::uint32_t free_ = kNone;  // of those that were forgotten, the first
  std::size_t freed_ = 0;
};

}  // namespace devlearn::detail
