#include "engine/clip_resolver.h"

#include "base/errors.h"
#include "engine/unit_vector.h"
#include "volume/box_extent.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace voxsheet::engine {

namespace {

constexpr double kLargestEntry = 1e30; ///< of a matrix that floats are to hold
/// Of the box's extent along a normal: a plane this close to a face of the box is that face.
constexpr double kFaceTolerance = 1e-9;

/// \param position  fraction of the box along the normal, or world units
void addPlane(std::vector<ClipPlane>& planes, const glm::dvec3& normal, double position,
              sheet::ClipUnits units, const Grid& grid) {
    const Extent extent = extentAlong(normal, grid);
    const bool world = units == sheet::ClipUnits::World;
    const double fraction = world ? (position - extent.low) / extent.length() : position;
    if (fraction <= kFaceTolerance) return;
    const double inside = std::min(fraction, 2.0); // Beyond 1 nothing is left, however far beyond.
    planes.push_back({normal, world && fraction <= 2.0 ? position : extent.low + inside * extent.length()});
}

void addBox(std::vector<ClipPlane>& planes, const sheet::ClipStyle::Box& box, sheet::ClipUnits units,
            const Grid& grid) {
    const bool world = units == sheet::ClipUnits::World;
    const glm::dmat3 indexFromWorld = glm::inverse(glm::dmat3(grid.worldFromIndex));
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 normal(0.0);
        normal[axis] = 1.0;
        // Rows of the inverse are perpendicular to the planes of the other two axes.
        if (!world) normal = unitVector(glm::transpose(indexFromWorld)[axis]);
        addPlane(planes, normal, box.low[axis], units, grid);
        addPlane(planes, -normal, world ? -box.high[axis] : 1.0 - box.high[axis], units, grid);
    }
}

double halfShortestEdgeWorld(const Grid& grid) {
    const IndexBox box = boxIndex(grid);
    const glm::dvec3 edges = spacingWorld(grid) * (box.high - box.low);
    return 0.5 * std::min({edges.x, edges.y, edges.z});
}

/// About x, then y, then z.
glm::dmat3 rotationOf(const glm::dvec3& degrees) {
    const glm::dvec3 angle = glm::radians(degrees);
    glm::dmat4 rotation = glm::rotate(glm::dmat4(1.0), angle.z, glm::dvec3(0.0, 0.0, 1.0));
    rotation = glm::rotate(rotation, angle.y, glm::dvec3(0.0, 1.0, 0.0));
    return glm::dmat3(glm::rotate(rotation, angle.x, glm::dvec3(1.0, 0.0, 0.0)));
}

/// What stands between an object's own coordinates and the world, apart from clip.transform.
struct Placement {
    glm::dvec3 pivotWorld{0.0};     ///< the transform's origin
    double unitWorld = 1.0;         ///< of the transform's translation
    glm::dvec3 originInObject{0.0}; ///< what lands on the pivot
    double worldPerObjectUnit = 1.0;
};

Placement placementOf(const sheet::ClipStyle& clip, const ClipObjectVolume& volume, const Grid& cell) {
    Placement placement;
    if (clip.units == sheet::ClipUnits::World) return placement;
    placement.pivotWorld = centreWorld(cell);
    placement.unitWorld = halfShortestEdgeWorld(cell);
    placement.worldPerObjectUnit = placement.unitWorld;
    if (volume.extent) {
        placement.originInObject = centreWorld(*volume.extent);
        placement.worldPerObjectUnit = boundingRadiusWorld(cell) / boundingRadiusWorld(*volume.extent);
    }
    return placement;
}

bool fitsFloats(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!(std::abs(matrix[column][row]) < kLargestEntry)) return false;
        }
    }
    return true;
}

} // namespace

std::vector<ClipPlane> resolveClipPlanes(const sheet::ClipStyle& clip, const Grid& grid) {
    std::vector<ClipPlane> planes;
    for (const sheet::ClipStyle::Plane& plane : clip.planes)
        addPlane(planes, unitVector(plane.normal), plane.position, clip.units, grid);
    if (clip.box) addBox(planes, *clip.box, clip.units, grid);
    return planes;
}

ClipObject resolveClipObject(const sheet::ClipStyle& clip, const ClipObjectVolume& volume, const Grid& cell) {
    const Placement placement = placementOf(clip, volume, cell);
    // The inverse is written out: its last row must be exactly (0, 0, 0, 1), and a volume that was cut by its
    // own threshold must land on itself exactly.
    const glm::dmat3 back = glm::transpose(rotationOf(clip.transform.rotationDegrees));
    glm::dmat3 linear;
    for (int column = 0; column < 3; ++column)
        linear[column] = back[column] / clip.transform.scale / placement.worldPerObjectUnit;
    const glm::dvec3 moved = placement.pivotWorld + placement.unitWorld * clip.transform.translation;
    ClipObject object;
    object.dataset = volume.dataset;
    object.objectFromWorld = glm::dmat4(linear);
    object.objectFromWorld[3] = glm::dvec4(placement.originInObject - linear * moved, 1.0);
    object.mode = clip.mode == sheet::ClipMode::Probe ? ClipMode::Probe : ClipMode::Clip;
    object.binary = clip.representation == sheet::ClipRepresentation::Binary;
    if (!fitsFloats(object.objectFromWorld)) {
        throw InvalidInput("clip.transform",
                           "its scale or translation is out of all proportion to the volume",
                           "choose factors nearer to 1")
            .withField("clip.transform");
    }
    return object;
}

} // namespace voxsheet::engine
