// How the voxels of a binary (or plain text) file lie, worked out by a header parser, and the one routine
// that reads them.
#pragma once

#include "import/formats/byte_stream.h"
#include "import/source_reader.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace voxsheet::import {

enum class VoxelEncoding {
    Raw,
    Ascii, ///< numbers between blanks, tabs, line ends or commas
    Hex,   ///< two digits a byte, blanks anywhere
};

/// A run of voxels in one file; the segments of a plan follow on each other.
struct DataSegment {
    std::filesystem::path file;
    std::uint64_t offset = 0;      ///< of the first byte of the (compressed) data in the file
    std::uint64_t skipDecoded = 0; ///< bytes to drop after decompression
    bool atEnd = false;            ///< the voxels are the last bytes, after decompression; skipDecoded is 0
    bool mayBeLonger = false;      ///< bytes after the voxels are no error
    std::uint64_t voxelBytes = 0;  ///< decoded
};

/// Order of the samples, fastest first: component, x, y, z, then fields and steps.
struct VoxelPlan {
    std::vector<DataSegment> segments;
    Compression compression = Compression::None;
    VoxelEncoding encoding = VoxelEncoding::Raw;
    ScalarType type = ScalarType::U8;
    bool bigEndian = false;
    int components = 1;        ///< interleaved, field = component + components * outerField
    int outerFields = 1;       ///< whole volumes after each other
    int steps = 1;             ///< whole volumes after each other
    bool stepsFastest = false; ///< steps vary faster than outerFields
};

/// Product of extents and bytes per element, the size of all voxels. Throws InvalidInput (subject `what`) if
/// an extent is < 1 or > 2^31 - 1, LimitExceeded if there are more than limits.maxBytes.
[[nodiscard]] std::uint64_t checkedBytes(const std::string& what, const std::vector<std::int64_t>& extents,
                                         std::size_t elementBytes, const ImportLimits& limits);

/// Compares the segments with the files: exact for raw data (one line end after them aside); for compressed
/// data and text only what cannot be is refused, the rest shows while reading. Throws InvalidInput naming
/// both sizes; NotFound, IoError.
void checkSegments(const VoxelPlan& plan);

/// Reads every array. `dims` are the samples per axis. Throws InvalidInput, IoError.
void readVoxels(const VoxelPlan& plan, const glm::ivec3& dims, const ArraySink& sink,
                const ReadProgress& progress);

} // namespace voxsheet::import
