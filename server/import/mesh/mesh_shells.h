// The connected pieces of a closed surface, and which way they face.
#pragma once

#include "import/mesh/mesh_edges.h"

namespace voxsheet::import {

struct ShellCounts {
    std::size_t shells = 0;          ///< in the result
    std::size_t turnedTriangles = 0; ///< that faced the other way than their neighbours
    std::size_t turnedShells = 0;    ///< that were inside out
    std::size_t innerShells = 0;     ///< dropped: inside the solid, facing out
    std::size_t flatShells = 0;      ///< dropped: around no volume
};

/// Makes all triangles face out of one solid: those points about which the surface winds once or more. Turns
/// triangles that face the other way than their neighbours, and shells that are inside out; a shell within
/// another that faces inwards is a cavity and stays, one that faces outwards is part of the solid already and
/// is dropped. Shells that enclose no volume are dropped; all triangles may be gone afterwards.
/// \param edges  of the mesh: no open or crowded ones; stale afterwards
/// Throws InvalidInput (subject `file`) if the surface has one side only, LimitExceeded above 20000 shells.
ShellCounts faceOutwards(TriangleMesh& mesh, const MeshEdges& edges, const std::string& file);

} // namespace voxsheet::import
