// Values of all cells at one point.
#pragma once

#include "engine/atom_probe.h"
#include "engine/engine.h"
#include "engine/pixel_probe.h"
#include "engine/tile_maker.h"
#include "engine/visible_range.h"
#include "volume/clip_shape_provider.h"

#include <functional>
#include <list>
#include <memory>
#include <mutex>

namespace voxsheet::engine {

/// Thread-safe.
class ProbeService {
public:
    ProbeService(const sheet::KeyTable& keys, std::shared_ptr<const VolumeProvider> volumes)
        : keys_(keys), volumes_(std::make_shared<const ClipShapeProvider>(std::move(volumes))) {}

    /// The volumes that are blended into a cell's picture. May throw: the cell then says why.
    using LayersOf = std::function<std::vector<LayerLook>(const sheet::Address&)>;

    /// One value per cell of the sheet that has a source, in reading order.
    /// \param layersOf  asked for cells whose style names layers or an overlay
    [[nodiscard]] std::vector<ProbeValue> atWorld(const sheet::Workbook& workbook, std::size_t sheetIndex,
                                                  const View& view, const CellContents& contents,
                                                  const glm::dvec3& world, const LayersOf& layersOf) const;

    /// What lies under a pixel of a tile; empty if the ray meets nothing. An isosurface's crossing is one of
    /// level 0, whatever the level that is drawn.
    /// \param opacity  as pixelHit()
    [[nodiscard]] std::optional<PixelHit> underPixel(const TileSpec& tile, const DatasetMeta& meta,
                                                     glm::dvec2 pixel, std::optional<double> opacity);

    /// The atom that the ray meets first of those that the tile shows.
    [[nodiscard]] std::optional<AtomHit> atomOnRay(const TileSpec& tile, const DatasetMeta& meta,
                                                   const Ray& ray);

    /// As visibleRange().
    [[nodiscard]] std::optional<ValueExtremes> visible(const TileSpec& tile, const DatasetMeta& meta);

private:
    static constexpr long kLevelSamples = 2'500'000; ///< of a level that is kept for rays
    static constexpr std::size_t kLevels = 6;

    struct Level {
        VolumeKey key;
        std::shared_ptr<const LevelSamples> samples;
    };
    [[nodiscard]] LayerValue layerAt(const LayerLook& layer, const glm::dvec3& world) const;
    /// The finest level that is small enough.
    [[nodiscard]] Level levelFor(const DatasetMeta& meta, int field, int step);
    [[nodiscard]] std::shared_ptr<const LevelSamples> samplesOf(const DatasetMeta& meta,
                                                                const VolumeKey& key);
    [[nodiscard]] ObjectSamples objectOf(const ClipObject& object);
    /// Moves a crossing that was found on a coarse level to level 0's, if there is one nearby.
    void refine(PixelHit& hit, const TileSpec& tile, const DatasetMeta& meta, const Ray& ray,
                int level) const;

    const sheet::KeyTable& keys_;
    std::shared_ptr<const VolumeProvider> volumes_;
    std::mutex mutex_;
    std::list<std::pair<VolumeKey, std::shared_ptr<const LevelSamples>>> levels_; ///< most recent first
};

} // namespace voxsheet::engine
