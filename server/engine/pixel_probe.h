// What lies under a pixel of a cell's picture.
#pragma once

#include "engine/kept_ray.h"
#include "engine/level_samples.h"
#include "stages/tile_spec.h"
#include "volume/grid.h"

#include <glm/glm.hpp>

#include <functional>
#include <optional>

namespace voxsheet::engine {

enum class HitKind {
    Isosurface, ///< a surface of the isosurface technique
    Face,       ///< a face of the box, a cut, the surface of a clip object, or technique plane's plane
    Sample,     ///< a sample of a volume
    Middle      ///< nothing along the ray is opaque enough: the kept point nearest to the middle of the box
};

struct PixelHit {
    glm::dvec3 world{0.0};
    HitKind kind = HitKind::Middle;
    std::optional<double> isovalue; ///< Isosurface
    double depth = 0.0;             ///< along pixelRay
};

/// The volumes that a picture is made of.
struct ProbedVolumes {
    const Grid& grid;            ///< of the drawn volume
    const LevelSamples& level;   ///< any level of it
    const ObjectSamples* object; ///< not null if tile.clip.object is set
};

/// The point that the eye sees, among what clipping keeps: an isosurface's first crossing (or a cap before
/// it); the face that technique surface shows; maximum intensity projection's largest sample; the point of
/// technique plane's plane; of volume rendering the first sample of at least the given opacity, or where the
/// accumulated opacity passes one half. Empty where the ray meets nothing.
/// \param opacity  per unit length, as in the transfer function
[[nodiscard]] std::optional<PixelHit> pixelHit(const TileSpec& tile, const ProbedVolumes& volumes,
                                               glm::dvec2 pixel, std::optional<double> opacity = {});

/// The first crossing of a value between two depths, from sign changes between steps, each found to within
/// 1e-6 of a step; where the function is NaN there is none.
[[nodiscard]] std::optional<double> firstCrossing(const std::function<double(double depth)>& valueAt,
                                                  double isovalue, const RaySpan& span, double step);

} // namespace voxsheet::engine
