// Direct volume rendering by view-aligned slices of the 3D texture, blended back to front (Cabral et al.
// 1994; Khanduja & Karki 2007, "Volume rendering").
//
// Slices are slabs between planes at right angles to the view direction: slab k holds the view depths [c + k
// D, c + (k + 1) D], for all integers k, with c the depth of the centre of the volume's box and D the depth
// over which the central ray (picture centre) advances tile.sampleDistanceVoxels in the drawn level's index
// frame. A pixel's sample sits in the middle of its ray's path through slab and box, in front of the eye: on
// the slab's middle plane, but where a face of the box cuts the slab. Its alpha is 1 - (1 - opacity)^(length
// / unitLength) with the world length of that path, so that pictures in perspective do not darken towards
// their middle and the box has no steps. Blending: premultiplied, "over", in a 32-bit float target.
//
// A polygon carries a few neighbouring slices, which the fragment shader blends before the framebuffer does:
// the same samples in the same order at a fraction of the framebuffer traffic, and one look-up can leave out
// all of them in empty space.
#pragma once

#include "gpu/framebuffer.h"
#include "stages/shared_stages.h"

#include <cstddef>
#include <optional>
#include <span>

namespace voxsheet {

struct SliceVertex {
    glm::vec2 position; ///< normalised device coordinates
    float firstDepth;   ///< where the first slab of the polygon begins, in the unit of RayFrame
};

struct Slabs {
    double depth;         ///< of each, in the unit of RayFrame
    double longestVoxels; ///< the longest way of a ray of the picture through one, in the index frame
};

[[nodiscard]] Slabs slabsOf(const TileSpec& tile, const RayFrame& frame, const glm::ivec3& levelDims);

/// Keeps the buffer of vertices from picture to picture.
class SlicingTechnique {
public:
    explicit SlicingTechnique(gpu::Context& context) : context_(context) {}
    void draw(SharedStages& stages, const DrawRequest& request);

private:
    void drawTriangles(SharedStages& stages, const DrawRequest& request,
                       std::span<const SliceVertex> vertices, double slabDepth, int slabsPerPolygon);
    void uploadVertices(std::span<const std::byte> bytes);

    gpu::Context& context_;
    std::optional<gpu::Buffer> vertices_;
    std::optional<gpu::VertexArray> layout_;
};

} // namespace voxsheet
