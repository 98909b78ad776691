#include "devlearn/detail/pages.hpp"

#include <sys/mman.h>

void devlearn::refuse_length() { throw std::bad_array_new_length(); }

void devlearn::advise_huge_pages(void* memory, std::size_t bytes) noexcept {
#ifdef MADV_HUGEPAGE
  ::madvise(memory, bytes, MADV_HUGEPAGE);
#endif
}
