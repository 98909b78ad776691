#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "devlearn/motor_memory.hpp"
#include "devlearn/pages.hpp"
#include "devlearn/situation.hpp"

namespace devlearn {

/// Memory in bytes.
struct MemoryUse {
  std::size_t used = 0;   ///< by the situations experienced, their index included
  std::size_t spare = 0;  ///< held for more of them: reserved, or left over by growth
};

/// The situations experienced, in the order they came, and where each one's motor memory lies.
///
/// Each has a block: its id, then what MotorMemory views. An index finds blocks by id in a time
/// that does not grow with their number.
class SituationStore {
 public:
  using Slot = std::uint32_t;                   ///< a block's number, from 0
  static constexpr Slot kAbsent = 0xffffffffU;  ///< no block's

  /// motion_count: N_M.
  explicit SituationStore(int motion_count);

  /// Where a situation is, or kAbsent.
  Slot find(SituationId situation) const noexcept { return slot_in(bucket_of(situation)); }

  /// The same, after adding it where it is missing, with every motion unexplored. Throws
  /// std::bad_alloc; then nothing has changed.
  Slot find_or_add(SituationId situation) {
    const std::size_t bucket = bucket_of(situation);
    const Slot found = slot_in(bucket);
    return found != kAbsent ? found : add(situation, bucket);
  }

  /// Which situation a block is of.
  SituationId id(Slot slot) const noexcept { return id_in(block(slot)); }

  /// Its motor memory; the view serves reading and developing alike.
  MotorMemory memory(Slot slot) const noexcept { return memory_in(block(slot)); }

  /// The motor memory of a situation or, where it is missing, of one never experienced, which is
  /// then made in `fresh`.
  MotorMemory look_up(SituationId situation, std::vector<std::byte>& fresh) const;

  /// How many there are.
  std::size_t size() const noexcept { return size_; }

  /// Makes room for so many in all. Throws InvalidValue for more than 2^32 - 2, std::bad_alloc
  /// where memory does not suffice; then nothing has changed.
  void reserve(std::size_t situations);

  /// What they take.
  MemoryUse memory_use() const noexcept;

  ///@{
  /// A block's bytes, for whoever keeps a copy, and what a copy holds.
  std::size_t block_bytes() const noexcept { return block_bytes_; }
  const std::byte* block(Slot slot) const noexcept { return blocks_.data() + slot * block_bytes_; }
  static SituationId id_in(const std::byte* block) noexcept {
    SituationId id = 0;
    std::memcpy(&id, block, sizeof id);
    return id;
  }
  MotorMemory memory_in(const std::byte* block) const noexcept {
    return {const_cast<std::byte*>(block) + sizeof(SituationId), motion_count_};
  }
  ///@}

 private:
  // Spreads neighbouring ids over all 64 bits.
  static std::uint64_t scattered(SituationId situation) noexcept {
    auto bits = static_cast<std::uint64_t>(situation) * 0x9e3779b97f4a7c15U;
    bits = (bits ^ (bits >> 32)) * 0xd6e8feb86659fd93U;
    return bits ^ (bits >> 32);
  }

  // The bucket that a situation is in, or that it would be put in. The upper half of its hash says
  // where to begin; the lower half marks what lies in the bucket, so that other blocks are hardly
  // ever looked at.
  std::size_t bucket_of(SituationId situation) const noexcept {
    const std::uint64_t hash = scattered(situation);
    const std::size_t count = buckets_.size();
    std::size_t bucket = (hash >> 33) * count >> 31;
    for (;;) {
      const std::uint32_t entry = buckets_[bucket];
      if (entry == kAbsent) return bucket;
      if (((entry ^ static_cast<std::uint32_t>(hash)) & ~slot_mask_) == 0 &&
          id(entry & slot_mask_) == situation) {
        return bucket;
      }
      if (++bucket == count) bucket = 0;
    }
  }

  Slot slot_in(std::size_t bucket) const noexcept {
    const std::uint32_t entry = buckets_[bucket];
    return entry == kAbsent ? kAbsent : entry & slot_mask_;
  }

  void begin_block(std::byte* block, SituationId situation) const noexcept;
  Slot add(SituationId situation, std::size_t bucket);
  void put(Slot slot, std::size_t bucket) noexcept;

  int motion_count_;
  std::size_t block_bytes_;
  std::size_t size_ = 0;
  std::vector<std::byte, PageAllocator<std::byte>> blocks_;
  // An open-addressing index. An entry is a slot in its lower bits and, above slot_mask_, the mark.
  std::vector<std::uint32_t, PageAllocator<std::uint32_t>> buckets_;
  std::uint32_t slot_mask_ = 0;
};

}  // namespace devlearn
