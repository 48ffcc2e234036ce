// The head of a Gaussian cube file: two comment lines, atoms' number and origin, three voxel vectors, atoms.
// Format: https://gaussian.com/cubegen/ and https://h5cube-spec.readthedocs.io/en/latest/cubeformat.html.
#pragma once

#include "import/formats/geometry.h"
#include "import/formats/text_scanner.h"
#include "volume/dataset.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace voxsheet::import {

/// Lengths are Ångström, whatever the file has.
struct CubeHeader {
    std::array<std::int64_t, 3> samples{}; ///< along the three voxel vectors, the third fastest in the file
    AxisColumns voxelVectors{};            ///< one step each
    glm::dvec3 origin{0.0};                ///< position of the first sample
    Crystal crystal;                       ///< lattice: the vectors of the whole box
    std::vector<std::string> fields;       ///< names of the values that stand at each sample; at least one
    std::vector<std::string> notes;
};

/// The first 64 KiB have the shape of a cube's head up to the first atom.
[[nodiscard]] bool looksLikeCube(std::string_view head);

/// Reads up to the first value. Throws InvalidInput, LimitExceeded (too many values at a sample), Unsupported
/// (subject `name`).
[[nodiscard]] CubeHeader readCubeHeader(const std::string& name, TextScanner& text);

} // namespace voxsheet::import
