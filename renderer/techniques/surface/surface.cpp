#include "techniques/surface/surface.h"

#include "volume/convex_polytope.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace voxsheet {
namespace {

/// Clip coordinates of a camera; the near plane lies so close that nothing of a volume is lost before it.
glm::dmat4 clipFromWorld(const TileSpec& tile, const RayFrame& frame) {
    const double radius = frame.radiusWorld;
    const double depth = frame.centreDepthWorld;
    const auto& half = frame.pictureHalf;
    glm::dmat4 clipFromView(0.0);
    if (frame.perspective) {
        const double near = 1e-5 * radius;
        const double far = std::max(depth + 2.0 * radius, 2.0 * near);
        clipFromView[0][0] = 1.0 / half.x;
        clipFromView[1][1] = 1.0 / half.y;
        clipFromView[2][2] = -(far + near) / (far - near);
        clipFromView[2][3] = -1.0;
        clipFromView[3][2] = -2.0 * far * near / (far - near);
    } else {
        clipFromView[0][0] = 1.0 / (half.x * radius);
        clipFromView[1][1] = 1.0 / (half.y * radius);
        clipFromView[2][2] = -1.0 / (2.0 * radius);
        clipFromView[3][2] = -depth / (2.0 * radius);
        clipFromView[3][3] = 1.0;
    }
    return clipFromView * tile.camera.viewFromWorld;
}

bool isInside(const ConvexPolytope& polytope, const glm::dvec3& point) {
    return std::all_of(polytope.faces.begin(), polytope.faces.end(), [&](const PolytopeFace& face) {
        return glm::dot(face.outwardNormal, point - face.polygon.front()) <= 0.0;
    });
}

/// Whether the outside of a face is turned to the eye.
bool facesEye(const PolytopeFace& face, const TileSpec& tile) {
    const auto worldFromView = glm::inverse(tile.camera.viewFromWorld);
    const auto toEye = tile.camera.projection == Projection::Perspective
                           ? glm::dvec3(worldFromView[3]) - face.polygon.front()
                           : glm::dvec3(worldFromView[2]);
    return glm::dot(face.outwardNormal, toEye) > 0.0;
}

struct Faces {
    std::vector<SurfaceVertex> vertices;
    std::vector<glm::vec4> planes;  ///< texture frame
    std::vector<glm::vec4> normals; ///< view frame
};

void append(Faces& faces, const PolytopeFace& face, const TileSpec& tile, const Grid& grid,
            const glm::dmat4& toClip) {
    const auto index = static_cast<float>(faces.planes.size());
    const ClipPlane plane{face.outwardNormal, glm::dot(face.outwardNormal, face.polygon.front())};
    faces.planes.push_back(clipPlanesInTexture({plane}, grid).front());
    faces.normals.emplace_back(glm::dvec4(glm::dmat3(tile.camera.viewFromWorld) * face.outwardNormal, 0.0));
    for (std::size_t point = 2; point < face.polygon.size(); ++point)
        for (const std::size_t corner : {std::size_t{0}, point - 1, point})
            faces.vertices.push_back({glm::vec4(toClip * glm::dvec4(face.polygon[corner], 1.0)), index});
}

Faces visibleFaces(const ConvexPolytope& polytope, const TileSpec& tile, const Grid& grid,
                   const RayFrame& frame, bool eyeInside) {
    const auto toClip = clipFromWorld(tile, frame);
    Faces faces;
    for (const auto& face : polytope.faces)
        if (facesEye(face, tile) != eyeInside) append(faces, face, tile, grid, toClip);
    return faces;
}

} // namespace

const gpu::Texture& SurfaceTechnique::depthFor(glm::ivec2 sizePixels) {
    if (!depth_ || depth_->size() != glm::ivec3(sizePixels, 1)) {
        depth_.reset();
        depth_.emplace(context_, GL_TEXTURE_2D, GL_DEPTH_COMPONENT32F, glm::ivec3(sizePixels, 1));
    }
    return *depth_;
}

void SurfaceTechnique::uploadVertices(std::span<const std::byte> bytes) {
    if (!vertices_ || vertices_->bytes() < bytes.size()) {
        layout_.reset();
        vertices_.emplace(context_, std::max<std::size_t>(bytes.size() * 3 / 2, 4096));
        layout_.emplace(context_);
        layout_->attribute(0, *vertices_, 4, sizeof(SurfaceVertex), 0);
        layout_->attribute(1, *vertices_, 1, sizeof(SurfaceVertex), sizeof(glm::vec4));
    }
    vertices_->upload(0, bytes);
}

void SurfaceTechnique::draw(SharedStages& stages, const DrawRequest& request) {
    const auto& [tile, volumes, frame, target, rows] = request;
    const auto& grid = volumes.volume.meta->grid;
    const auto polytope = clippedBox(drawnGrid(grid, tile.periodic), tile.clip.planes);
    const auto eye = glm::dvec3(glm::inverse(tile.camera.viewFromWorld)[3]);
    const bool eyeInside = frame.perspective && isInside(polytope, eye);
    const auto faces = visibleFaces(polytope, tile, placedGrid(grid, tile.periodic), frame, eyeInside);

    const gpu::Framebuffer framebuffer(context_, *target, &depthFor(tile.sizePixels));
    const auto [firstRow, endRow] = rows.within(tile.sizePixels);
    framebuffer.bindRows(firstRow, endRow);
    const glm::vec4 transparent(0.0F);
    const float farthest = 1.0F;
    glClearBufferfv(GL_COLOR, 0, &transparent.x);
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    if (!faces.vertices.empty()) {
        const auto& program =
            stages.programs.graphics("techniques/surface/surface_vertex.glsl",
                                     "techniques/surface/surface_fragment.glsl", stages.definesFor(request));
        stages.bindFor(program, request);
        program.set("facePlanes", faces.planes);
        program.set("faceNormals", faces.normals);
        program.set("voxelsPerTexture", glm::vec3(volumes.volume.dims));
        program.set("sampleDistanceVoxels", static_cast<float>(tile.sampleDistanceVoxels));
        program.set("eyeInside", eyeInside ? 1 : 0);
        program.set("nanColour", tile.transfer->nan);
        uploadVertices(std::as_bytes(std::span(faces.vertices)));
        program.use();
        layout_->bind();
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LEQUAL);
        glDisable(GL_CULL_FACE);
        glDisable(GL_BLEND);
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(faces.vertices.size()));
        glDisable(GL_DEPTH_TEST);
    }
    gpu::Framebuffer::unbind();
    // llvmpipe may run raster work that is still queued after later compute work on the same texture.
    glFlush();
}

} // namespace voxsheet
