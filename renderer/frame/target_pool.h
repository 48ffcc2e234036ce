// Render targets kept between tiles: making one costs more than drawing a small tile.
#pragma once

#include "gpu/texture.h"

#include <cstdint>
#include <list>

namespace voxsheet {

class TargetPool {
public:
    explicit TargetPool(gpu::Context& context) : context_(context) {}

    /// A 2D RGBA32F texture of this size, contents undefined; valid until the next call. GL keeps the
    /// commands of two users in order, so one target per size is enough.
    [[nodiscard]] const gpu::Texture& acquire(glm::ivec2 sizePixels);

private:
    gpu::Context& context_;
    std::list<gpu::Texture> targets_; ///< most recently used first
};

} // namespace voxsheet
