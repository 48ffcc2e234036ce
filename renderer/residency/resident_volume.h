// A volume that is a texture on the GPU, and the lease that keeps it there.
#pragma once

#include "gpu/texture.h"
#include "volume/host_texels.h"
#include "volume/volume_provider.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>

namespace voxsheet {

/// A volume that can be drawn. Texel centres: texture coordinate (i + 1/2) / dims; linear filter; REPEAT on
/// periodic axes, else CLAMP_TO_EDGE (set on the texture itself).
struct ResidentVolume {
    const gpu::Texture* texture = nullptr; ///< GL_TEXTURE_3D, one channel, normalised or float; or null
    double valueScale = 1.0; ///< value = valueScale * texel + valueOffset, slope and intercept included
    double valueOffset = 0.0;
    std::shared_ptr<const HostTexels> host;   ///< instead, for rays that the processor marches
    std::shared_ptr<const MinMaxGrid> minMax; ///< in values
    /// contentHash of minMax: what was derived from it is still good when the volume comes back after an
    /// eviction.
    std::uint64_t rangesHash = 0;
    std::shared_ptr<const DatasetMeta> meta;
    int field = 0;
    int step = 0;
    int level = 0;
    glm::ivec3 dims{0}; ///< levelDims(meta->grid.dims, level) = texture->size()
};

struct TextureEntry;

/// A resident volume that is not evicted while the lease lives. Ends before its ResidencyManager.
class VolumeLease {
public:
    VolumeLease(const VolumeLease&) = delete;
    VolumeLease& operator=(const VolumeLease&) = delete;
    VolumeLease(VolumeLease&& other) noexcept;
    VolumeLease& operator=(VolumeLease&& other) noexcept;
    ~VolumeLease();

    [[nodiscard]] const ResidentVolume& volume() const;
    /// What it took to bring the texture in, told to the first lease afterwards and 0 to all others.
    double uploadMs = 0.0; ///< host time of conversion and upload, or of building gradients
    double readMs = 0.0;   ///< of waiting for samples to be read

private:
    friend class ResidencyManager;
    explicit VolumeLease(std::shared_ptr<TextureEntry> entry);
    std::shared_ptr<TextureEntry> entry_;
};

} // namespace voxsheet
