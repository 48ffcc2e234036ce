#include "techniques/slicing/slicing.h"

#include "techniques/slicing/box_slicer.h"

#include <algorithm>
#include <cmath>

namespace voxsheet {
namespace {

/// The box in the frame (x, y: view coordinates, z: depth beyond the box's centre), all in bounding radii.
BoxCorners cornersInView(const RayFrame& frame, const glm::dmat3& viewFromTexture, const glm::dvec3& centre) {
    BoxCorners corners{};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 texture((corner & 1) ? frame.boxHigh.x : frame.boxLow.x,
                                 (corner & 2) ? frame.boxHigh.y : frame.boxLow.y,
                                 (corner & 4) ? frame.boxHigh.z : frame.boxLow.z);
        const auto view =
            viewFromTexture * (texture - 0.5 * (frame.boxLow + frame.boxHigh)) / frame.radiusWorld;
        corners[static_cast<std::size_t>(corner)] = {centre.x + view.x, centre.y + view.y, -view.z};
    }
    return corners;
}

/// Triangle fans of all slices as plain triangles, farthest slice first.
std::vector<SliceVertex> sliceTriangles(const std::vector<Slice>& slices, const RayFrame& frame) {
    std::vector<SliceVertex> vertices;
    vertices.reserve(slices.size() * 12);
    for (const auto& slice : slices) {
        // In perspective all points of a slice share their distance from the eye, so dividing by it here
        // loses nothing.
        const double distance = frame.perspective ? slice.depth - frame.nearest : 1.0;
        const auto vertex = [&](int point) {
            const auto picture = slice.ring[static_cast<std::size_t>(point)] / (distance * frame.pictureHalf);
            return SliceVertex{glm::vec2(picture), static_cast<float>(slice.depth)};
        };
        for (int point = 2; point < slice.points; ++point) {
            vertices.push_back(vertex(0));
            vertices.push_back(vertex(point - 1));
            vertices.push_back(vertex(point));
        }
    }
    return vertices;
}

} // namespace

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
    const auto& [tile, volume, frame, target] = request;
    const auto& grid = volume.meta->grid;
    const glm::dmat3 viewFromTexture(tile.camera.viewFromWorld * worldFromTexture(grid));
    const auto centreView = glm::dvec3(tile.camera.viewFromWorld * glm::dvec4(centreWorld(grid), 1.0));
    const double spacing =
        tile.sampleDistanceVoxels * voxelLengthAlong(frame, volume.dims, glm::dvec2(0.0)) / frame.radiusWorld;
    const auto slices = sliceBox(cornersInView(frame, viewFromTexture, centreView / frame.radiusWorld),
                                 {0.0, spacing, frame.nearest});
    const gpu::Framebuffer framebuffer(context_, target);
    framebuffer.bind();
    const glm::vec4 transparent(0.0F);
    glClearBufferfv(GL_COLOR, 0, &transparent.x);
    const auto vertices = sliceTriangles(slices, frame);
    if (!vertices.empty()) drawTriangles(stages, request, vertices, spacing);
    gpu::Framebuffer::unbind();
    // llvmpipe may run raster work that is still queued after later compute work on the same texture.
    glFlush();
}

void SlicingTechnique::drawTriangles(SharedStages& stages, const DrawRequest& request,
                                     std::span<const SliceVertex> vertices, double spacing) {
    const auto& [tile, volume, frame, target] = request;
    const double exponent = spacing * frame.radiusWorld / tile.unitLengthWorld;
    std::optional<double> uniformExponent;
    if (!frame.perspective) uniformExponent = exponent;
    auto defines = ClassificationStage::defines(*tile.transfer, volume);
    defines.emplace_back("UNIFORM_EXPONENT", uniformExponent ? "1" : "0");
    const auto& program = stages.programs.graphics("techniques/slicing/slice_vertex.glsl",
                                                   "techniques/slicing/slice_fragment.glsl", defines);
    stages.classification.bind(program, tile.transfer, uniformExponent, volume);
    setRayUniforms(program, frame, tile.sizePixels);
    program.set("exponentPerRadius", static_cast<float>(exponent));

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
