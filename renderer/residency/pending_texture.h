// A texture that is being brought in: waiting, or partly filled. Private to this room.
#pragma once

#include "residency/residency_manager.h"
#include "residency/texture_table.h"
#include "residency/volume_upload.h"

#include <memory>
#include <optional>

namespace voxsheet {

class PendingTexture {
public:
    /// Samples, from the provider. Throws NotFound for a volume that is not there.
    PendingTexture(const VolumeProvider& provider, const TextureKey& key, bool exactR8Filtering,
                   FloatTexels floatTexels, bool clipObject);
    /// Gradients of `source`, which need not be resident yet.
    PendingTexture(const TextureKey& key, std::shared_ptr<const DatasetMeta> meta,
                   DerivedTextureBuilder build);

    [[nodiscard]] const TextureKey& key() const { return key_; }
    [[nodiscard]] bool clipObject() const { return clipObject_; }
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; } ///< of the whole texture
    [[nodiscard]] std::uint64_t remainingBytes() const;
    [[nodiscard]] bool exceedsDevice(const gpu::Context& context) const;

    [[nodiscard]] bool begun() const { return begun_; } ///< its texture takes bytes() by now
    /// Before begin(), as VolumeUpload's.
    void takeKept() {
        if (upload_) upload_->takeKept();
    }
    [[nodiscard]] bool isKept() const { return upload_ && upload_->isKept(); }
    /// Throws LimitExceeded when the device has no room.
    void begin(gpu::Context& context);
    /// Samples: as VolumeUpload::advance. Gradients: at least one step, then as many as begin before the
    /// deadline. True when the texture is whole.
    /// \param source  of gradients: the resident samples
    [[nodiscard]] bool advance(Deadline deadline, SliceReader& reader, const ResidentVolume* source);
    [[nodiscard]] std::shared_ptr<TextureEntry> finish();

    WantedPriority priority = WantedPriority::Visible;
    std::uint64_t sequence = 0; ///< of those of one priority, the lowest goes first
    std::uint64_t asked = 0;    ///< counts up when a tile asks for it again

private:
    TextureKey key_;
    bool clipObject_ = false;
    std::uint64_t bytes_ = 0;
    std::optional<VolumeUpload> upload_; ///< of samples
    std::shared_ptr<const DatasetMeta> meta_;
    DerivedTextureBuilder build_;
    glm::ivec3 dims_{0};
    int nextSlice_ = 0; ///< of gradients
    double buildMs_ = 0.0;
    ResidentVolume source_;
    bool begun_ = false;
    std::optional<gpu::Texture> texture_; ///< none where texels stay on the host
};

} // namespace voxsheet
