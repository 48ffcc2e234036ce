// Surfaces of triangles (STL, PLY, OBJ) as volumes of signed distances: clip objects.
#pragma once

#include "import/source_reader.h"

#include <memory>
#include <vector>

namespace voxsheet::import {

/// One reader per format. The dataset has one F32 field "distance" of the quantity "signed distance": exact
/// Euclidean distances in the file's unit of length (which no such file names), negative inside, on gridAbout
/// (mesh_distance.h) with ImportOptions::resolution samples along the longest axis, or 96. The surface must
/// bound a solid: solid_mesh.h says what is repaired and what is refused, the latter when the data are read.
[[nodiscard]] std::vector<std::unique_ptr<SourceReader>> makeMeshReaders();

} // namespace voxsheet::import
