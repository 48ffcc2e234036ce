// Draws tiles straight through the techniques, without the render thread: context, residency and TechniqueSet
// in one.
#pragma once

#include "fields/picture.h"
#include "gpu/context.h"
#include "residency/residency_manager.h"
#include "techniques/technique_set.h"
#include "volume/clip_shape_provider.h"
#include "volume/memory_volume_provider.h"

#include <memory>
#include <string>

namespace voxsheet::image {

class TilePainter {
public:
    /// Throws GpuError without a usable EGL.
    TilePainter();
    /// Draws the volumes of another painter.
    explicit TilePainter(std::shared_ptr<MemoryVolumeProvider> volumes);
    ~TilePainter();
    TilePainter(const TilePainter&) = delete;
    TilePainter& operator=(const TilePainter&) = delete;

    [[nodiscard]] const std::shared_ptr<MemoryVolumeProvider>& sharedVolumes() const { return volumes_; }
    /// To add volumes to.
    [[nodiscard]] MemoryVolumeProvider& volumes() { return *volumes_; }
    /// All that tiles can name: the volumes added and the clip shapes.
    [[nodiscard]] const VolumeProvider& provider() const { return *withShapes_; }
    [[nodiscard]] gpu::Context& context() { return context_; }
    [[nodiscard]] TechniqueSet& techniques() { return techniques_; }
    [[nodiscard]] ResidencyManager& residency() { return residency_; }

    /// Mesa's software renderers filter in 32-bit floats and round alike in every program. GPUs weigh samples
    /// in steps of 1/256 voxel, and what one program fuses another may not.
    [[nodiscard]] bool filtersExactly() const { return context_.device().software; }

    /// The picture of tile.dataset, field, step and level.
    [[nodiscard]] fields::Picture draw(const TileSpec& tile);
    /// Milliseconds of the last draw(), from its start to the pixels on the host; uploads not included.
    [[nodiscard]] double lastMs() const { return lastMs_; }

private:
    gpu::Context context_;
    std::shared_ptr<MemoryVolumeProvider> volumes_;
    std::shared_ptr<const ClipShapeProvider> withShapes_;
    ResidencyManager residency_;
    TechniqueSet techniques_;
    double lastMs_ = 0.0;
};

} // namespace voxsheet::image
