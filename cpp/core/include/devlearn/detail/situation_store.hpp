#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "devlearn/detail/pages.hpp"
#include "devlearn/motor_memory.hpp"
#include "devlearn/situation.hpp"

namespace devlearn {

/// Whether memory that is made room in is taken from the system at once, or when first used.
enum class Pages : std::uint8_t {
  kUntouched,  ///< when first used: a call then waits for the system, microseconds at a time
  kTouched,    ///< at once
};

/// The situations experienced, in the order they came, and where each one's motor memory lies.
///
/// Each has a block: its id, then what MotorMemory views. An index finds blocks by id in a time
/// that does not grow with their number.
class SituationStore {
 public:
  using Slot = std::size_t;                               ///< where a block begins [bytes]
  static constexpr Slot kAbsent = static_cast<Slot>(-1);  ///< no block's

  /// motion_count: N_M.
  explicit SituationStore(int motion_count);

  ///@{
  /// A copy has the room of its original. One that has room for the other's situations, of as many
  /// motions, is assigned to without allocating; where memory does not suffice nothing has changed.
  SituationStore(const SituationStore& other);
  SituationStore& operator=(const SituationStore& other);
  SituationStore(SituationStore&&) noexcept = default;
  SituationStore& operator=(SituationStore&&) noexcept = default;
  ~SituationStore() = default;
  ///@}

  /// Where a situation is, or kAbsent.
  Slot find(SituationId situation) const noexcept { return look_for(situation).slot; }

  /// The same, after adding it where it is missing, with every motion unexplored. Throws
  /// std::bad_alloc, and InvalidValue where growth is refused; then nothing has changed.
  Slot find_or_add(SituationId situation) {
    const Found found = look_for(situation);
    return found.slot != kAbsent ? found.slot : add(situation, found.bucket);
  }

  /// The block of the n-th situation, from 0 and in the order they came.
  Slot nth(std::size_t n) const noexcept { return n * block_bytes_; }

  /// Which situation a block is of.
  SituationId id(Slot slot) const noexcept { return id_in(block(slot)); }

  /// Its motor memory; the view serves reading and developing alike.
  MotorMemory memory(Slot slot) const noexcept { return memory_in(block(slot)); }

  /// The motor memory of a situation or, where it is missing, of one never experienced, which is
  /// then made in `fresh`.
  MotorMemory look_up(SituationId situation, std::vector<std::byte>& fresh) const;

  /// How many there are.
  std::size_t size() const noexcept { return size_; }

  /// Erases a situation where there is one; the last one takes its place in the order.
  void forget(SituationId situation) noexcept;

  /// Makes room for so many in all. Throws InvalidValue for more than 2^32 - 2, std::bad_alloc
  /// where memory does not suffice; then nothing has changed.
  void reserve(std::size_t situations, Pages pages = Pages::kUntouched);

  /// How many find room without another reserve.
  std::size_t room() const noexcept;

  /// Whether what finds no room is refused.
  void refuse_growth(bool refuse) noexcept { growth_refused_ = refuse; }

  /// What they take.
  MemoryUse memory_use() const noexcept;

  ///@{
  /// A block's bytes, for whoever keeps a copy, and what a copy holds.
  std::size_t block_bytes() const noexcept { return block_bytes_; }
  const std::byte* block(Slot slot) const noexcept { return blocks_.data() + slot; }
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
  // Spreads neighbouring ids over the upper bits.
  static std::uint64_t scattered(SituationId situation) noexcept {
    const auto bits = static_cast<std::uint64_t>(situation) * 0x9e3779b97f4a7c15U;
    return (bits ^ (bits >> 32)) * 0xd6e8feb86659fd93U;
  }
  // Of the bits below those that say where to begin.
  static std::uint32_t mark_of(std::uint64_t hash) noexcept {
    return static_cast<std::uint32_t>(hash >> 8);
  }

  struct Found {
    Slot slot;           // kAbsent where the bucket is empty
    std::size_t bucket;  // that a situation is in, or that it would be put in
  };
  // The upper half of a situation's hash says in which bucket to begin; the mark says what lies in
  // one, so that other blocks are hardly ever looked at.
  std::size_t home_of(std::uint64_t hash) const noexcept {
    return static_cast<std::size_t>((hash >> 33) * buckets_.size() >> 31);
  }
  Found look_for(SituationId situation) const noexcept {
    const std::uint64_t hash = scattered(situation);
    const std::size_t count = buckets_.size();
    std::size_t bucket = home_of(hash);
    for (;;) {
      const std::uint32_t entry = buckets_[bucket];
      if (entry == kEmpty) return {kAbsent, bucket};
      if (((entry ^ mark_of(hash)) & ~number_mask_) == 0) {
        const Slot slot = nth(entry & number_mask_);
        if (id(slot) == situation) return {slot, bucket};
      }
      if (++bucket == count) bucket = 0;
    }
  }

  void begin_block(std::byte* block, SituationId situation) const noexcept;
  Slot add(SituationId situation, std::size_t bucket);
  void put(std::uint32_t number, SituationId situation, std::size_t bucket) noexcept;
  void put_all() noexcept;
  void empty(std::size_t bucket) noexcept;

  static constexpr std::uint32_t kEmpty = 0xffffffffU;

  int motion_count_;
  std::size_t block_bytes_;
  std::size_t size_ = 0;
  bool growth_refused_ = false;
  std::vector<std::byte, PageAllocator<std::byte>> blocks_;
  // An open-addressing index. An entry is a block's number in its lower bits and, above
  // number_mask_, the mark.
  std::vector<std::uint32_t, PageAllocator<std::uint32_t>> buckets_;
  std::uint32_t number_mask_ = 0;
};

}  // namespace devlearn
