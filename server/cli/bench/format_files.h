// One volume in every format, for benches of reading.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace voxsheet::cli {

enum class PlainMethod { Read, Zlib, Bzip2 };

struct FormatFile {
    std::string name;             ///< "nrrd gzip"
    std::filesystem::path file;   ///< to be opened
    std::filesystem::path data;   ///< with the voxels; often the same
    std::uint64_t dataOffset = 0; ///< of the (compressed) voxels in `data`
    PlainMethod plain = PlainMethod::Read;
    bool text = false;
    std::uint64_t voxelBytes = 0; ///< that a reader gives
};

/// Writes a smooth volume of dim^3 samples with noise in its low bits. Formats whose name lacks `only` are
/// left out. Throws IoError.
[[nodiscard]] std::vector<FormatFile> writeFormatFiles(const std::filesystem::path& folder, int dim,
                                                       const std::string& only);

} // namespace voxsheet::cli
