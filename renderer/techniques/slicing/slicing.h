// Direct volume rendering by view-aligned slices of the 3D texture, blended back to front (Cabral et al.
// 1994; Khanduja & Karki 2006, "Volume rendering").
//
// Planes stand at right angles to the view direction at the view depths c + (k + 1/2) D for all integers k,
// with c the depth of the centre of the volume's box and D the depth over which the central ray (picture
// centre) advances tile.sampleDistanceVoxels in the drawn level's index frame; each is cut with the box, in
// front of the eye. A pixel's sample is where its ray meets the plane. Its alpha is 1 - (1 - opacity)^(length
// / unitLength) with the ray's own world length between two planes, D sqrt(1 + |q|^2) in perspective (q:
// tangents of the ray), so that the picture does not darken towards its middle. Blending: premultiplied,
// "over", in a 32-bit float target.
#pragma once

#include "gpu/framebuffer.h"
#include "stages/shared_stages.h"

#include <cstddef>
#include <optional>
#include <span>

namespace voxsheet {

struct SliceVertex {
    glm::vec2 position; ///< normalised device coordinates
    float depth;        ///< the slice's, in the unit of RayFrame
};

/// Keeps the buffer of slice vertices from picture to picture.
class SlicingTechnique {
public:
    explicit SlicingTechnique(gpu::Context& context) : context_(context) {}
    void draw(SharedStages& stages, const DrawRequest& request);

private:
    void drawTriangles(SharedStages& stages, const DrawRequest& request,
                       std::span<const SliceVertex> vertices, double spacing);
    void uploadVertices(std::span<const std::byte> bytes);

    gpu::Context& context_;
    std::optional<gpu::Buffer> vertices_;
    std::optional<gpu::VertexArray> layout_;
};

} // namespace voxsheet
