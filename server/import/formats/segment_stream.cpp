#include "import/formats/segment_stream.h"

#include "base/errors.h"
#include "import/formats/text_voxels.h"

#include <algorithm>
#include <array>

namespace voxsheet::import {

namespace {

/// Room for what other programs put before or after the voxels of a compressed file.
constexpr std::uint64_t kLargestForeignBytes = 16ULL << 20;

std::string count(std::uint64_t bytes) { return std::to_string(bytes) + " bytes"; }

} // namespace

struct SegmentStream::Open {
    Open(const VoxelPlan& plan, const DataSegment& segment_)
        : segment(segment_), file(segment.file), stream(decoded(plan)), left(segment.voxelBytes) {
        const auto skip = segment.atEnd ? skipToLast(plan) : segment.skipDecoded;
        if (stream->skip(skip) < skip)
            throw InvalidInput(file.name(), "the data end within the " + count(skip) + " to skip");
    }

    std::unique_ptr<ByteStream> decoded(const VoxelPlan& plan) const {
        auto offset = segment.offset;
        if (segment.atEnd && plan.compression == Compression::None && file.bytes() >= segment.voxelBytes)
            offset = file.bytes() - segment.voxelBytes;
        auto bytes = openStream(file, offset, plan.compression);
        switch (plan.encoding) {
        case VoxelEncoding::Ascii:
            return asciiVoxels(std::move(bytes), plan.type, file.name());
        case VoxelEncoding::Hex:
            return hexVoxels(std::move(bytes), file.name());
        case VoxelEncoding::Raw:
            break;
        }
        return bytes;
    }

    /// Compressed data do not tell their length: it is counted first.
    std::uint64_t skipToLast(const VoxelPlan& plan) const {
        if (plan.compression == Compression::None) return 0;
        const auto most = segment.voxelBytes + kLargestForeignBytes;
        const auto total = openStream(file, segment.offset, plan.compression)->skip(most + 1);
        if (total > most)
            throw InvalidInput(file.name(), "it decompresses to more than " + count(most) +
                                                ", but the header says " + count(segment.voxelBytes));
        if (total < segment.voxelBytes) throwShort(total);
        return total - segment.voxelBytes;
    }

    [[noreturn]] void throwShort(std::uint64_t found) const {
        throw InvalidInput(file.name(),
                           "the header says " + count(segment.voxelBytes) +
                               " of voxels, the file holds only " + count(found),
                           "check dimensions and type in the header, or copy the file again");
    }

    DataSegment segment;
    InputFile file;
    std::unique_ptr<ByteStream> stream;
    std::uint64_t left;
};

SegmentStream::SegmentStream(const VoxelPlan& plan) : plan_(plan) {}
SegmentStream::~SegmentStream() = default;

void SegmentStream::read(std::span<std::byte> out) {
    while (!out.empty()) {
        if (!current_ || current_->left == 0) openNext();
        const auto want = static_cast<std::size_t>(std::min<std::uint64_t>(out.size(), current_->left));
        const auto got = current_->stream->read(out.first(want));
        current_->left -= got;
        if (got < want) current_->throwShort(current_->segment.voxelBytes - current_->left);
        out = out.subspan(got);
    }
}

void SegmentStream::finish() { closeCurrent(); }

void SegmentStream::openNext() {
    closeCurrent();
    if (next_ == plan_.segments.size())
        throw InternalError("voxel plan", "its segments hold fewer bytes than its arrays");
    current_ = std::make_unique<Open>(plan_, plan_.segments[next_++]);
}

void SegmentStream::closeCurrent() {
    if (!current_) return;
    const auto& segment = current_->segment;
    std::array<std::byte, 1> beyond{};
    const bool sizeWasCompared =
        plan_.compression == Compression::None && plan_.encoding == VoxelEncoding::Raw;
    // More than promised is asked for: at the end of the stream zlib and libbz2 compare the checksum.
    if (segment.mayBeLonger && plan_.compression != Compression::None)
        (void)current_->stream->skip(kLargestForeignBytes);
    if (!segment.mayBeLonger && !sizeWasCompared && current_->stream->read(beyond) != 0)
        throw InvalidInput(current_->file.name(),
                           "the header says " + count(segment.voxelBytes) +
                               " of voxels, but the file holds more",
                           "check dimensions, type and the bytes to skip in the header");
    current_.reset();
}

} // namespace voxsheet::import
