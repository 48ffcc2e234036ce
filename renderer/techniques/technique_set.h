// The one door into the techniques: draws one cell's picture into a texture.
#pragma once

#include "residency/residency_manager.h"
#include "stages/picture_rows.h"
#include "stages/tile_spec.h"
#include "techniques/render_paths.h"
#include "techniques/tile_volumes.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace voxsheet {

namespace gpu {
class Context;
class Texture;
} // namespace gpu

/// Owns the programs, tables and occupancy masks that the techniques share. Belongs to the thread that owns
/// the GL context; the context must outlive it. Programs are compiled when a technique is first used.
class TechniqueSet {
public:
    explicit TechniqueSet(gpu::Context& context);
    ~TechniqueSet();
    TechniqueSet(const TechniqueSet&) = delete;
    TechniqueSet& operator=(const TechniqueSet&) = delete;

    /// Makes resident what the tile is drawn from; gradient textures are built here. Throws InvalidInput
    /// (with field) if the tile's numbers are out of the ranges documented in TileSpec and its parts, and as
    /// ResidencyManager::acquire.
    [[nodiscard]] TileVolumes acquire(ResidencyManager& residency, const TileSpec& tile);
    /// As acquire, at these levels; stops at the deadline: empty as long as it must be called again.
    [[nodiscard]] std::optional<TileVolumes> acquireBy(ResidencyManager& residency, const TileSpec& tile,
                                                       const TileLevels& levels, Deadline deadline);
    /// What comes nearest to these levels and is resident (of a volume of which nothing is, a small level is
    /// brought in before the deadline: empty when that came first); what is missing is queued for
    /// ResidencyManager::advance. Throws as acquire.
    [[nodiscard]] std::optional<TileVolumes> acquireAtHand(ResidencyManager& residency, const TileSpec& tile,
                                                           const TileLevels& levels, Deadline deadline);

    /// Draws `tile` from `volumes` into `targetRgba32f`: a 2D RGBA32F texture of tile.sizePixels texels, row
    /// 0 at the bottom of the picture. Every texel of the rows is written and no other, with the bits that a
    /// draw of the whole picture gives it: colour premultiplied by alpha, no background.
    /// The volume's level is drawn, whatever tile.level says. The call returns when the commands are queued
    /// (llvmpipe: when compute work is done). Throws InvalidInput (with field) if the tile's numbers are out
    /// of the ranges documented in TileSpec, GpuError if a program or a texture fails.
    void draw(const TileSpec& tile, const TileVolumes& volumes, const gpu::Texture& targetRgba32f,
              const PictureRows& rows = {});

    /// Whether the picture can be drawn without the GL: drawOnHost.
    [[nodiscard]] bool drawsOnHost(const TileSpec& tile, const TileVolumes& volumes) const;
    /// As draw, into host memory: rgba of the whole picture, row 0 at the bottom; resized as needed. Only
    /// where drawsOnHost(tile, volumes).
    void drawOnHost(const TileSpec& tile, const TileVolumes& volumes, std::vector<float>& rgba,
                    const PictureRows& rows = {});

    /// What acquire brings in decides by which path draw draws; by the rule until set.
    void setPaths(const RenderPaths& paths);
    [[nodiscard]] const RenderPaths& paths() const;

    /// What is made from the volumes is kept as far as it is worth it beside textures of this budget
    /// (markBytesFor); the most until set.
    void setTextureBudget(std::uint64_t bytes);

    /// Empty-space skipping can be switched off to show that it changes no pixel; on by default.
    void setEmptySpaceSkipping(bool enabled);
    /// 32-bit float volumes are interpolated by the shader itself, for drivers that do not filter them; off
    /// by default.
    void setShaderFiltering(bool enabled);
    /// Isosurfaces refine their crossings by interpolation of their own; by default only where the workaround
    /// "coarse-filter-weights" is in force.
    void setRootInterpolation(bool enabled);
    /// Shaders weigh a volume's samples in steps of 1/256 voxel, as GPUs do, for trials on devices that weigh
    /// them exactly; off by default. Kernels (simd/kernels.h) do not know it.
    void setCoarseFiltering(bool enabled);

private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace voxsheet
