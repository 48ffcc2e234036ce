#include "import/mesh/solid_mesh.h"

#include "base/errors.h"
#include "import/mesh/mesh_intersections.h"
#include "import/mesh/mesh_merge.h"
#include "import/mesh/mesh_shells.h"

#include <algorithm>

namespace voxsheet::import {

namespace {

/// "1 edge", "12 edges"
std::string counted(std::size_t count, const std::string& singular, const std::string& plural = {}) {
    return std::to_string(count) + " " + (count == 1 ? singular : plural.empty() ? singular + "s" : plural);
}

std::string sideText(const TriangleMesh& mesh, Side side) {
    return pointText(mesh.points[beginOf(mesh.triangles, side)]) + " to " +
           pointText(mesh.points[endOf(mesh.triangles, side)]);
}

void addNote(TriangleMesh& mesh, std::size_t count, const std::string& sentence) {
    if (count > 0) mesh.notes.push_back(sentence);
}

MergeCounts& operator+=(MergeCounts& sum, const MergeCounts& counts) {
    sum.points += counts.points;
    sum.triangles += counts.triangles;
    return sum;
}

/// Merges points, exactly at first; the edges of the result.
MeshEdges joinTriangles(TriangleMesh& mesh, const std::string& file) {
    auto counts = mergePoints(mesh, 0.0);
    auto edges = pairEdges(mesh.triangles);
    if (edges.openCount > 0 && !mesh.triangles.empty()) {
        const auto bounds = boundsOf(mesh);
        const double tolerance = 1e-6 * glm::length(bounds.high - bounds.low);
        auto coarser = mesh;
        const auto more = mergePoints(coarser, tolerance);
        auto coarserEdges = pairEdges(coarser.triangles);
        if (coarserEdges.openCount == 0) {
            mesh = std::move(coarser);
            edges = std::move(coarserEdges);
            counts += more;
            mesh.notes.emplace_back(
                "Points up to a millionth of its diagonal apart were merged to close it.");
        }
    }
    addNote(mesh, counts.points, counted(counts.points, "duplicate point") + " merged.");
    addNote(mesh, counts.triangles, counted(counts.triangles, "triangle") + " without area dropped.");
    if (mesh.triangles.empty())
        throw InvalidInput(file, "all of its triangles have no area", "save a surface that bounds a solid");
    return edges;
}

void refuseOpenOrCrowded(const TriangleMesh& mesh, const MeshEdges& edges, const std::string& file) {
    if (edges.openCount > 0)
        throw InvalidInput(
            file,
            "its surface is open: " + counted(edges.openCount, "edge belongs", "edges belong") +
                " to one triangle only, the first from " + sideText(mesh, edges.firstOpen),
            "close its holes, for example with MeshLab's 'Close Holes' or Blender's 'Fill Holes'");
    if (edges.crowdedCount > 0)
        throw InvalidInput(
            file,
            counted(edges.crowdedCount, "edge belongs", "edges belong") +
                " to more than two triangles, the first from " + sideText(mesh, edges.firstCrowded),
            "remove walls inside the solid and faces that are there twice, for example with MeshLab's "
            "'Repair Non Manifold Edges'");
}

void refuseIntersections(const TriangleMesh& mesh, const std::string& file, const ReadProgress& progress) {
    const auto found = findIntersections(mesh, progress);
    if (found.count == 0) return;
    const std::string atLeast = found.count == MeshIntersections::most ? "at least " : "";
    throw InvalidInput(file,
                       "its surface cuts or touches itself: " + atLeast + counted(found.count, "pair") +
                           " of triangles, the first near " + pointText(found.place),
                       "unite its parts into one solid, for example with Blender's modifier 'Boolean' or "
                       "OpenSCAD's union()");
}

void noteShells(TriangleMesh& mesh, const ShellCounts& counts) {
    addNote(mesh, counts.turnedTriangles,
            counted(counts.turnedTriangles, "triangle") + " faced the other way than the rest: turned.");
    addNote(mesh, counts.turnedShells,
            counts.shells == 1 ? "Its surface was inside out: turned."
                               : counted(counts.turnedShells, "shell") + " inside out: turned.");
    addNote(mesh, counts.innerShells,
            counted(counts.innerShells, "shell") + " inside the solid, facing outwards: left out.");
    addNote(mesh, counts.flatShells, counted(counts.flatShells, "shell") + " without volume left out.");
}

} // namespace

SolidMesh makeSolid(TriangleMesh&& mesh, const std::string& file, const ReadProgress& progress) {
    SolidMesh solid{std::move(mesh), {}};
    auto& surface = solid.surface;
    surface.notes.insert(surface.notes.begin(), counted(surface.triangles.size(), "triangle") + " read.");
    const auto edges = joinTriangles(surface, file);
    refuseOpenOrCrowded(surface, edges, file);
    refuseIntersections(surface, file, progress);
    const auto counts = faceOutwards(surface, edges, file);
    noteShells(surface, counts);
    if (surface.triangles.empty())
        throw InvalidInput(file, "its surface encloses no volume", "save a surface that bounds a solid");
    solid.edges = pairEdges(surface.triangles);
    return solid;
}

} // namespace voxsheet::import
