// Memory for large arrays that are read in no order.
#pragma once

#include <cstddef>
#include <memory>

namespace voxsheet {

/// Bytes of no value yet. Those of several MiB lie in pages of 2 MiB where the system gives such to who asks
/// (Linux: transparent_hugepage madvise or always): a few faults instead of thousands when they are written
/// first, and neighbours in a volume stay within the reach of the processor's table of pages.
class HugePageBlock {
public:
    HugePageBlock() = default;
    /// Throws std::bad_alloc if there is no room.
    explicit HugePageBlock(std::size_t bytes);

    [[nodiscard]] std::byte* data() { return bytes_.get(); }
    [[nodiscard]] const std::byte* data() const { return bytes_.get(); }
    [[nodiscard]] std::size_t size() const { return size_; }

private:
    struct Free {
        void operator()(std::byte* bytes) const;
    };
    std::unique_ptr<std::byte[], Free> bytes_;
    std::size_t size_ = 0;
};

} // namespace voxsheet
