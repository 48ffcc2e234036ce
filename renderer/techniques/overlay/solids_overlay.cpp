#include "techniques/overlay/solids_overlay.h"

#include "gpu/context.h"
#include "techniques/overlay/crosshair_solids.h"
#include "techniques/overlay/crystal_solids.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace voxsheet {
namespace {

constexpr float kNoSolid = 1e30F; ///< depth
/// Of lines, whichever is larger: bounding radii, pixels at the depth of the box's centre.
constexpr double kLineRadius = 0.002;
constexpr double kLineRadiusPixels = 0.75;

double lineRadius(const RayFrame& frame, glm::ivec2 sizePixels) {
    const double pixel =
        2.0 * frame.pictureHalf.y / sizePixels.y * (frame.perspective ? -frame.nearest : 1.0);
    return std::max(kLineRadius, kLineRadiusPixels * std::max(pixel, 0.0));
}

double meanScale(const glm::dmat4& matrix) {
    return std::cbrt(std::abs(glm::determinant(glm::dmat3(matrix))));
}

/// The frame of the shaders: x right, y up, z away from the eye, from the depth of the box's centre on,
/// bounding radii.
glm::dmat3 awayFromEye(const TileSpec& tile) {
    glm::dmat3 turned(1.0);
    turned[2][2] = -1.0;
    return turned * glm::dmat3(tile.camera.viewFromWorld);
}

bool showsCrystal(const TileSpec& tile, const DatasetMeta& meta) {
    return !tile.crystal.empty() && meta.crystal.has_value();
}

bool showsCrystal(const DrawRequest& request) {
    return showsCrystal(request.tile, *request.volumes.volume.meta);
}

bool showsCrosshair(const TileSpec& tile) {
    return tile.crosshairWorld.has_value() && tile.technique != Technique::Plane;
}

gpu::ShaderDefines definesOf(const SharedStages& stages, const DrawRequest& request) {
    const auto& [tile, volumes, frame, target, rows] = request;
    const bool flat = tile.technique == Technique::Plane;
    const bool clipped = !flat && showsCrystal(request);
    const auto* object = clipped ? volumes.clipObject : nullptr;
    auto defines = ClipStage::defines(clipped ? tile.clip : ClipSpec{}, object, stages.filterFloatsInShader);
    defines.emplace_back("SHADING", "1");
    defines.emplace_back("LIGHTS", std::to_string(tile.shading.lightsView.size()));
    defines.emplace_back("FLAT_CUT", flat ? "1" : "0");
    return defines;
}

} // namespace

bool showsSolids(const TileSpec& tile, const DatasetMeta& meta) {
    return showsCrystal(tile, meta) || showsCrosshair(tile);
}

const SolidsOverlay::Solids& SolidsOverlay::solidsOf(const DrawRequest& request) {
    const auto& [tile, volumes, frame, target, rows] = request;
    const bool flat = tile.technique == Technique::Plane;
    Key key{tile.dataset,
            tile.crystal,
            flat ? std::nullopt : tile.crosshairWorld,
            tile.periodic,
            flat,
            flat ? glm::dvec4(tile.plane.normal, tile.plane.offset) : glm::dvec4(0.0)};
    if (const auto* known = crystals_.find([&](const Key& other) { return other == key; })) return *known;
    const auto& meta = *volumes.volume.meta;
    auto solids = crosshairSolids(meta.grid, tile);
    if (showsCrystal(request)) {
        const auto ofCrystal = crystalSolids(*meta.crystal, meta.grid, tile);
        solids.insert(solids.end(), ofCrystal.begin(), ofCrystal.end());
    }
    Solids made;
    made.count = static_cast<int>(solids.size());
    if (made.count > 0) made.buffer.emplace(context_, solids.size() * sizeof(Solid), 0, solids.data());
    return crystals_.insert(std::move(key), std::move(made));
}

void SolidsOverlay::prepareTextures(glm::ivec2 sizePixels) {
    const glm::ivec3 size(sizePixels, 1);
    if (!layout_) layout_.emplace(context_);
    if (colours_ && colours_->size() == size) return;
    colours_.reset();
    depth_.reset();
    colours_.emplace(context_, GL_TEXTURE_2D, GL_RGBA32F, size);
    depth_.emplace(context_, GL_TEXTURE_2D, GL_DEPTH_COMPONENT32F, size);
}

