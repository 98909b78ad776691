#include "devlearn/situation_store.hpp"

#include <algorithm>
#include <string>

#include "devlearn/error.hpp"

namespace devlearn {
namespace {

// The index grows before more than 4/5 of its buckets are taken: longer searches would cost more
// than the memory they save.
constexpr std::size_t kLeastBuckets = 20;

std::size_t situations_for(std::size_t buckets) noexcept { return buckets / 5 * 4; }

std::size_t buckets_for(std::size_t situations) noexcept {
  return std::max(kLeastBuckets, (situations + 3) / 4 * 5);
}

// All ones, and more than any slot of so many situations: no entry is kAbsent.
std::uint32_t mask_for(std::size_t situations) noexcept {
  std::uint64_t mask = 1;
  while (mask < situations) mask = 2 * mask + 1;
  return static_cast<std::uint32_t>(mask);
}

}  // namespace

SituationStore::SituationStore(int motion_count)
    : motion_count_(motion_count),
      block_bytes_(sizeof(SituationId) + MotorMemory::bytes(motion_count)),
      buckets_(kLeastBuckets, kAbsent),
      slot_mask_(mask_for(situations_for(kLeastBuckets))) {}

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

void SituationStore::reserve(std::size_t situations) {
  if (situations >= kAbsent) {
    throw InvalidValue("situations", std::to_string(situations), "at most 4294967294");
  }
  if (situations * block_bytes_ > blocks_.size()) blocks_.resize(situations * block_bytes_);
  if (situations > situations_for(buckets_.size())) {
    buckets_ = decltype(buckets_)(buckets_for(situations), kAbsent);
    slot_mask_ = mask_for(situations_for(buckets_.size()));
    for (Slot slot = 0; slot < size_; ++slot) put(slot, bucket_of(id(slot)));
  }
}

SituationStore::Slot SituationStore::add(SituationId situation, std::size_t bucket) {
  const std::size_t size = size_ + 1;
  if (size * block_bytes_ > blocks_.size() || size > situations_for(buckets_.size())) {
    reserve(std::max(size, std::min<std::size_t>(size_ + size_ / 2 + 8, kAbsent - 1)));
    bucket = bucket_of(situation);
  }
  const auto slot = static_cast<Slot>(size_);
  begin_block(blocks_.data() + slot * block_bytes_, situation);
  put(slot, bucket);
  size_ = size;
  return slot;
}

void SituationStore::put(Slot slot, std::size_t bucket) noexcept {
  const auto mark = static_cast<std::uint32_t>(scattered(id(slot))) & ~slot_mask_;
  buckets_[bucket] = mark | slot;
}

MemoryUse SituationStore::memory_use() const noexcept {
  const auto bytes = [](std::size_t buckets) { return buckets * sizeof(std::uint32_t); };
  const std::size_t used =
      size_ * block_bytes_ + bytes(std::min(buckets_.size(), buckets_for(size_)));
  return {used, blocks_.capacity() + bytes(buckets_.capacity()) - used};
}

}  // namespace devlearn
