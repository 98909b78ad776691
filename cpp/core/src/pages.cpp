#include "devlearn/detail/pages.hpp"

#include <sys/mman.h>

void devlearn::advise_huge_pages(void* memory, std::size_t bytes) noexcept {
#ifdef MADV_HUGEPAGE
  ::madvise(memory, bytes, MADV_HUGEPAGE);
#endif
}
