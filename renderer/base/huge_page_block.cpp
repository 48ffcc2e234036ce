#include "base/huge_page_block.h"

#include <new>

#include <sys/mman.h>

namespace voxsheet {

namespace {

constexpr std::size_t kPageBytes = std::size_t{2} << 20;
constexpr std::align_val_t kAlignment{kPageBytes};

} // namespace

void HugePageBlock::Free::operator()(std::byte* bytes) const { ::operator delete(bytes, kAlignment); }

HugePageBlock::HugePageBlock(std::size_t bytes)
    : bytes_(static_cast<std::byte*>(::operator new(bytes, kAlignment))), size_(bytes) {
#ifdef MADV_HUGEPAGE
    // Whole pages only: what follows the block is somebody else's. Advice that is not taken changes nothing
    // but the time.
    if (const std::size_t whole = bytes / kPageBytes * kPageBytes; whole != 0)
        (void)::madvise(bytes_.get(), whole, MADV_HUGEPAGE);
#endif
}

} // namespace voxsheet
