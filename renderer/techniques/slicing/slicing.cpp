#include "techniques/slicing/slicing.h"

#include "techniques/slicing/box_slicer.h"
#include "volume/convex_polytope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace voxsheet {
namespace {

std::array<glm::dvec2, 4> pictureCorners(const RayFrame& frame) {
    const auto& half = frame.pictureHalf;
    return {-half, glm::dvec2(half.x, -half.y), half, glm::dvec2(-half.x, half.y)};
}

/// Per axis, the most that a ray of the picture advances in the texture frame per unit of depth.
glm::dvec3 steepestAdvance(const RayFrame& frame) {
    glm::dvec3 steepest(0.0);
    for (const auto& q : pictureCorners(frame))
        steepest = glm::max(steepest, glm::abs(voxelsPerDepth(frame, glm::ivec3(1), q)));
    return steepest;
}

struct TextureBox {
    glm::dvec3 low;
    glm::dvec3 high;
};

/// Around what the clip planes leave of the box, in the texture frame; nothing if they leave nothing.
std::optional<TextureBox> keptBox(const DrawRequest& request) {
    const auto& [tile, volumes, frame, target, rows] = request;
    if (tile.clip.planes.empty()) return TextureBox{frame.boxLow, frame.boxHigh};
    const auto& grid = volumes.volume.meta->grid;
    const auto polytope = clippedBox(drawnGrid(grid, tile.periodic), tile.clip.planes);
    if (polytope.empty()) return std::nullopt;
    const auto textureFromWorld = glm::inverse(worldFromTexture(placedGrid(grid, tile.periodic)));
    TextureBox box{frame.boxHigh, frame.boxLow};
    for (const auto& face : polytope.faces)
        for (const auto& point : face.polygon) {
            const auto texture = glm::dvec3(textureFromWorld * glm::dvec4(point, 1.0));
            box.low = glm::min(box.low, texture);
            box.high = glm::max(box.high, texture);
        }
    return box;
}

/// The box, wider by `margin` (texture frame) on all sides, in the frame (x, y: view coordinates, z: depth
/// beyond the centre of the volume's box), all in bounding radii.
BoxCorners cornersInView(const TextureBox& box, const RayFrame& frame, const glm::dvec3& margin,
                         const glm::dmat4& viewFromTexture) {
    const auto low = box.low - margin;
    const auto high = box.high + margin;
    BoxCorners corners{};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 texture((corner & 1) ? high.x : low.x, (corner & 2) ? high.y : low.y,
                                 (corner & 4) ? high.z : low.z);
        const auto view = glm::dvec3(viewFromTexture * glm::dvec4(texture, 1.0));
        corners[static_cast<std::size_t>(corner)] =
            glm::dvec3(view.x, view.y, -view.z - frame.centreDepthWorld) / frame.radiusWorld;
    }
    return corners;
}

void appendFan(std::vector<SliceVertex>& vertices, std::span<const glm::vec2> ring, float firstDepth) {
    for (std::size_t point = 2; point < ring.size(); ++point)
        for (const std::size_t corner : {std::size_t{0}, point - 1, point})
            vertices.push_back({ring[corner], firstDepth});
}

/// Polygons as triangles, farthest first. One that reaches up to the eye or behind it covers the picture.
std::vector<SliceVertex> triangles(const std::vector<Slice>& polygons, const RayFrame& frame,
                                   double thickness) {
    static constexpr std::array<glm::vec2, 4> wholePicture{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    std::vector<SliceVertex> vertices;
    vertices.reserve(polygons.size() * 12);
    for (const auto& polygon : polygons) {
        const auto firstDepth = static_cast<float>(polygon.depth - 0.5 * thickness);
        if (frame.perspective && polygon.depth - frame.nearest <= 0.5 * thickness) {
            appendFan(vertices, wholePicture, firstDepth);
            continue;
        }
        // All points of a polygon share their distance from the eye: dividing by it here keeps the rasteriser
        // affine.
        const double distance = frame.perspective ? polygon.depth - frame.nearest : 1.0;
        std::array<glm::vec2, 6> ring{};
        for (std::size_t i = 0; i < ring.size(); ++i)
            ring[i] = glm::vec2(polygon.ring[i] / (distance * frame.pictureHalf));
        appendFan(vertices, std::span(ring).first(static_cast<std::size_t>(polygon.points)), firstDepth);
    }
    return vertices;
}

} // namespace

