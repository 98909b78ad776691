#include "devlearn/detail/situation_store.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "devlearn/error.hpp"

namespace devlearn {
namespace {

// The index grows before more than two thirds of its buckets are taken: longer searches would cost
// more than the memory they save.
constexpr std::size_t kLeastBuckets = 12;

std::size_t situations_for(std::size_t buckets) noexcept { return buckets / 3 * 2; }

std::size_t buckets_for(std::size_t situations) noexcept {
  return std::max(kLeastBuckets, (situations + 1) / 2 * 3);
}

// All ones, and more than any number of so many situations: no entry is kEmpty.
std::uint32_t mask_for(std::size_t situations) noexcept {
  std::uint64_t mask = 1;
  while (mask < situations) mask = 2 * mask + 1;
  return static_cast<std::uint32_t>(mask);
}

}  // namespace

SituationStore::SituationStore(int motion_count)
    : motion_count_(motion_count),
      block_bytes_(sizeof(SituationId) + MotorMemory::bytes(motion_count)),
      buckets_(kLeastBuckets, kEmpty),
      number_mask_(mask_for(situations_for(kLeastBuckets))) {}

SituationStore::SituationStore(const SituationStore& other)
    : motion_count_(other.motion_count_),
      block_bytes_(other.block_bytes_),
      blocks_(other.blocks_.size()),
      buckets_(other.buckets_.size(), kEmpty),
      number_mask_(other.number_mask_) {
  *this = other;
}

SituationStore& SituationStore::operator=(const SituationStore& other) {
  if (this == &other) return *this;
  if (motion_count_ != other.motion_count_ || room() < other.size_) {
    return *this = SituationStore(other);
  }
  size_ = other.size_;
  growth_refused_ = other.growth_refused_;
  if (size_ > 0) std::memcpy(blocks_.data(), other.blocks_.data(), size_ * block_bytes_);
  if (buckets_.size() == other.buckets_.size()) {
    std::copy_n(other.buckets_.data(), buckets_.size(), buckets_.data());
  } else {
    put_all();
  }
  return *this;
}

void SituationStore::begin_block(std::byte* block, SituationId situation) const noexcept {
  std::memcpy(block, &situation, sizeof situation);
  memory_in(block).clear();
}

MotorMemory SituationStore::look_up(SituationId situation, std::vector<std::byte>& fresh) const {
  if (const Slot slot = find(situation); slot != kAbsent) return memory(slot);
  fresh.resize(block_bytes_);
  begin_block(fresh.data(), situation);
  return memory_in(fresh.data());
}

void SituationStore::reserve(std::size_t situations, Pages pages) {
  if (situations >= kEmpty) {
    throw InvalidValue("situations", std::to_string(situations), "at most 4294967294");
  }
  if (situations > std::numeric_limits<std::size_t>::max() / block_bytes_) refuse_length();
  if (situations * block_bytes_ > blocks_.size()) {
    decltype(blocks_) roomier(situations * block_bytes_);
    std::copy_n(blocks_.data(), size_ * block_bytes_, roomier.data());
    blocks_.swap(roomier);
  }
  if (situations > situations_for(buckets_.size())) {
    buckets_ = decltype(buckets_)(buckets_for(situations));
    number_mask_ = mask_for(situations_for(buckets_.size()));
    put_all();
  }
  if (pages == Pages::kTouched && !blocks_.empty()) {
    const std::size_t used = size_ * block_bytes_;
    std::memset(blocks_.data() + used, 0, blocks_.size() - used);
  }
}

std::size_t SituationStore::room() const noexcept {
  return std::min(blocks_.size() / block_bytes_, situations_for(buckets_.size()));
}

SituationStore::Slot SituationStore::add(SituationId situation, std::size_t bucket) {
  const std::size_t size = size_ + 1;
  if (size > room()) {
    if (growth_refused_) {
      throw InvalidValue("situations", std::to_string(size),
                         "at most " + std::to_string(room()) + ", the room there is");
    }
    const std::size_t doubled = std::min<std::size_t>(2 * size_, kEmpty - 1);
    reserve(std::max({size, doubled, situations_for(kLeastBuckets)}));
    bucket = look_for(situation).bucket;
  }
  const Slot slot = nth(size_);
  begin_block(blocks_.data() + slot, situation);
  put(static_cast<std::uint32_t>(size_), situation, bucket);
  size_ = size;
  return slot;
}

void SituationStore::put(std::uint32_t number, SituationId situation, std::size_t bucket) noexcept {
  buckets_[bucket] = number | (mark_of(scattered(situation)) & ~number_mask_);
}

// All blocks, into an index of nothing.
void SituationStore::put_all() noexcept {
  std::fill(buckets_.begin(), buckets_.end(), kEmpty);
  for (std::size_t n = 0; n < size_; ++n) {
    const SituationId situation = id(nth(n));
    put(static_cast<std::uint32_t>(n), situation, look_for(situation).bucket);
  }
}

void SituationStore::forget(SituationId situation) noexcept {
  const auto [slot, bucket] = look_for(situation);
  if (slot == kAbsent) return;
  const Slot last = nth(size_ - 1);
  if (slot != last) {
    put(buckets_[bucket] & number_mask_, id(last), look_for(id(last)).bucket);
    std::memcpy(blocks_.data() + slot, block(last), block_bytes_);
  }
  empty(bucket);
  --size_;
}

// Entries that were put further on because this bucket was taken move back, so that no search ends
// before it has found them.
void SituationStore::empty(std::size_t bucket) noexcept {
  for (std::size_t next = bucket;;) {
    if (++next == buckets_.size()) next = 0;
    const std::uint32_t entry = buckets_[next];
    if (entry == kEmpty) break;
    const std::size_t home = home_of(scattered(id(nth(entry & number_mask_))));
    const bool passes_bucket =
        bucket < next ? home <= bucket || home > next : home <= bucket && home > next;
    if (!passes_bucket) continue;
    buckets_[bucket] = entry;
    bucket = next;
  }
  buckets_[bucket] = kEmpty;
}

MemoryUse SituationStore::memory_use() const noexcept {
  const auto bytes = [](std::size_t buckets) { return buckets * sizeof(std::uint32_t); };
  const std::size_t used =
      size_ * block_bytes_ + bytes(std::min(buckets_.size(), buckets_for(size_)));
  return {used, blocks_.capacity() + bytes(buckets_.capacity()) - used};
}

}  // namespace devlearn
