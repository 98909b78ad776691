#pragma once

#include <cstddef>
#include <new>

namespace devlearn {

/// Tells the system that this memory is better kept in huge pages: tables of millions of situations
/// are read in no order, and finding a small page costs as much as reading it. A hint only.
void advise_huge_pages(void* memory, std::size_t bytes) noexcept;

/// Throws std::bad_array_new_length.
[[noreturn]] void refuse_length();

/// std::allocator, but what is large begins with a huge page and asks for them, and what a vector
/// is resized by is not written to: the system hands memory out when it is first used.
template <typename T>
struct PageAllocator {
  ///@{
  /// What the standard library asks of an allocator.
  using value_type = T;

  PageAllocator() = default;
  template <typename U>
  PageAllocator(const PageAllocator<U>&) noexcept {}

  T* allocate(std::size_t count) {
    if (count > static_cast<std::size_t>(-1) / sizeof(T)) refuse_length();
    const std::size_t bytes = count * sizeof(T);
    if (bytes < kLarge) return static_cast<T*>(::operator new(bytes));
    void* const memory = ::operator new (bytes, std::align_val_t{kHugePage});
    advise_huge_pages(memory, bytes);
    return static_cast<T*>(memory);
  }

  void deallocate(T* memory, std::size_t count) noexcept {
    if (count * sizeof(T) < kLarge) {
      ::operator delete(memory);
    } else {
      ::operator delete (memory, std::align_val_t{kHugePage});
    }
  }

  template <typename U>
  void construct(U* place) noexcept {
    ::new (static_cast<void*>(place)) U;
  }
  template <typename U>
  void construct(U* place, const U& value) noexcept {
    ::new (static_cast<void*>(place)) U(value);
  }

  friend bool operator==(const PageAllocator&, const PageAllocator&) noexcept { return true; }
  friend bool operator!=(const PageAllocator&, const PageAllocator&) noexcept { return false; }
  ///@}

 private:
  static constexpr std::size_t kHugePage = std::size_t{2} << 20;
  static constexpr std::size_t kLarge = 8 * kHugePage;
};

}  // namespace devlearn
