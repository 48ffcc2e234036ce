// Readers as plain as can be, written from the formats' descriptions and sharing no code with ours: a second
// opinion on real files. They trust their files, and hold everything in memory.
#pragma once

#include "volume/scalar_type.h"

#include <glm/glm.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace voxsheet::import::testing {

struct PlainVolume {
    glm::ivec3 dims{1};
    glm::dvec3 spacing{1.0}; ///< world units; 0 on an axis whose spacing the file does not say
    ScalarType type = ScalarType::U8;
    int steps = 1;
    std::vector<std::vector<double>> arrays; ///< stored numbers, at field * steps + step
};

/// The whole file, decompressed if it is gzip.
[[nodiscard]] std::string plainBytes(const std::filesystem::path& path);

[[nodiscard]] PlainVolume plainNifti(const std::filesystem::path& path);
[[nodiscard]] PlainVolume plainNrrd(const std::filesystem::path& path);
[[nodiscard]] PlainVolume plainMetaImage(const std::filesystem::path& path);
/// The first grid of a VASP file.
[[nodiscard]] PlainVolume plainVasp(const std::filesystem::path& path);
[[nodiscard]] PlainVolume plainCube(const std::filesystem::path& path);

/// By VTK's own readers: .vti, legacy structured points, .slc, and rectilinear grids whose coordinates are
/// equally spaced. Point data, or cell data where there is none.
[[nodiscard]] PlainVolume vtkVolume(const std::filesystem::path& path);

} // namespace voxsheet::import::testing
