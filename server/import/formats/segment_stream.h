// The decoded bytes of a plan's segments as one stream: decompressed, text turned into little-endian numbers.
#pragma once

#include "import/formats/voxel_plan.h"

#include <memory>

namespace voxsheet::import {

/// Reads exactly DataSegment::voxelBytes of each segment. Throws InvalidInput when a segment ends early or,
/// unless mayBeLonger, does not end with its voxels.
class SegmentStream {
public:
    explicit SegmentStream(const VoxelPlan& plan);
    ~SegmentStream();

    /// Fills `out`; the callers ask for no more than the segments hold together.
    void read(std::span<std::byte> out);
    /// After the last voxel: checks that the last segment ends there.
    void finish();

private:
    struct Open;
    void openNext();
    void closeCurrent();

    const VoxelPlan& plan_;
    std::size_t next_ = 0;
    std::unique_ptr<Open> current_;
};

} // namespace voxsheet::import
