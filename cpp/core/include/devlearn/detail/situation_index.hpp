#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "devlearn/situation.hpp"

namespace devlearn::detail {

/// Numbers situations in the order they are met, and finds the number of each.
class SituationIndex {
 public:
  static constexpr std::uint32_t kAbsent = 0xffffffffU;  ///< no number

  std::uint32_t find(SituationId situation) const noexcept {
    return buckets_.empty() ? kAbsent : buckets_[bucket_of(situation)];
  }

  /// The next number, for a situation that has none.
  std::uint32_t add(SituationId situation) {
    if (2 * (ids_.size() + 1) > buckets_.size()) reserve(ids_.size() + 1);
    const auto number = static_cast<std::uint32_t>(ids_.size());
    ids_.push_back(situation);
    buckets_[bucket_of(situation)] = number;
    return number;
  }

  /// Makes room for so many, so that add() allocates nothing.
  void reserve(std::size_t situations) {
    ids_.reserve(situations);
    std::size_t count = buckets_.empty() ? 64 : buckets_.size();
    while (2 * situations > count) count *= 2;
    if (count > buckets_.size()) spread(count);
  }

  SituationId id(std::uint32_t number) const noexcept { return ids_[number]; }
  std::size_t size() const noexcept { return ids_.size(); }
  const std::vector<SituationId>& ids() const noexcept { return ids_; }  ///< in their order
  std::size_t bytes_used() const noexcept {
    return ids_.size() * sizeof(SituationId) + buckets_.size() * sizeof(std::uint32_t);
  }
  std::size_t bytes() const noexcept {
    return ids_.capacity() * sizeof(SituationId) + buckets_.size() * sizeof(std::uint32_t);
  }

 private:
  // Where it is, or would be.
  std::size_t bucket_of(SituationId situation) const noexcept {
    auto bits = static_cast<std::uint64_t>(situation) * 0x9e3779b97f4a7c15U;
    bits = (bits ^ (bits >> 32)) * 0xd6e8feb86659fd93U;
    const std::size_t mask = buckets_.size() - 1;
    std::size_t bucket = static_cast<std::size_t>(bits >> 32) & mask;
    while (buckets_[bucket] != kAbsent && ids_[buckets_[bucket]] != situation) {
      bucket = (bucket + 1) & mask;
    }
    return bucket;
  }
  void spread(std::size_t buckets) {
    buckets_.assign(buckets, kAbsent);
    for (std::uint32_t n = 0; n < ids_.size(); ++n) buckets_[bucket_of(ids_[n])] = n;
  }

  std::vector<SituationId> ids_;
  std::vector<std::uint32_t> buckets_;  // a power of two, at most half full
};

}  // namespace devlearn::detail