Slabs slabsOf(const TileSpec& tile, const RayFrame& frame, const glm::ivec3& levelDims) {
    const double depth =
        tile.sampleDistanceVoxels / glm::length(voxelsPerDepth(frame, levelDims, glm::dvec2(0.0)));
    return {depth, depth * glm::length(steepestAdvance(frame) * glm::dvec3(levelDims))};
}

void SlicingTechnique::uploadVertices(std::span<const std::byte> bytes) {
    if (!vertices_ || vertices_->bytes() < bytes.size()) {
        layout_.reset();
        vertices_.emplace(context_, std::max<std::size_t>(bytes.size() * 3 / 2, 4096));
        layout_.emplace(context_);
        layout_->attribute(0, *vertices_, 3, sizeof(SliceVertex), 0);
    }
    vertices_->upload(0, bytes);
}

void SlicingTechnique::draw(SharedStages& stages, const DrawRequest& request) {
    const auto& [tile, volumes, frame, target, rows] = request;
    const auto& volume = volumes.volume;
    const auto slabs = slabsOf(tile, frame, volume.dims);
    const auto steepest = steepestAdvance(frame);
    const int slabsPerPolygon = chunkSamples(slabs.longestVoxels, kLongReach);
    const double thickness = slabs.depth * slabsPerPolygon;
    std::vector<SliceVertex> vertices;
    if (const auto box = keptBox(request)) {
        const auto placed = placedGrid(volume.meta->grid, tile.periodic);
        const auto corners = cornersInView(*box, frame, 0.5 * thickness * steepest,
                                           tile.camera.viewFromWorld * worldFromTexture(placed));
        vertices =
            triangles(sliceBox(corners, {0.0, thickness, frame.nearest - 0.5 * thickness}), frame, thickness);
    }

    const gpu::Framebuffer framebuffer(context_, *target);
    const auto [firstRow, endRow] = rows.within(tile.sizePixels);
    framebuffer.bindRows(firstRow, endRow);
    const glm::vec4 transparent(0.0F);
    glClearBufferfv(GL_COLOR, 0, &transparent.x);
    if (!vertices.empty()) drawTriangles(stages, request, vertices, slabs.depth, slabsPerPolygon);
    gpu::Framebuffer::unbind();
    // llvmpipe may run raster work that is still queued after later compute work on the same texture.
    glFlush();
}

void SlicingTechnique::drawTriangles(SharedStages& stages, const DrawRequest& request,
                                     std::span<const SliceVertex> vertices, double slabDepth,
                                     int slabsPerPolygon) {
    const auto& [tile, volumes, frame, target, rows] = request;
    auto defines = stages.definesFor(request);
    defines.emplace_back("SLABS_PER_POLYGON", std::to_string(slabsPerPolygon));
    const auto& program = stages.programs.graphics("techniques/slicing/slice_vertex.glsl",
                                                   "techniques/slicing/slice_fragment.glsl", defines);
    stages.bindFor(program, request);
    if (stages.skipEmptySpace)
        stages.emptySpace.bindOccupied(program, tile.transfer, volumes.volume, kLongReach);
    program.set("voxelsPerTexture", glm::vec3(volumes.volume.dims));
    program.set("slabDepth", static_cast<float>(slabDepth));
    program.set("unitsPerRadius", static_cast<float>(frame.radiusWorld / tile.unitLengthWorld));

    uploadVertices(std::as_bytes(vertices));
    program.use();
    layout_->bind();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()));
    glDisable(GL_BLEND);
}

} // namespace voxsheet
