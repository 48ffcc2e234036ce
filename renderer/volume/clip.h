// What is cut away from a volume: half-spaces, which together leave a convex piece, and a clip object of any
// shape.
//
// A clip object is a volume of signed distances (negative inside; Lorensen 1993, as in Khanduja & Karki 2007,
// section 3): a dataset like any other, so that one texture serves every cell that uses it. It moves, turns
// and scales by its matrix alone.
#pragma once

#include <glm/glm.hpp>

#include <optional>
#include <string>
#include <vector>

namespace voxsheet {

/// Keeps the points p of the world with dot(normal, p) >= offset.
struct ClipPlane {
    glm::dvec3 normal{1.0, 0.0, 0.0}; ///< unit length
    double offset = 0.0;              ///< world units from the origin along the normal

    bool operator==(const ClipPlane&) const = default;
};

enum class ClipMode {
    Probe, ///< keeps what is inside the object
    Clip   ///< keeps what is outside
};

struct ClipObject {
    /// DatasetMeta::key of a dataset whose field 0, step 0, level 0 holds signed distances in units of its
    /// own world: of the volume store, or one of the analytic shapes of volume/clip_shapes.h.
    std::string dataset;
    glm::dmat4 objectFromWorld{
        1.0}; ///< affine, invertible: from the drawn volume's world to the object's own
    ClipMode mode = ClipMode::Clip;
    /// For comparison, the binary texture that Khanduja & Karki start from: the sign of the nearest sample
    /// decides.
    bool binary = false;

    bool operator==(const ClipObject&) const = default;
};

inline constexpr std::size_t kMaxClipPlanes = 16; ///< eight of a user's own, six of a box, and two to spare

struct ClipSpec {
    std::vector<ClipPlane>
        planes; ///< at most kMaxClipPlanes; what is kept lies on the right side of all of them
    std::optional<ClipObject> object;

    bool operator==(const ClipSpec&) const = default;
};

} // namespace voxsheet
