// Brings one volume from its provider into a 3D texture, some slices at a time. Private to this room.
#pragma once

#include "gpu/context.h"
#include "residency/resident_volume.h"
#include "residency/slice_reader.h"
#include "volume/texture_encoding.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <future>
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
    /// Converts and uploads chunks of slices as the reader brings them, and takes the min-max grid at last;
    /// up to the deadline it waits for the reader. At least one chunk if one has been read, then as many as
    /// begin before the deadline. True when all is done. Throws what reading threw.
    [[nodiscard]] bool advance(gpu::Texture& texture, SliceReader& reader, Deadline deadline);

    [[nodiscard]] const ResidentVolume& volume() const { return volume_; } ///< without its texture
    [[nodiscard]] std::uint64_t remainingBytes() const;                    ///< of texels
    [[nodiscard]] double uploadMs() const { return uploadMs_; }
    [[nodiscard]] double readMs() const { return readMs_; } ///< spent in waiting for the reader

private:
    [[nodiscard]] int slicesPerChunk() const;
    [[nodiscard]] int slicesOfChunk(int zBegin) const;
    void askAhead(SliceReader& reader);
    void uploadChunk(gpu::Texture& texture, const std::vector<std::byte>& stored);

    const VolumeProvider& provider_;
    VolumeKey key_;
    ScalarType type_;
    TextureEncoding encoding_;
    ResidentVolume volume_;
    int nextSlice_ = 0;
    int nextAsked_ = 0;                                     ///< slice
    std::deque<std::future<std::vector<std::byte>>> reads_; ///< from nextSlice_ on, a chunk each
    std::future<MinMaxGrid> minMax_;
    std::vector<std::byte> spare_;  ///< a buffer to read into
    std::vector<std::byte> texels_; ///< staging, from the first chunk on
    double uploadMs_ = 0.0;
    double readMs_ = 0.0;
};

} // namespace voxsheet
