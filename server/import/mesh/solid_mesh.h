// From the triangles of a file to the surface of a solid, or a sentence that says what is wrong with them.
#pragma once

#include "import/mesh/mesh_edges.h"
#include "import/source_reader.h"

namespace voxsheet::import {

/// Closed, without self-intersections, facing outwards; each point once.
struct SolidMesh {
    TriangleMesh surface; ///< its notes say what was repaired
    MeshEdges edges;
};

/// Repairs, each with a note: points at one place are merged (up to 1e-6 of the diagonal apart if the surface
/// is open otherwise); triangles with two equal corners are dropped; faceOutwards (mesh_shells.h).
/// \param progress  0 .. 1; may be empty
/// Throws InvalidInput (subject `file`) if edges belong to one triangle only or to more than two, if the
/// surface cuts itself, has one side only, or encloses nothing; the sentence says how many and where.
[[nodiscard]] SolidMesh makeSolid(TriangleMesh&& mesh, const std::string& file, const ReadProgress& progress);

} // namespace voxsheet::import
