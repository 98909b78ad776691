#include "devlearn/detail/pages.hpp"

#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

void devlearn::refuse_length() { throw std::bad_array_new_length(); }

void devlearn::advise_huge_pages([[maybe_unused]] void* memory,
                                 [[maybe_unused]] std::size_t bytes) noexcept {
#ifdef MADV_HUGEPAGE
  ::madvise(memory, bytes, MADV_HUGEPAGE);
#endif
}
