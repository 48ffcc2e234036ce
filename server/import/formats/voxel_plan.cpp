#include "import/formats/voxel_plan.h"

#include "base/errors.h"
#include "import/formats/segment_stream.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

namespace voxsheet::import {

static_assert(std::endian::native == std::endian::little, "store arrays are native little-endian");

std::uint64_t SourceHeader::arrayBytes(int field) const {
    return static_cast<std::uint64_t>(sampleCount(meta.grid.dims)) *
           scalarBytes(meta.fields.at(static_cast<std::size_t>(field)).storedType);
}

std::uint64_t SourceHeader::totalBytes() const {
    std::uint64_t total = 0;
    for (int field = 0; field < static_cast<int>(meta.fields.size()); ++field)
        total += arrayBytes(field);
    return total * meta.times.size();
}

namespace {

constexpr std::size_t kSlabBytes = 1U << 20;

template <typename T>
T swapped(T value) {
    if constexpr (sizeof(T) == 2) return __builtin_bswap16(value);
    if constexpr (sizeof(T) == 4) return __builtin_bswap32(value);
    if constexpr (sizeof(T) == 8) return __builtin_bswap64(value);
}

template <typename T>
void swapEach(std::span<std::byte> bytes) {
    // Blocks of a fixed size become vector instructions.
    constexpr std::size_t perBlock = 64 / sizeof(T);
    std::array<T, perBlock> block;
    const auto blocks = bytes.size() / sizeof(block);
    auto* at = bytes.data();
    for (std::size_t i = 0; i < blocks; ++i, at += sizeof(block)) {
        std::memcpy(block.data(), at, sizeof(block));
        for (auto& value : block)
            value = swapped(value);
        std::memcpy(at, block.data(), sizeof(block));
    }
    for (auto rest = bytes.size() % sizeof(block); rest >= sizeof(T); rest -= sizeof(T), at += sizeof(T)) {
        T value;
        std::memcpy(&value, at, sizeof value);
        value = swapped(value);
        std::memcpy(at, &value, sizeof value);
    }
}

/// Calls `body` with an integer of as many bytes as a value has.
template <typename Body>
void visitWidth(std::size_t valueBytes, const Body& body) {
    switch (valueBytes) {
    case 1:
        return body(std::uint8_t{});
    case 2:
        return body(std::uint16_t{});
    case 4:
        return body(std::uint32_t{});
    default:
        return body(std::uint64_t{});
    }
}

void swapBytes(std::span<std::byte> values, std::size_t valueBytes) {
    visitWidth(valueBytes, [&]<typename T>(T) {
        if constexpr (sizeof(T) > 1) swapEach<T>(values);
    });
}

/// Copies interleaved voxels into one array per component, from voxel `first` on.
void deinterleave(std::span<const std::byte> voxels, std::size_t valueBytes, std::size_t first,
                  std::vector<std::vector<std::byte>>& arrays) {
    const auto stride = valueBytes * arrays.size();
    const auto count = voxels.size() / stride;
    visitWidth(valueBytes, [&]<typename T>(T) {
        for (std::size_t component = 0; component < arrays.size(); ++component) {
            const auto* from = voxels.data() + component * sizeof(T);
            auto* to = arrays[component].data() + first * sizeof(T);
            for (std::size_t voxel = 0; voxel < count; ++voxel, from += stride, to += sizeof(T))
                std::memcpy(to, from, sizeof(T));
        }
    });
}

std::string bytesText(std::uint64_t bytes) { return std::to_string(bytes) + " bytes"; }

/// Some writers end the voxels with a line end.
bool isLineEnd(const InputFile& file, std::uint64_t lastBytes) {
    if (lastBytes > 2) return false;
    const auto text = file.textAt(file.bytes() - lastBytes, 2);
    return text == "\n" || text == "\r\n";
}

void checkSegment(const VoxelPlan& plan, const DataSegment& segment) {
    const InputFile file(segment.file);
    const auto available = file.bytes() > segment.offset ? file.bytes() - segment.offset : 0;
    const auto refuse = [&](const std::string& found) {
        throw InvalidInput(
            file.name(),
            "the header says " + bytesText(segment.voxelBytes) + " of voxels, the file holds " + found,
            "check dimensions, type and the bytes to skip in the header, or copy the file again");
    };
    if (plan.compression != Compression::None) {
        const auto longest = largestDecompressedBytes(available, plan.compression);
        if (segment.voxelBytes > longest || segment.skipDecoded > longest - segment.voxelBytes)
            refuse("only " + bytesText(available) + " of compressed data, which cannot decompress to that");
        return;
    }
    const auto valueBytes = scalarBytes(plan.type);
    if (plan.encoding == VoxelEncoding::Ascii) { // at least one digit and one separator a value
        if (segment.voxelBytes / valueBytes > available / 2 + 1)
            refuse("only " + bytesText(available) + " of text");
        return;
    }
    if (plan.encoding == VoxelEncoding::Hex) {
        if (segment.voxelBytes > available / 2) refuse("only " + bytesText(available) + " of text");
        return;
    }
    const auto held = available > segment.skipDecoded ? available - segment.skipDecoded : 0;
    if (held < segment.voxelBytes) refuse("only " + bytesText(held));
    if (held > segment.voxelBytes && !segment.mayBeLonger && !segment.atEnd &&
        !isLineEnd(file, held - segment.voxelBytes))
        refuse(bytesText(held));
}

/// Throws what reading throws, and keeps nothing.
void provePromises(const VoxelPlan& plan) {
    if (plan.compression == Compression::None) return;
    std::uint64_t promised = 0;
    std::uint64_t held = 0;
    for (const auto& segment : plan.segments) {
        promised += segment.voxelBytes;
        held += InputFile(segment.file).bytes();
    }
    if (!promisesMuch(promised, held)) return;
    SegmentStream stream(plan);
    std::vector<std::byte> dropped(kSlabBytes);
    while (promised > 0) {
        const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(promised, dropped.size()));
        stream.read(std::span(dropped).first(count));
        promised -= count;
    }
    stream.finish();
}

} // namespace

