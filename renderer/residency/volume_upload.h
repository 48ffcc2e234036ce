// Brings one volume from its provider into a 3D texture. Private to this room.
#pragma once

#include "residency/residency_manager.h"
#include "volume/texture_encoding.h"

namespace voxsheet {

/// Linear filter; REPEAT on periodic axes, else CLAMP_TO_EDGE.
void setVolumeSampling(gpu::Texture& texture, const Grid& grid);

class VolumeUpload {
public:
    /// Looks the volume up and plans its texture; reads no samples yet. Throws NotFound for an unknown key.
    VolumeUpload(const VolumeProvider& provider, VolumeKey key, bool exactR8Filtering,
                 FloatTexels floatTexels);

    [[nodiscard]] std::uint64_t bytes() const; ///< of the texture
    [[nodiscard]] bool
    exceedsDevice(const gpu::Context& context) const; ///< more texels on an axis than it takes
    [[nodiscard]] gpu::Texture createTexture(gpu::Context& context) const;
    /// Reads, converts and uploads slice by slice, and reads the min-max grid.
    void fill(gpu::Texture& texture);

    [[nodiscard]] const ResidentVolume& volume() const { return volume_; } ///< without its texture
    [[nodiscard]] double uploadMs() const { return uploadMs_; }
    [[nodiscard]] double readMs() const { return readMs_; }

private:
    [[nodiscard]] int slicesPerChunk() const;

    const VolumeProvider& provider_;
    VolumeKey key_;
    ScalarType type_;
    TextureEncoding encoding_;
    ResidentVolume volume_;
    double uploadMs_ = 0.0;
    double readMs_ = 0.0;
};

} // namespace voxsheet
