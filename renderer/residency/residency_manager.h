// Which volumes and gradients are 3D textures on the GPU: one texture per VolumeKey and kind however many
// cells show it, within a byte budget. What is least wanted goes first, and of that the least recently used.
// Textures can be brought in some slices at a time, so that no frame waits for a whole one; a thread of their
// own reads them, so that none waits for a disk.
#pragma once

#include "gpu/workarounds.h"
#include "residency/residency_state.h"
#include "residency/resident_volume.h"
#include "residency/wanted_volume.h"
#include "volume/texture_encoding.h"
#include "volume/volume_provider.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace voxsheet {

class PendingTexture;
class SliceReader;
class TextureTable;
struct TextureKey;
enum class TextureKind;

using Deadline = std::chrono::steady_clock::time_point;

/// Fills slices [zBegin, zBegin + zCount) of the RGBA16F texture of a volume's size with what is derived from
/// the volume's own.
using DerivedTextureBuilder =
    std::function<void(const ResidentVolume& volume, gpu::Texture& rgba16f, int zBegin, int zCount)>;

/// What a texture of samples is used for; decides only under which name its bytes are counted.
enum class SamplesUse { Drawing, Clipping };

/// Belongs to the thread of its Context.
class ResidencyManager {
public:
    ResidencyManager(gpu::Context& context, std::shared_ptr<const VolumeProvider> provider,
                     std::uint64_t budgetBytes);
    ~ResidencyManager();
    ResidencyManager(const ResidencyManager&) = delete;
    ResidencyManager& operator=(const ResidencyManager&) = delete;

    // --- at any price: evicts whatever has no lease, the least wanted first ---
    /// Throws what the provider throws; NotFound for a field, step or level that the dataset does not have;
    /// LimitExceeded when the volume alone, or with the leased ones, breaks the budget or the device's
    /// limits.
    [[nodiscard]] VolumeLease acquire(const VolumeKey& key, TexelForm form = {},
                                      SamplesUse use = SamplesUse::Drawing);
    /// The gradient texture of a volume: the lease's volume() is as acquire() gives it but for `texture`.
    /// Built by `build` when it is not resident; the volume itself is then made resident too. Throws as
    /// acquire.
    [[nodiscard]] VolumeLease acquireGradients(const VolumeKey& key, TexelForm form,
                                               const DerivedTextureBuilder& build);
    /// As acquire and acquireGradients, but stops at the deadline, waiting for a disk or not: empty as long
    /// as it must be called again. Throws, once, what bringing it in met in the background meanwhile.
    [[nodiscard]] std::optional<VolumeLease> acquireBy(Deadline deadline, const VolumeKey& key,
                                                       TexelForm form = {},
                                                       SamplesUse use = SamplesUse::Drawing);
    [[nodiscard]] std::optional<VolumeLease> acquireGradientsBy(Deadline deadline, const VolumeKey& key,
                                                                TexelForm form,
                                                                const DerivedTextureBuilder& build);

    // --- only if it is there ---
    [[nodiscard]] std::optional<VolumeLease> acquireResident(const VolumeKey& key, TexelForm form = {},
                                                             SamplesUse use = SamplesUse::Drawing);
    [[nodiscard]] std::optional<VolumeLease> acquireResidentGradients(const VolumeKey& key, TexelForm form);
    [[nodiscard]] bool isResident(const VolumeKey& key, TexelForm form = {}) const;
    [[nodiscard]] bool areGradientsResident(const VolumeKey& key, TexelForm form) const;
    /// The resident level of the volume that is nearest to key.level; of two, the finer one.
    [[nodiscard]] std::optional<int> nearestResidentLevel(const VolumeKey& key, TexelForm form) const;

