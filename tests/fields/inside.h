// The truth for clipped, lit, surface and isosurface pictures, in double precision. Written from the
// definitions in techniques/*/*.h, volume/clip.h and stages/*_spec.h; shares no code with the shaders.
#pragma once

#include "fields/picture.h"
#include "fields/rays.h"
#include "fields/sources.h"
#include "stages/tile_spec.h"

#include <optional>
#include <vector>

namespace voxsheet::fields {

/// What stays the same along one ray; depths in world units of view depth.
struct RayTruth {
    RayTruth(const TileSpec& tile, const Sources& sources, const WorldRay& ray);

    const TileSpec& tile;
    const Sources& sources;
    WorldRay ray;
    KeptRange range;
    double voxelsPerDepth;
    double lengthPerDepth;

    [[nodiscard]] double value(double depth) const;
    /// >= 0 where the clip object keeps the point; 1 without an object.
    [[nodiscard]] double measure(double depth) const;
    [[nodiscard]] bool isKept(double depth) const { return measure(depth) >= 0.0; }
    /// Gradients in the world, of any length.
    [[nodiscard]] glm::dvec3 gradient(double depth) const;
    [[nodiscard]] glm::dvec3 objectNormal(double depth) const;
    /// Phong, as ShadingSpec says; the colour itself when shading is off or there is no normal.
    [[nodiscard]] glm::dvec3 lit(const glm::dvec3& rgb, const glm::dvec3& normalWorld) const;
    /// The same, also when shading is off.
    [[nodiscard]] glm::dvec3 phong(const glm::dvec3& rgb, const glm::dvec3& normalWorld) const;
    /// The cut's normal of a sample within a voxel behind it.
    [[nodiscard]] std::optional<glm::dvec3> cutNormal(double depth) const;
    /// Normal of a sample of a volume: the cut's within a voxel behind it, else the gradient's.
    [[nodiscard]] glm::dvec3 sampleNormal(double depth) const;
    /// The last place in (depth - reach, depth] where the ray comes from what the object removes into what it
    /// keeps.
    [[nodiscard]] std::optional<double> lastEntry(double depth, double reach) const;
    /// Of two depths with measures of different sign: where the measure, linear in between, is 0.
    [[nodiscard]] double crossing(double begin, double end) const;

private:
    glm::dmat4 textureFromWorld_;
    glm::dmat4 clipFromWorld_{1.0};
    glm::dmat3 levelFromWorld_;
};

struct IsoHit {
    double depth = 0.0;
    int surface = 0; ///< of tile.isosurface.surfaces
};

/// Samples that the plain test (IsosurfaceMethod::AlphaTest) takes for hits, front to back.
[[nodiscard]] std::vector<IsoHit> plainTestHits(const RayTruth& ray);

/// All roots of the trilinear interpolant minus each isovalue inside the kept range and kept by the object,
/// front to back.
[[nodiscard]] std::vector<IsoHit> isoHits(const RayTruth& ray);

/// Where the picture's ray of the surface technique meets what is shown, and the face's normal there (world).
struct FaceHit {
    double depth = 0.0;
    glm::dvec3 normal{0.0};
};
[[nodiscard]] std::optional<FaceHit> faceHit(const RayTruth& ray);

/// The picture, for every technique, samples where tile.technique puts them.
/// \param everyNthPixel  of every n-th row: rays are slow
[[nodiscard]] Picture insidePicture(const TileSpec& tile, const Sources& sources, int everyNthPixel = 1);

/// Voxels of the drawn level that all rays pass within the kept range, in sum: divided by the distance of
/// samples, their number before any is skipped. The clip object is not asked.
[[nodiscard]] double keptVoxels(const TileSpec& tile, const Sources& sources);

/// How many pixels show a face: faceHit() of each.
[[nodiscard]] long facePixels(const TileSpec& tile, const Sources& sources);

/// The same in steps of `stepVoxels`: converged as they go to 0 (not for IsosurfaceMethod::AlphaTest).
[[nodiscard]] Picture insideConverged(TileSpec tile, const Sources& sources, double stepVoxels = 1.0 / 16.0);

/// What an isosurface picture shows along the ray, front to back, up to the first opaque one: isoHits() and
/// caps (surface -1); with IsosurfaceMethod::AlphaTest plainTestHits() alone.
[[nodiscard]] std::vector<IsoHit> shownHits(const RayTruth& ray);

} // namespace voxsheet::fields
