#include "base/heap.h"

#include <malloc.h>

namespace voxsheet {

void keepNoLargeBlocks() {
#ifdef __GLIBC__
    constexpr int kLargeBytes = 4 << 20; // pictures are smaller, and come with every frame
    mallopt(M_MMAP_THRESHOLD, kLargeBytes);
    mallopt(M_TRIM_THRESHOLD, kLargeBytes);
#endif
}

void giveFreePagesBack() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

} // namespace voxsheet
