// What a legacy VTK file holds and where (VTK User's Guide, "Simple Legacy Formats").
#pragma once

#include "import/formats/input_file.h"
#include "volume/scalar_type.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace voxsheet::import {

enum class LegacyAttribute { Point, Cell };

struct LegacyArray {
    std::string name;
    LegacyAttribute attribute = LegacyAttribute::Point;
    ScalarType type = ScalarType::F32; ///< of a value in the file; text is parsed as this
    int components = 1;
    bool colours = false;     ///< components are no directions
    std::uint64_t offset = 0; ///< of the first number in the file
};

struct LegacyVtkHeader {
    bool binary = false; ///< big-endian numbers instead of text
    glm::ivec3 dims{1};  ///< points
    /// Of a rectilinear grid: as many numbers along x, y, z as dims says; empty otherwise.
    std::vector<LegacyArray> coordinates;
    glm::dvec3 spacing{1.0};
    glm::dvec3 origin{0.0};
    std::vector<LegacyArray>
        arrays; ///< numeric arrays with one tuple per point or cell, all of them within the file
    std::vector<std::string> notes;
};

/// Cells between the points: one less per axis, and one where there is a single point.
[[nodiscard]] glm::ivec3 cellDims(const glm::ivec3& pointDims);

/// Walks over the whole file, numbers included, and allocates none of them. Throws InvalidInput if the file
/// is damaged, lies about its size or is truncated; Unsupported for data sets other than structured points
/// and rectilinear grids, and for text in arrays.
[[nodiscard]] LegacyVtkHeader parseLegacyVtk(const InputFile& file);

} // namespace voxsheet::import
