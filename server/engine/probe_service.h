// Values of all cells at one point.
#pragma once

#include "engine/engine.h"
#include "engine/pixel_probe.h"
#include "engine/tile_maker.h"

#include <list>
#include <memory>
#include <mutex>

namespace voxsheet::engine {

/// Thread-safe.
class ProbeService {
public:
    ProbeService(const sheet::KeyTable& keys, std::shared_ptr<const VolumeProvider> volumes)
        : keys_(keys), volumes_(std::move(volumes)) {}

    /// One value per cell of the sheet that has a source, in reading order.
    [[nodiscard]] std::vector<ProbeValue> atWorld(const sheet::Workbook& workbook, std::size_t sheetIndex,
                                                  const View& view, const CellContents& contents,
                                                  const glm::dvec3& world) const;

    /// The world point under a pixel of a tile; empty if the ray misses the volume.
    [[nodiscard]] std::optional<glm::dvec3> underPixel(const TileSpec& tile, const DatasetMeta& meta,
                                                       glm::dvec2 pixel);

private:
    static constexpr long kLevelSamples = 2'500'000; ///< of a level that is kept for rays
    static constexpr std::size_t kLevels = 4;

    [[nodiscard]] std::shared_ptr<const LevelSamples> levelFor(const DatasetMeta& meta, int field, int step);

    const sheet::KeyTable& keys_;
    std::shared_ptr<const VolumeProvider> volumes_;
    std::mutex mutex_;
    std::list<std::pair<VolumeKey, std::shared_ptr<const LevelSamples>>> levels_; ///< most recent first
};

} // namespace voxsheet::engine
