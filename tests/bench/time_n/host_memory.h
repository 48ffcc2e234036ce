// Host memory of a limited size between disk and textures.
#pragma once

#include "store/store_volume_provider.h"

#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>

namespace voxsheet::bench {

/// Serves volumes from the store. The operating system's page cache is the memory, and this says what may
/// stay in it: levels beyond the budget, least recently used first, are dropped from it, so that they
/// are read from the disk again. Thread-safe.
class HostMemory : public VolumeProvider {
public:
    HostMemory(std::shared_ptr<const store::VolumeStore> store, std::uint64_t budgetBytes);

    [[nodiscard]] std::shared_ptr<const DatasetMeta> describe(const std::string& dataset) const override;
    void readSlices(const VolumeKey& key, int zBegin, int zCount, std::span<std::byte> out) const override;
    [[nodiscard]] MinMaxGrid readMinMax(const VolumeKey& key) const override;

    [[nodiscard]] std::uint64_t residentBytes() const;
    /// Bytes that had to come from the disk, since the start.
    [[nodiscard]] std::uint64_t diskBytes() const;

private:
    void touch(const VolumeKey& key) const;
    void drop(const VolumeKey& key) const;

    store::StoreVolumeProvider provider_;
    std::uint64_t budgetBytes_;
    mutable std::mutex mutex_;
    mutable std::list<VolumeKey> recent_; ///< most recently used first
    mutable std::map<VolumeKey, std::list<VolumeKey>::iterator> held_;
    mutable std::uint64_t residentBytes_ = 0;
    mutable std::uint64_t diskBytes_ = 0;
};

} // namespace voxsheet::bench
