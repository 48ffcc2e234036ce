#include "frame/target_pool.h"

#include <algorithm>

namespace voxsheet {

namespace {

/// What unused sizes may hold on to, beside the target in use.
constexpr std::size_t kSpareBytes = std::size_t{64} << 20;

} // namespace

const gpu::Texture& TargetPool::acquire(glm::ivec2 sizePixels) {
    const glm::ivec3 size(sizePixels, 1);
    const auto known = std::find_if(targets_.begin(), targets_.end(),
                                    [&](const gpu::Texture& target) { return target.size() == size; });
    if (known != targets_.end()) {
        targets_.splice(targets_.begin(), targets_, known);
    } else {
        targets_.emplace_front(context_, GL_TEXTURE_2D, GL_RGBA32F, size);
    }
    std::size_t spareBytes = 0;
    for (auto target = std::next(targets_.begin()); target != targets_.end();) {
        spareBytes += target->bytes();
        target = spareBytes > kSpareBytes ? targets_.erase(target) : std::next(target);
    }
    return targets_.front();
}

} // namespace voxsheet