void SolidsOverlay::bind(const gpu::Program& program, const DrawRequest& request) const {
    const auto& [tile, volumes, frame, target, rows] = request;
    const auto& grid = volumes.volume.meta->grid;
    const auto placed = placedGrid(grid, tile.periodic);
    const auto centre = centreWorld(drawnGrid(grid, tile.periodic));
    const double radius = frame.radiusWorld;
    setRayUniforms(program, frame, tile.sizePixels);
    ClipStage::bind(program, tile, placed,
                    tile.technique == Technique::Plane || !showsCrystal(request) ? nullptr
                                                                                 : volumes.clipObject);
    ShadingStage::bindLight(program, tile.shading);

    glm::dmat4 worldFromSolid(radius);
    worldFromSolid[3] = glm::dvec4(centre, 1.0);
    std::vector<glm::vec4> planes;
    for (const auto& plane : tile.clip.planes)
        planes.emplace_back(
            glm::dvec4(plane.normal, (glm::dot(plane.normal, centre) - plane.offset) / radius));
    program.set("solidClipPlanes", planes);
    if (const auto& object = tile.clip.object)
        program.set("measurePerRadius", static_cast<float>(radius * meanScale(object->objectFromWorld)));
    const auto viewFromSolid = awayFromEye(tile);
    const auto centreInView = glm::dvec3(tile.camera.viewFromWorld * glm::dvec4(centre, 1.0)) / radius;
    program.set("textureFromSolid", glm::mat4(glm::inverse(worldFromTexture(placed)) * worldFromSolid));
    program.set("viewFromSolid", glm::mat3(viewFromSolid));
    program.set("centreInView", glm::vec2(centreInView));
    program.set("pictureHalf", glm::vec2(frame.pictureHalf));
    program.set("lineRadius", static_cast<float>(lineRadius(frame, tile.sizePixels)));
    // dot(normal, p) = offset, for p of the shaders' frame.
    const auto normal = viewFromSolid * tile.plane.normal;
    const double offset = (tile.plane.offset - glm::dot(tile.plane.normal, centre)) / radius +
                          glm::dot(normal, glm::dvec3(centreInView.x, centreInView.y, 0.0));
    program.set("cutPlane", glm::vec4(glm::dvec4(normal, offset)));
}

const gpu::Texture* SolidsOverlay::draw(SharedStages& stages, const DrawRequest& request) {
    const auto& [tile, volumes, frame, target, rows] = request;
    if (!showsSolids(tile, *volumes.volume.meta)) return nullptr;
    const Solids& solids = solidsOf(request);
    if (solids.count == 0) return nullptr;
    prepareTextures(tile.sizePixels);
    const gpu::Framebuffer framebuffer(context_, *colours_, &*depth_);
    const auto [firstRow, endRow] = rows.within(tile.sizePixels);
    framebuffer.bindRows(firstRow, endRow);
    const glm::vec4 nothing(0.0F, 0.0F, 0.0F, kNoSolid);
    const float farthest = 1.0F;
    glClearBufferfv(GL_COLOR, 0, &nothing.x);
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    const auto& program =
        stages.programs.graphics("techniques/overlay/solid_vertex.glsl",
                                 "techniques/overlay/solid_fragment.glsl", definesOf(stages, request));
    bind(program, request);
    solids.buffer->bindStorage(0);
    program.use();
    layout_->bind();
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, solids.count);
    glDisable(GL_DEPTH_TEST);
    gpu::Framebuffer::unbind();
    glFlush();
    context_.settleRaster();
    return &*colours_;
}

void SolidsOverlay::drawUnder(SharedStages& stages, const DrawRequest& request) {
    const auto& [tile, volumes, frame, target, rows] = request;
    const auto& program = stages.programs.graphics("techniques/overlay/picture_vertex.glsl",
                                                   "techniques/overlay/under_fragment.glsl", {});
    colours_->bind(solidsUnit);
    const gpu::Framebuffer framebuffer(context_, *target);
    const auto [firstRow, endRow] = rows.within(tile.sizePixels);
    framebuffer.bindRows(firstRow, endRow);
    program.use();
    layout_->bind();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_BLEND);
    gpu::Framebuffer::unbind();
    context_.settleRaster(); // the next band is written by compute
}

} // namespace voxsheet
