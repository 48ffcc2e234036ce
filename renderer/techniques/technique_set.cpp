#include "techniques/technique_set.h"

#include "base/errors.h"
#include "gpu/context.h"
#include "stages/shared_stages.h"
#include "techniques/isosurface/isosurface.h"
#include "techniques/mip/mip.h"
#include "techniques/overlay/solids_overlay.h"
#include "techniques/plane/plane.h"
#include "techniques/raycast/raycast.h"
#include "techniques/slicing/slicing.h"
#include "techniques/surface/surface.h"
#include "techniques/tile_acquisition.h"

#if VOXSHEET_SIMD
#include "techniques/simd_rays.h"
#endif

#include <cmath>
#include <optional>

namespace voxsheet {
namespace {

constexpr int kMaxPixels = 8192;
constexpr double kMaxSampleDistance = 64.0;

bool isPositive(double value) { return value > 0.0 && std::isfinite(value); }

bool isFinite(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row])) return false;
    return true;
}

void validateCamera(const CameraSpec& camera) {
    if (!isFinite(camera.viewFromWorld) || std::abs(glm::determinant(camera.viewFromWorld)) < 1e-12)
        throw InvalidInput("camera", "its matrix is not finite and invertible").withField("camera.target");
    const bool perspective = camera.projection == Projection::Perspective;
    if (perspective && !(camera.fovYDegrees > 0.0 && camera.fovYDegrees < 180.0))
        throw InvalidInput("field of view", "it is outside (0, 180) degrees").withField("camera.fov");
    if (!perspective && !isPositive(camera.heightWorld))
        throw InvalidInput("height of the orthographic picture", "it is not above 0")
            .withField("camera.distance");
}

void validate(const TileSpec& tile) {
    const auto size = tile.sizePixels;
    if (size.x < 1 || size.y < 1 || size.x > kMaxPixels || size.y > kMaxPixels)
        throw InvalidInput("picture size", "it is outside 1 to 8192 pixels").withField("width");
    if (!tile.transfer || tile.transfer->entries.size() < 2)
        throw InvalidInput("transfer function", "the tile has none").withField("transfer.map");
    if (!isPositive(tile.unitLengthWorld))
        throw InvalidInput("unit length of opacity", "it is not above 0").withField("transfer.unitLength");
    if (!isPositive(tile.sampleDistanceVoxels) || tile.sampleDistanceVoxels > kMaxSampleDistance)
        throw InvalidInput("sample distance", "it is outside (0, 64] voxels").withField("sampling.distance");
    validateCamera(tile.camera);
    validateClip(tile.clip);
    validateShading(tile.shading);
    validateIsosurface(tile.isosurface);
    validateLayers(tile);
    validatePlane(tile.plane);
    validateCrystal(tile.crystal);
}

void validateTarget(const TileSpec& tile, const gpu::Texture& target) {
    const auto size = tile.sizePixels;
    if (target.target() != GL_TEXTURE_2D || target.internalFormat() != GL_RGBA32F ||
        target.size() != glm::ivec3(size, 1))
        throw InternalError("target of a tile", "it is not a 2D RGBA32F texture of the tile's size");
}

} // namespace

class TechniqueSet::Implementation {
public:
    explicit Implementation(gpu::Context& context)
        : stages(context), slicing(context), surface(context), solids(context),
          paths(pathsByRule(context.workarounds())) {}

    SharedStages stages;
    SlicingTechnique slicing;
    SurfaceTechnique surface;
    SolidsOverlay solids;
    RenderPaths paths;

    void draw(const DrawRequest& request) {
#if VOXSHEET_SIMD
        if (request.volumes.volume.host) return simdRays.draw(stages, request);
#endif
        drawByShaders(request);
    }

    void drawByShaders(const DrawRequest& request) {
        switch (request.tile.technique) {
        case Technique::Raycast:
            return drawRaycast(stages, request);
        case Technique::Mip:
            return drawMip(stages, request);
        case Technique::Slices:
            return slicing.draw(stages, request);
        case Technique::Surface:
            return surface.draw(stages, request);
        case Technique::Isosurface:
            return drawIsosurface(stages, request);
        case Technique::Plane:
            return drawPlane(stages, request);
        }
    }

#if VOXSHEET_SIMD
    SimdRays simdRays;
#endif

    [[nodiscard]] DerivedTextureBuilder gradientBuilder() {
        return [this](const ResidentVolume& volume, gpu::Texture& texture, int zBegin, int zCount) {
            ShadingStage::buildGradients(stages.programs, volume, texture, zBegin, zCount);
        };
    }
};

