// What box, clip planes and clip object leave of a ray, in double precision: the same rules as the renderer's
// shaders (stages/clip_stage.h), for picking.
#pragma once

#include "engine/level_samples.h"
#include "stages/tile_spec.h"
#include "volume/grid.h"

#include <glm/glm.hpp>

#include <memory>
#include <optional>

namespace voxsheet::engine {

/// A ray of the world, `direction` of unit length.
struct Ray {
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0, 0.0, -1.0};

    [[nodiscard]] glm::dvec3 at(double depth) const { return origin + depth * direction; }
};

/// Through the point `pixel` of a picture, (0, 0) its top left corner.
[[nodiscard]] Ray pixelRay(const CameraSpec& camera, glm::dvec2 pixel, glm::ivec2 sizePixels);

/// Depths along a ray.
struct RaySpan {
    double begin = 0.0;
    double end = 0.0;

    [[nodiscard]] double length() const { return end - begin; }
};

/// Where the ray is inside the drawn box and on the kept side of all planes, in front of the eye.
struct KeptSpan {
    RaySpan span;
    bool cut = false;   ///< begins at a clip plane, not at a face of the box or the eye
    bool atEye = false; ///< begins at the eye, which is inside
};
/// Empty if nothing is left.
[[nodiscard]] std::optional<KeptSpan> keptSpan(const Ray& ray, const Grid& grid,
                                               const std::vector<ClipPlane>& planes);

/// A clip object's distances at hand.
struct ObjectSamples {
    Grid grid;
    std::shared_ptr<const LevelSamples> distances; ///< level 0
};

/// What a clip object leaves of one ray. Keeps references: outlived by its arguments.
class ObjectCut {
public:
    ObjectCut(const Ray& ray, const ClipObject& object, const ObjectSamples& samples);

    [[nodiscard]] bool keeps(double depth) const { return isKept(measure(depth)); }
    /// The kept part of a stretch: up to, or from, where the distances, taken as linear over the stretch,
    /// cross zero. With binary distances the stretch counts as a whole, by its middle. Empty: none of it.
    [[nodiscard]] std::optional<RaySpan> keptPart(const RaySpan& stretch) const;
    /// Where the ray comes from what is removed into what is kept within the stretch, by its two ends.
    [[nodiscard]] std::optional<double> entry(const RaySpan& stretch) const;

private:
    /// Signed distance, turned so that what is kept is positive.
    [[nodiscard]] double measure(double depth) const;
    [[nodiscard]] bool isKept(double measure) const;

    const ClipObject& object_;
    const LevelSamples& distances_;
    Ray textureRay_; ///< in the object's texture frame; its direction is that of one unit of depth
};

} // namespace voxsheet::engine
