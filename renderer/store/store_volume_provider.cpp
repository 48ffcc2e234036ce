#include "store/store_volume_provider.h"

#include "base/errors.h"

namespace voxsheet::store {

std::shared_ptr<const StoreEntry> StoreVolumeProvider::entry(const std::string& dataset) const {
    const std::lock_guard lock(mutex_);
    if (const auto found = open_.find(dataset); found != open_.end()) return found->second;
    auto opened = store_->open(dataset);
    if (!opened)
        throw NotFound("volume '" + dataset + "'", "the volume store does not have it", "import it again");
    open_.emplace(dataset, opened);
    return opened;
}

std::shared_ptr<const DatasetMeta> StoreVolumeProvider::describe(const std::string& dataset) const {
    return entry(dataset)->meta();
}

void StoreVolumeProvider::readSlices(const VolumeKey& key, int zBegin, int zCount,
                                     std::span<std::byte> out) const {
    entry(key.dataset)->readSlices(key, zBegin, zCount, out);
}

void StoreVolumeProvider::readSlicesOnce(const VolumeKey& key, int zBegin, int zCount,
                                         std::span<std::byte> out) const {
    entry(key.dataset)->readSlicesPastCache(key, zBegin, zCount, out);
}

MinMaxGrid StoreVolumeProvider::readMinMax(const VolumeKey& key) const {
    return entry(key.dataset)->readMinMax(key);
}

void StoreVolumeProvider::dropPages(const VolumeKey& key, int zBegin, int zCount) const {
    entry(key.dataset)->dropPages(key, zBegin, zCount);
}

double StoreVolumeProvider::readValue(const std::string& dataset, int field, int step,
                                      const glm::ivec3& sample) const {
    return entry(dataset)->readValue({dataset, field, step, 0}, sample);
}

void StoreVolumeProvider::adopt(const std::shared_ptr<const StoreEntry>& entry) {
    const std::lock_guard lock(mutex_);
    open_.insert_or_assign(entry->meta()->key, entry);
}

void StoreVolumeProvider::forget(const std::string& dataset) {
    const std::lock_guard lock(mutex_);
    open_.erase(dataset);
}

} // namespace voxsheet::store