TechniqueSet::TechniqueSet(gpu::Context& context)
    : implementation_(std::make_unique<Implementation>(context)) {}

TechniqueSet::~TechniqueSet() = default;

namespace {

const ResidentVolume* volumeOf(const std::optional<VolumeLease>& lease) {
    return lease ? &lease->volume() : nullptr;
}

/// Checks the tile and calls draw(volumes, request).
template <typename Draw>
void withRequest(const TileSpec& tile, const TileVolumes& tileVolumes, const gpu::Texture* target,
                 const PictureRows& rows, Draw draw) {
    validate(tile);
    DrawVolumes volumes{tileVolumes.volume.volume(), volumeOf(tileVolumes.gradients),
                        volumeOf(tileVolumes.clipObject), volumeOf(tileVolumes.colours)};
    for (const auto& layer : tileVolumes.layers)
        volumes.layers.push_back(&layer.volume());
    validatePeriodicWindow(tile.periodic, volumes.volume.meta->grid);
    const auto frame = makeRayFrame(tile.camera, tile.sizePixels, volumes.volume.meta->grid, tile.periodic);
    draw(volumes, DrawRequest{tile, volumes, frame, target, rows});
}

} // namespace

TileVolumes TechniqueSet::acquire(ResidencyManager& residency, const TileSpec& tile) {
    return *acquireBy(residency, tile, askedLevels(tile), Deadline::max());
}

std::optional<TileVolumes> TechniqueSet::acquireBy(ResidencyManager& residency, const TileSpec& tile,
                                                   const TileLevels& levels, Deadline deadline) {
    validate(tile);
    return acquireTileBy(residency, tile, implementation_->paths, levels, deadline,
                         implementation_->gradientBuilder());
}

std::optional<TileVolumes> TechniqueSet::acquireAtHand(ResidencyManager& residency, const TileSpec& tile,
                                                       const TileLevels& levels, Deadline deadline) {
    validate(tile);
    return acquireTileAtHand(residency, tile, implementation_->paths, levels, deadline,
                             implementation_->gradientBuilder());
}

void TechniqueSet::draw(const TileSpec& tile, const TileVolumes& tileVolumes,
                        const gpu::Texture& targetRgba32f, const PictureRows& rows) {
    validateTarget(tile, targetRgba32f);
    auto& stages = implementation_->stages;
    withRequest(tile, tileVolumes, &targetRgba32f, rows,
                [&](DrawVolumes& volumes, const DrawRequest& request) {
                    volumes.solids = implementation_->solids.draw(stages, request);
                    implementation_->draw(request);
                    if (volumes.solids != nullptr) implementation_->solids.drawUnder(stages, request);
                });
    stages.context.checkErrors("drawing a tile");
}

bool TechniqueSet::drawsOnHost([[maybe_unused]] const TileSpec& tile,
                               [[maybe_unused]] const TileVolumes& volumes) const {
#if VOXSHEET_SIMD
    const ResidentVolume& volume = volumes.volume.volume();
    return volume.host && !showsSolids(tile, *volume.meta);
#else
    return false;
#endif
}

void TechniqueSet::drawOnHost(const TileSpec& tile, const TileVolumes& tileVolumes,
                              [[maybe_unused]] std::vector<float>& rgba, const PictureRows& rows) {
    if (!drawsOnHost(tile, tileVolumes))
        throw InternalError("a picture of the host", "its technique needs the GL");
    withRequest(tile, tileVolumes, nullptr, rows,
                [&](DrawVolumes& /*volumes*/, [[maybe_unused]] const DrawRequest& request) {
#if VOXSHEET_SIMD
                    implementation_->simdRays.drawOnHost(implementation_->stages, request, rgba);
#endif
                });
}

void TechniqueSet::setPaths(const RenderPaths& paths) { implementation_->paths = paths; }
const RenderPaths& TechniqueSet::paths() const { return implementation_->paths; }

void TechniqueSet::setTextureBudget(std::uint64_t bytes) {
    implementation_->stages.emptySpace.keepAtMost(markBytesFor(bytes));
}

void TechniqueSet::setEmptySpaceSkipping(bool enabled) { implementation_->stages.skipEmptySpace = enabled; }
void TechniqueSet::setShaderFiltering(bool enabled) {
    implementation_->stages.filterFloatsInShader = enabled;
}

void TechniqueSet::setRootInterpolation(bool enabled) {
    implementation_->stages.interpolateRootsInShader = enabled;
}

void TechniqueSet::setCoarseFiltering(bool enabled) { implementation_->stages.filterCoarsely = enabled; }

} // namespace voxsheet
