#include "engine/shown_volumes.h"

#include <algorithm>
#include <utility>

namespace voxsheet::engine {

std::vector<WantedVolume> volumesOf(const TileSpec& tile, const RenderPaths& paths, WantedPriority priority) {
    const bool onHost = paths.onHost(tile);
    std::vector<WantedVolume> volumes{
        {{tile.dataset, tile.field, tile.step, tile.level}, priority, {tile.floatTexels, onHost}}};
    if (tile.clip.object)
        volumes.push_back({{tile.clip.object->dataset, 0, 0, 0}, priority, {FloatTexels::Full, onHost}});
    if (tile.technique == Technique::Isosurface && tile.isosurface.colouredBy) {
        const auto& by = *tile.isosurface.colouredBy;
        volumes.push_back({{by.dataset, by.field, by.step, by.level}, priority, {FloatTexels::Full, onHost}});
    }
    for (const VolumeLayer& layer : tile.layers.volumes)
        volumes.push_back(
            {{layer.dataset, layer.field, layer.step, layer.level}, priority, {layer.floatTexels, onHost}});
    return volumes;
}

std::optional<std::vector<WantedVolume>> ShownVolumes::replace(const std::string& viewer,
                                                               std::vector<WantedVolume> volumes) {
    if (volumes.empty()) {
        viewers_.erase(viewer);
    } else {
        viewers_[viewer] = std::move(volumes);
    }
    std::vector<WantedVolume> all;
    std::map<std::pair<VolumeKey, TexelForm>, std::size_t> places;
    for (const auto& [name, shown] : viewers_) {
        for (const WantedVolume& volume : shown) {
            const auto [place, isNew] = places.try_emplace({volume.key, volume.form}, all.size());
            if (isNew) {
                all.push_back(volume);
            } else {
                WantedPriority& priority = all[place->second].priority;
                priority = std::max(priority, volume.priority);
            }
        }
    }
    if (all == all_) return std::nullopt;
    all_ = all;
    return all;
}

} // namespace voxsheet::engine
