// One small valid file of every format and encoding that our own readers read: what damaged files are made
// from.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace voxsheet::import::testing {

struct SampleFile {
    std::string name;
    std::string bytes;
    std::size_t mayMiss = 0; ///< bytes at the end without which the voxels may be the same, or look whole
    std::vector<std::pair<std::string, std::string>> beside = {}; ///< name and bytes of its data files
};

/// Volumes of NRRD, MetaImage, NIfTI, VASP, XSF and cube files in one file each, 5 x 6 x 7.
[[nodiscard]] std::vector<SampleFile> volumeSamples();
/// Headers with their voxels in another file.
[[nodiscard]] std::vector<SampleFile> detachedSamples();
/// SLC, legacy VTK, PLY, STL and OBJ.
[[nodiscard]] std::vector<SampleFile> furtherSamples();
/// TIFF stacks; libtiff writes them through a file in `scratch`.
[[nodiscard]] std::vector<SampleFile> tiffSamples(const std::filesystem::path& scratch);

/// All of the above.
[[nodiscard]] std::vector<SampleFile> allSamples(const std::filesystem::path& scratch);

/// `text` with the first `from` replaced. Throws if there is none: a mutation must change something.
[[nodiscard]] std::string replaced(std::string text, const std::string& from, const std::string& to);

} // namespace voxsheet::import::testing