std::uint64_t checkedBytes(const std::string& what, const std::vector<std::int64_t>& extents,
                           std::size_t elementBytes, const ImportLimits& limits) {
    unsigned __int128 bytes = elementBytes;
    constexpr auto huge = static_cast<unsigned __int128>(1) << 90;
    std::string text;
    for (const auto extent : extents) {
        text += (text.empty() ? "" : " x ") + std::to_string(extent);
        if (extent < 1 || extent > std::numeric_limits<std::int32_t>::max())
            throw InvalidInput(what, "a dimension of " + std::to_string(extent) + " is not possible",
                               "dimensions are whole numbers from 1 to 2147483647");
        bytes = std::min(bytes * static_cast<unsigned __int128>(extent), huge);
    }
    if (bytes > limits.maxBytes)
        throw LimitExceeded(what,
                            text + " values of " + std::to_string(elementBytes) +
                                " bytes need more than the limit of " + bytesText(limits.maxBytes),
                            "check the header, or raise the memory budget");
    return static_cast<std::uint64_t>(bytes);
}

void checkSegments(const VoxelPlan& plan) {
    for (const auto& segment : plan.segments)
        checkSegment(plan, segment);
}

void readVoxels(const VoxelPlan& plan, const glm::ivec3& dims, const ArraySink& sink,
                const ReadProgress& progress) {
    const auto voxels = static_cast<std::size_t>(sampleCount(dims));
    const auto valueBytes = scalarBytes(plan.type);
    const auto components = static_cast<std::size_t>(plan.components);
    const auto volumes = plan.outerFields * plan.steps;
    const bool swap = plan.bigEndian && valueBytes > 1 && plan.encoding != VoxelEncoding::Ascii;
    const auto slabVoxels = std::max<std::size_t>(1, kSlabBytes / (valueBytes * components));
    provePromises(plan);
    std::vector<std::byte> slab(components > 1 ? std::min(slabVoxels, voxels) * valueBytes * components : 0);

    SegmentStream stream(plan);
    for (int volume = 0; volume < volumes; ++volume) {
        const int outerField = plan.stepsFastest ? volume / plan.steps : volume % plan.outerFields;
        const int step = plan.stepsFastest ? volume % plan.steps : volume / plan.outerFields;
        // They grow with what is read: memory is touched right before it is filled, and a file that ends
        // early costs no more than what it holds.
        std::vector<std::vector<std::byte>> arrays(components);
        for (auto& array : arrays)
            array.reserve(voxels * valueBytes);
        for (std::size_t first = 0; first < voxels; first += slabVoxels) {
            const auto count = std::min(slabVoxels, voxels - first);
            for (auto& array : arrays)
                array.resize((first + count) * valueBytes);
            const auto part = components > 1
                                  ? std::span(slab).first(count * valueBytes * components)
                                  : std::span(arrays[0]).subspan(first * valueBytes, count * valueBytes);
            stream.read(part);
            if (swap) swapBytes(part, valueBytes);
            if (components > 1) deinterleave(part, valueBytes, first, arrays);
            if (progress)
                progress((volume + static_cast<double>(first + count) / static_cast<double>(voxels)) /
                         volumes);
        }
        if (volume + 1 == volumes) stream.finish();
        for (std::size_t component = 0; component < components; ++component)
            sink(static_cast<int>(component) + plan.components * outerField, step,
                 std::move(arrays[component]));
    }
}

} // namespace voxsheet::import
