// Analytic clip shapes beside the volumes of another provider.
#pragma once

#include "volume/clip_shapes.h"
#include "volume/memory_volume_provider.h"

#include <array>
#include <memory>
#include <mutex>

namespace voxsheet {

/// Answers the keys of clip shapes itself and hands every other key on. A shape is sampled when it is first
/// asked for, and kept (2.4 MB each with its levels). Thread-safe, if the other provider is.
class ClipShapeProvider : public VolumeProvider {
public:
    /// \param others  not null
    explicit ClipShapeProvider(std::shared_ptr<const VolumeProvider> others) : others_(std::move(others)) {}

    [[nodiscard]] std::shared_ptr<const DatasetMeta> describe(const std::string& dataset) const override;
    void readSlices(const VolumeKey& key, int zBegin, int zCount, std::span<std::byte> out) const override;
    [[nodiscard]] MinMaxGrid readMinMax(const VolumeKey& key) const override;
    void dropPages(const VolumeKey& key, int zBegin, int zCount) const override;
    [[nodiscard]] bool isAtHand(const VolumeKey& key) const override;
    void readAhead(const VolumeKey& key, int zBegin, int zCount,
                   std::optional<FloatTexels> forRays) const override;
    void setAwaited(const std::vector<VolumeKey>& levels) const override;
    void endAwaited(const VolumeKey& level) const override;
    void readSlicesOnce(const VolumeKey& key, int zBegin, int zCount,
                        std::span<std::byte> out) const override;
    void keepLevel(const VolumeKey& key, const HostLevel& level) const override;
    [[nodiscard]] std::optional<HostLevel> takeLevel(const VolumeKey& key, TexelFormat format) const override;
    [[nodiscard]] std::optional<UnfinishedLevel> takeUnfinished(const VolumeKey& key,
                                                                TexelFormat format) const override;

private:
    /// The provider that has the dataset; a clip shape has been sampled when this returns.
    [[nodiscard]] const VolumeProvider& providerOf(const std::string& dataset) const;

    std::shared_ptr<const VolumeProvider> others_;
    mutable MemoryVolumeProvider shapes_;
    mutable std::array<std::once_flag, 5> sampled_; ///< by ClipShape
};

} // namespace voxsheet
