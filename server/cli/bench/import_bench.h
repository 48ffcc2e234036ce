// `voxsheet bench import`: how fast files are read, and how soon pictures of them come.
#pragma once

#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <vector>

namespace voxsheet::cli {

struct ImportBenchOptions {
    int dim = 192;                 ///< samples per edge of the file of each format
    int repeats = 3;               ///< readings of each, by turns with plain ones; the fastest count
    std::string only;              ///< formats whose name has this in it; empty: all
    std::vector<int> files{1, 40}; ///< how many are opened for the time to the first picture
    int fileDim = 256;             ///< samples per edge of those, u8
    int device = -1;
};

/// {"bench": "import", "dim", "repeats", "cases": [...]}. A case of a format: {format, text, file_mb,
/// voxel_mb, mb_s, plain_mb_s, ratio}: megabytes per second of voxels (of text for text formats) from opening
/// to voxels in memory within the importer, of plain reading or decompression of the same bytes into memory,
/// and their ratio. All is in the page cache. A case of opening: {files, first_picture_ms, all_pictures_ms}:
/// from the request until a 256x256 picture of the first, of every file is in host memory, imports into an
/// empty store included. Throws IoError, InternalError if what comes is not what was written.
[[nodiscard]] nlohmann::json runImportBench(const ImportBenchOptions& options,
                                            const std::function<void(const std::string&)>& progress);

} // namespace voxsheet::cli