    // --- in the background: evicts only what is less wanted ---
    /// Replaces what is wanted; volumes of it that are not resident are queued, the visible ones first.
    /// Uploads that were asked for before and are not wanted any more are given up. Names that the provider
    /// does not know are left out.
    void setWanted(const std::vector<WantedVolume>& wanted);
    /// Queues an upload as wanted as what is visible. False when there is no room for it beside what is
    /// visible, or it was tried and failed: asking again is of no use until something changes. Throws
    /// NotFound as acquire.
    bool request(const VolumeKey& key, TexelForm form = {}, SamplesUse use = SamplesUse::Drawing);
    /// Likewise; waits in the queue for the volume's own samples, which are queued too.
    bool requestGradients(const VolumeKey& key, TexelForm form, const DerivedTextureBuilder& build);
    /// Works on the queue until the deadline, waiting for a disk if it has to. False when nothing is left to
    /// do. An upload that fails, or finds no room, leaves the queue; its error is kept for who acquires it
    /// next, until other volumes are wanted.
    bool advance(Deadline deadline);
    [[nodiscard]] bool isIdle() const { return queue_.empty(); }

    // --- before it is asked for ---
    /// Whether its samples can be had without waiting for a disk. Throws NotFound.
    [[nodiscard]] bool isAtHand(const VolumeKey& key) const;
    /// Reads samples into host memory, when nothing else is read. Replaces what was asked for before.
    void readAhead(const std::vector<WantedVolume>& volumes);
    /// Volumes that are about to be brought in: what host memory keeps of others goes first. Replaces those
    /// named before.
    void setAwaited(const std::vector<WantedVolume>& volumes);

    // --- what it would take ---
    /// Bytes of the texture. Throws NotFound as acquire.
    [[nodiscard]] std::uint64_t bytesOf(const VolumeKey& key, TexelForm form) const;
    [[nodiscard]] std::uint64_t gradientBytesOf(const VolumeKey& key) const;
    [[nodiscard]] std::uint64_t budgetBytes() const { return budgetBytes_; }
    [[nodiscard]] std::shared_ptr<const DatasetMeta> describe(const std::string& dataset) const;

    /// Drops every texture of a dataset. One under lease is freed when its lease ends, and is not handed out
    /// again.
    void forget(const std::string& dataset);

    [[nodiscard]] const gpu::Workarounds& workarounds() const; ///< of its device

    [[nodiscard]] ResidencyState state() const;

private:
    [[nodiscard]] TextureKind kindOf(TexelForm form) const;
    using Queue = std::vector<std::unique_ptr<PendingTexture>>;

    [[nodiscard]] std::optional<VolumeLease> leaseResident(const TextureKey& key, SamplesUse use);
    [[nodiscard]] PendingTexture* findPending(const TextureKey& key) const;
    PendingTexture& enqueue(std::unique_ptr<PendingTexture> pending, WantedPriority priority);
    PendingTexture& enqueueSamples(const TextureKey& key, TexelForm form, SamplesUse use,
                                   WantedPriority priority);
    bool keepIfRoom(PendingTexture& pending);
    void dequeue(const PendingTexture& pending);
    [[nodiscard]] PendingTexture* mostWanted() const;
    [[nodiscard]] bool advanceToLease(PendingTexture& pending, Deadline deadline,
                                      const ResidentVolume* source);
    void advanceInBackground(PendingTexture& pending, Deadline deadline);
    void complete(PendingTexture& pending);

    [[nodiscard]] std::uint64_t occupiedBytes() const;
    [[nodiscard]] bool couldMakeRoom(const PendingTexture& pending) const;
    void beginAtAnyPrice(PendingTexture& pending);
    [[nodiscard]] bool beginInBackground(PendingTexture& pending);
    bool evictOne(std::optional<WantedPriority> below, const PendingTexture& inFavourOf);
    void createTexture(PendingTexture& pending, std::optional<WantedPriority> below);

    gpu::Context& context_;
    std::shared_ptr<const VolumeProvider> provider_;
    std::uint64_t budgetBytes_;
    std::unique_ptr<SliceReader> reader_;
    std::unique_ptr<TextureTable> table_;
    Queue queue_;
    std::uint64_t lastSequence_ = 0;
    ResidencyState totals_; ///< the counts since the start
};

} // namespace voxsheet
