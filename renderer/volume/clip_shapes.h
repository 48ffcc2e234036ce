// Clip objects that are formulas: solids about the origin, as volumes of exact signed distances.
//
// Distances are Euclidean and negative inside (Lorensen 1993, as in Khanduja & Karki 2007, section 3), in the
// unit of the shape's own world, where each shape reaches from -1 to 1 on its longest axis. ClipObject places
// and scales it.
#pragma once

#include "volume/dataset.h"

#include <glm/glm.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace voxsheet {

enum class ClipShape {
    Sphere,    ///< radius 1
    Ellipsoid, ///< semi-axes 1, 0.75 and 0.5 along x, y and z
    Box,       ///< the cube [-1, 1]^3
    Cylinder,  ///< radius 1 about the z axis, from z = -1 to z = 1
    Torus,     ///< about the z axis: a tube of radius 0.3 about the circle of radius 0.7
};

/// "sphere", "ellipsoid", "box", "cylinder", "torus": in the order of ClipShape.
[[nodiscard]] std::span<const std::string_view> clipShapeNames() noexcept;
[[nodiscard]] std::string_view clipShapeName(ClipShape shape) noexcept;
[[nodiscard]] std::optional<ClipShape> clipShapeFromName(std::string_view name) noexcept;

/// The dataset key of a shape: "clip-shape:sphere". Throws InvalidInput if there is no shape of this name.
[[nodiscard]] std::string clipShapeKey(std::string_view name);
[[nodiscard]] std::string clipShapeKey(ClipShape shape);
/// The shape that a dataset key stands for; nothing for any other key.
[[nodiscard]] std::optional<ClipShape> clipShapeFromKey(std::string_view key) noexcept;

/// Exact signed distance of a point of the shape's world. The ellipsoid's comes from an iteration and is
/// within 1e-10 of the exact one.
[[nodiscard]] double clipShapeDistance(ClipShape shape, const glm::dvec3& point) noexcept;

/// Signed Euclidean distance to the ellipsoid about the origin with the given semi-axes (each > 0), to
/// within about 1e-12 of the longest one.
[[nodiscard]] double ellipsoidDistance(const glm::dvec3& semiAxes, const glm::dvec3& point) noexcept;

inline constexpr int kClipShapeSamples = 81;        ///< per axis: the faces at -1 and 1 fall on samples
inline constexpr double kClipShapeHalfWidth = 1.25; ///< the grid spans [-1.25, 1.25]^3, point-centred

/// Geometry and field (F32, quantity "signed distance") of a shape's dataset; no statistics yet.
[[nodiscard]] DatasetMeta clipShapeMeta(ClipShape shape);
/// Its samples: kClipShapeSamples^3 distances, x fastest.
[[nodiscard]] std::vector<float> clipShapeSamples(ClipShape shape);

} // namespace voxsheet
