// Brings one volume from its provider into a 3D texture, some slices at a time. Private to this room.
#pragma once

#include "gpu/context.h"
#include "residency/resident_volume.h"
#include "volume/texture_encoding.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxsheet {

using Deadline = std::chrono::steady_clock::time_point;

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
    /// Reads, converts and uploads chunks of slices, and reads the min-max grid at last: at least one chunk,
    /// then as many as begin before the deadline. True when all is done.
    [[nodiscard]] bool advance(gpu::Texture& texture, Deadline deadline);

    [[nodiscard]] const ResidentVolume& volume() const { return volume_; } ///< without its texture
    [[nodiscard]] std::uint64_t remainingBytes() const;                    ///< of texels
    [[nodiscard]] double uploadMs() const { return uploadMs_; }
    [[nodiscard]] double readMs() const { return readMs_; }

private:
    [[nodiscard]] int slicesPerChunk() const;
    void uploadChunk(gpu::Texture& texture);

    const VolumeProvider& provider_;
    VolumeKey key_;
    ScalarType type_;
    TextureEncoding encoding_;
    ResidentVolume volume_;
    int nextSlice_ = 0;
    std::vector<std::byte> stored_; ///< staging, from the first chunk on
    std::vector<std::byte> texels_;
    double uploadMs_ = 0.0;
    double readMs_ = 0.0;
};

} // namespace voxsheet
