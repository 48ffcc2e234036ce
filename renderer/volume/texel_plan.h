// How a level's samples become texels: what follows from its description alone.
#pragma once

#include "volume/texture_encoding.h"
#include "volume/volume_provider.h"

#include <glm/glm.hpp>

#include <memory>

namespace voxsheet {

struct TexelPlan {
    std::shared_ptr<const DatasetMeta> meta;
    ScalarType type = ScalarType::U8; ///< of the level's samples
    glm::ivec3 dims{0};               ///< of the level
    TextureEncoding encoding;
    double valueScale = 1.0; ///< value = valueScale * texel + valueOffset
    double valueOffset = 0.0;
};

/// Throws NotFound for an unknown key.
/// \param exactR8Filtering  chooseTextureEncoding; rays that the processor marches filter exactly
[[nodiscard]] TexelPlan planTexels(const VolumeProvider& provider, const VolumeKey& key,
                                   bool exactR8Filtering, FloatTexels floatTexels);

} // namespace voxsheet
