// Brings one volume from its provider into a 3D texture, or into host memory for rays that the processor
// marches, some slices at a time. Private to this room.
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
#include <memory>
#include <optional>
#include <vector>

namespace voxsheet {

using Deadline = std::chrono::steady_clock::time_point;

/// Linear filter; REPEAT on periodic axes, else CLAMP_TO_EDGE.
void setVolumeSampling(gpu::Texture& texture, const Grid& grid);

class VolumeUpload {
public:
    /// Looks the volume up and plans its texture; reads no samples yet. Throws NotFound for an unknown key.
    /// \param exactR8Filtering  chooseTextureEncoding
    VolumeUpload(const VolumeProvider& provider, VolumeKey key, bool exactR8Filtering,
                 FloatTexels floatTexels, bool onHost);

    [[nodiscard]] std::uint64_t bytes() const; ///< of the texture, or of the texels in host memory
    [[nodiscard]] bool
    exceedsDevice(const gpu::Context& context) const; ///< more texels on an axis than it takes
    /// Before begin(): takes over what the provider keeps of the level for rays.
    void takeKept();
    [[nodiscard]] bool isKept() const { return kept_; } ///< all of it: it is done
    /// Throws LimitExceeded when there is no room. Nothing where the texels stay on the host.
    [[nodiscard]] std::optional<gpu::Texture> begin(gpu::Context& context);
    /// Converts and uploads chunks of slices as the reader brings them, and takes the min-max grid at last;
    /// up to the deadline it waits for the reader. At least one chunk if one has been read, then as many as
    /// begin before the deadline. True when all is done. Throws what reading threw.
    [[nodiscard]] bool advance(std::optional<gpu::Texture>& texture, SliceReader& reader, Deadline deadline);

    [[nodiscard]] const ResidentVolume& volume() const { return volume_; } ///< without its texture
    [[nodiscard]] std::uint64_t remainingBytes() const;                    ///< of texels
    [[nodiscard]] double uploadMs() const { return uploadMs_; }
    [[nodiscard]] double readMs() const { return readMs_; } ///< spent in waiting for the reader

private:
    [[nodiscard]] bool takeLevel();
    [[nodiscard]] int slicesPerChunk() const;
    [[nodiscard]] int slicesOfChunk(int zBegin) const;
    void askAhead(SliceReader& reader);
    void uploadChunk(std::optional<gpu::Texture>& texture, const std::vector<std::byte>& stored);

    const VolumeProvider& provider_;
    VolumeKey key_;
    ScalarType type_;
    TextureEncoding encoding_;
    bool onHost_;
    bool kept_ = false; ///< takeKept()
    std::shared_ptr<HostTexels> host_;
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
