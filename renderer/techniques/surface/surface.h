// Planar and box clipping by surface rendering (Khanduja & Karki 2007, section 3, "Clipping"): the visible
// faces of what the clip planes leave of the volume's box, as polygons (volume/convex_polytope.h) with the
// volume as their texture. Opaque.
//
// A pixel shows the value where its ray meets the face, by the transfer table's colour; NaN shows the table's
// colour for it. With a clip object the ray goes on from the face, in steps of tile.sampleDistanceVoxels but
// at most one voxel, to the first point that the object keeps: so the object's own surface is capped too.
// With the eye inside what is kept, the faces behind are seen from within. Normals are the faces' own.
#pragma once

#include "gpu/framebuffer.h"
#include "stages/shared_stages.h"

#include <optional>

namespace voxsheet {

struct SurfaceVertex {
    glm::vec4 position; ///< clip coordinates
    float face;         ///< index into the uniforms that describe faces
};

/// Keeps vertices and the depth buffer from picture to picture.
class SurfaceTechnique {
public:
    explicit SurfaceTechnique(gpu::Context& context) : context_(context) {}
    void draw(SharedStages& stages, const DrawRequest& request);

private:
    [[nodiscard]] const gpu::Texture& depthFor(glm::ivec2 sizePixels);
    void uploadVertices(std::span<const std::byte> bytes);

    gpu::Context& context_;
    std::optional<gpu::Buffer> vertices_;
    std::optional<gpu::VertexArray> layout_;
    std::optional<gpu::Texture> depth_;
};

} // namespace voxsheet
