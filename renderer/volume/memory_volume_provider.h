// Volumes held in memory, for tests, benches and generators: the same pyramid, ranges and statistics as in
// the store.
#pragma once

#include "volume/volume_provider.h"

#include <cstddef>
#include <map>
#include <shared_mutex>
#include <vector>

namespace voxsheet {

/// Thread-safe.
class MemoryVolumeProvider : public VolumeProvider {
public:
    /// Adds a dataset under meta.key; computes the statistics, the levels and the min-max grids.
    /// \param meta    steps of its fields are overwritten
    /// \param arrays  level 0, [field * steps + step], each grid.dims samples of the field's storedType
    /// Throws InvalidInput if meta has no field or no step, an array is missing or has the wrong size, or the
    /// grid is bad; Conflict if the key is taken.
    void add(DatasetMeta meta, std::vector<std::vector<std::byte>> arrays);
    void remove(const std::string& dataset);

    [[nodiscard]] std::shared_ptr<const DatasetMeta> describe(const std::string& dataset) const override;
    void readSlices(const VolumeKey& key, int zBegin, int zCount, std::span<std::byte> out) const override;
    [[nodiscard]] MinMaxGrid readMinMax(const VolumeKey& key) const override;

private:
    struct Level {
        std::vector<std::byte> samples;
        MinMaxGrid minMax;
    };
    struct Dataset {
        std::shared_ptr<const DatasetMeta> meta;
        std::vector<std::vector<Level>> arrays; ///< [field * steps + step][level]
    };

    [[nodiscard]] std::shared_ptr<const Dataset> find(const std::string& dataset) const;
    [[nodiscard]] static const Level& levelOf(const Dataset& dataset, const VolumeKey& key);

    mutable std::shared_mutex mutex_;
    std::map<std::string, std::shared_ptr<const Dataset>> datasets_;
};

} // namespace voxsheet
