// Voxels from the volume store, for the renderer, probes and formulas.
#pragma once

#include "store/volume_store.h"
#include "volume/volume_provider.h"

#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace voxsheet::store {

/// Thread-safe. Keeps the entries that were asked for open (so that no process evicts them) until forget().
class StoreVolumeProvider : public VolumeProvider {
public:
    explicit StoreVolumeProvider(std::shared_ptr<const VolumeStore> store) : store_(std::move(store)) {}

    [[nodiscard]] std::shared_ptr<const DatasetMeta> describe(const std::string& dataset) const override;
    void readSlices(const VolumeKey& key, int zBegin, int zCount, std::span<std::byte> out) const override;
    /// Past the operating system's cache where that can be: StoreEntry::readSlicesPastCache.
    void readSlicesOnce(const VolumeKey& key, int zBegin, int zCount,
                        std::span<std::byte> out) const override;
    [[nodiscard]] MinMaxGrid readMinMax(const VolumeKey& key) const override;
    void dropPages(const VolumeKey& key, int zBegin, int zCount) const override;

    /// The open entry; throws NotFound if the store has none under this key (import the source again),
    /// InvalidInput if it is no key.
    [[nodiscard]] std::shared_ptr<const StoreEntry> entry(const std::string& dataset) const;
    /// Source value (after slope and intercept) of one level-0 sample; NaN where the source has NaN.
    /// Throws NotFound, InvalidInput (outside the volume), IoError.
    [[nodiscard]] double readValue(const std::string& dataset, int field, int step,
                                   const glm::ivec3& sample) const;

    /// Reads this entry from now on, which a writer is still about to commit.
    void adopt(const std::shared_ptr<const StoreEntry>& entry);
    /// Closes an entry: from now on it may be evicted.
    void forget(const std::string& dataset);

private:
    std::shared_ptr<const VolumeStore> store_;
    mutable std::mutex mutex_;
    mutable std::map<std::string, std::shared_ptr<const StoreEntry>> open_;
};

} // namespace voxsheet::store
