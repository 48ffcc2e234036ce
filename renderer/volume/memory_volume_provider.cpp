#include "volume/memory_volume_provider.h"

#include "base/errors.h"
#include "volume/pyramid.h"
#include "volume/statistics.h"

#include <algorithm>
#include <cstring>
#include <mutex>

namespace voxsheet {

void MemoryVolumeProvider::add(DatasetMeta meta, std::vector<std::vector<std::byte>> arrays) {
    validateGrid(meta.grid);
    const auto steps = meta.times.size();
    if (meta.fields.empty() || steps == 0 || arrays.size() != meta.fields.size() * steps)
        throw InvalidInput("dataset '" + meta.key + "'", "it needs one array per field and time step");
    auto dataset = std::make_shared<Dataset>();
    for (std::size_t f = 0; f < meta.fields.size(); ++f) {
        auto& field = meta.fields[f];
        field.steps.clear();
        for (std::size_t s = 0; s < steps; ++s) {
            std::vector<Level> levels(static_cast<std::size_t>(meta.levels()));
            levels[0].samples = std::move(arrays[f * steps + s]);
            StoredArray array{field.storedType, meta.grid.dims, levels[0].samples, field.valueScale,
                              field.valueOffset};
            field.steps.push_back(computeStatistics(array));
            levels[0].minMax = buildMinMaxGrid(array, meta.grid.periodic);
            for (std::size_t l = 1; l < levels.size(); ++l) {
                levels[l].samples = coarserLevel(array);
                array.type = pyramidType(field.storedType);
                array.dims = coarserDims(array.dims);
                array.samples = levels[l].samples;
                levels[l].minMax = buildMinMaxGrid(array, meta.grid.periodic);
            }
            dataset->arrays.push_back(std::move(levels));
        }
    }
    const auto key = meta.key;
    dataset->meta = std::make_shared<const DatasetMeta>(std::move(meta));
    const std::unique_lock lock(mutex_);
    if (!datasets_.emplace(key, std::move(dataset)).second)
        throw Conflict("dataset '" + key + "'", "there is one of this name already");
}

void MemoryVolumeProvider::remove(const std::string& dataset) {
    const std::unique_lock lock(mutex_);
    datasets_.erase(dataset);
}

std::shared_ptr<const MemoryVolumeProvider::Dataset>
MemoryVolumeProvider::find(const std::string& dataset) const {
    const std::shared_lock lock(mutex_);
    const auto found = datasets_.find(dataset);
    if (found == datasets_.end()) throw NotFound("dataset '" + dataset + "'", "there is none of this name");
    return found->second;
}

const MemoryVolumeProvider::Level& MemoryVolumeProvider::levelOf(const Dataset& dataset,
                                                                 const VolumeKey& key) {
    validateVolumeKey(*dataset.meta, key);
    const auto array = static_cast<std::size_t>(key.field * dataset.meta->stepCount() + key.step);
    return dataset.arrays[array][static_cast<std::size_t>(key.level)];
}

std::shared_ptr<const DatasetMeta> MemoryVolumeProvider::describe(const std::string& dataset) const {
    return find(dataset)->meta;
}

void MemoryVolumeProvider::readSlices(const VolumeKey& key, int zBegin, int zCount,
                                      std::span<std::byte> out) const {
    const auto dataset = find(key.dataset);
    const auto& samples = levelOf(*dataset, key).samples;
    const auto range = sliceBytes(*dataset->meta, key, zBegin, zCount);
    if (out.size() != range.count) throw InvalidInput("slices to read", "the buffer has the wrong size");
    std::memcpy(out.data(), samples.data() + range.offset, range.count);
}

MinMaxGrid MemoryVolumeProvider::readMinMax(const VolumeKey& key) const {
    const auto dataset = find(key.dataset);
    return levelOf(*dataset, key).minMax;
}

} // namespace voxsheet
