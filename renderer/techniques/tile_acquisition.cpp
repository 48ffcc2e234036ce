#include "techniques/tile_acquisition.h"

#include "base/byte_size.h"
#include "base/errors.h"

#include <algorithm>
#include <array>
#include <utility>

namespace voxsheet {
namespace {

/// A level with at most so many samples is read and uploaded within a few milliseconds.
constexpr long kSmallLevelSamples = 64L * 64 * 64;

/// One volume that the tile reads.
struct Part {
    VolumeKey key;
    TexelForm form;
    SamplesUse use = SamplesUse::Drawing;
    /// Of categories: coarser levels hold means, and the mean of two labels is a third one. So nothing stands
    /// in for their level, neither while it is brought in nor where it does not fit.
    bool exactLevel = false;
};

Part drawnPart(const TileSpec& tile, const RenderPaths& paths, int level) {
    return {{tile.dataset, tile.field, tile.step, level},
            {tile.floatTexels, paths.onHost(tile)},
            SamplesUse::Drawing,
            tile.categories};
}

std::optional<Part> clipPart(const TileSpec& tile, const RenderPaths& paths, int level) {
    if (!tile.clip.object || tile.technique == Technique::Plane) return std::nullopt;
    return Part{{tile.clip.object->dataset, 0, 0, level},
                {FloatTexels::Full, paths.onHost(tile)},
                SamplesUse::Clipping};
}

std::optional<Part> colourPart(const TileSpec& tile, const RenderPaths& paths, int level) {
    if (tile.technique != Technique::Isosurface || !tile.isosurface.colouredBy) return std::nullopt;
    const auto& colours = *tile.isosurface.colouredBy;
    return Part{{colours.dataset, colours.field, colours.step, level},
                {FloatTexels::Full, paths.onHost(tile)},
                SamplesUse::Drawing};
}

Part layerPart(const TileSpec& tile, const RenderPaths& paths, std::size_t i, int level) {
    const auto& layer = tile.layers.volumes[i];
    return {{layer.dataset, layer.field, layer.step, level},
            {layer.floatTexels, paths.onHost(tile)},
            SamplesUse::Drawing,
            layer.categories};
}

/// One of the levels, and the bytes of what it stands for.
struct LevelBytes {
    int* level;
    int coarsest;
    std::uint64_t bytes;
};

/// Empty while it is being read, to be asked for again. Where the budget has no room for it beside what is
/// visible, it is waited for: others that are missing would push it out before it is asked for again.
std::optional<VolumeLease> acquireRequested(ResidencyManager& residency, const Part& part,
                                            Deadline deadline) {
    const bool keepsItsRoom = residency.request(part.key, part.form, part.use);
    return residency.acquireBy(keepsItsRoom ? deadline : Deadline::max(), part.key, part.form, part.use);
}

std::optional<VolumeLease> acquireSmallLevel(ResidencyManager& residency, const Part& part,
                                             Deadline deadline) {
    const auto meta = residency.describe(part.key.dataset);
    VolumeKey key = part.key;
    while (key.level + 1 < meta->levels() &&
           sampleCount(levelDims(meta->grid.dims, key.level)) > kSmallLevelSamples)
        ++key.level;
    while (key.level + 1 < meta->levels() && residency.bytesOf(key, part.form) > residency.budgetBytes() / 4)
        ++key.level;
    return acquireRequested(residency, {key, part.form, part.use}, deadline);
}

/// Empty while nothing is there to stand in for it.
/// \param awaited  set when the level itself is on its way
std::optional<VolumeLease> acquireAtHand(ResidencyManager& residency, const Part& part, Deadline deadline,
                                         bool& awaited) {
    if (auto exact = residency.acquireResident(part.key, part.form, part.use)) return exact;
    if (part.exactLevel) return acquireRequested(residency, part, deadline);
    const auto atHand = [&] {
        VolumeKey key = part.key;
        if (const auto level = residency.nearestResidentLevel(part.key, part.form)) key.level = *level;
        auto lease = residency.acquireResident(key, part.form, part.use);
        return lease ? std::move(lease) : acquireSmallLevel(residency, part, deadline);
    };
    auto lease = atHand();
    if (lease && lease->volume().level != part.key.level)
        awaited = residency.request(part.key, part.form, part.use) || awaited;
    return lease;
}

} // namespace

bool wantsGradientTexture(const TileSpec& tile, const RenderPaths& paths) {
    // Surfaces of cuts have their own normals; only caps and samples inside the volume need gradients.
    const bool usesGradients = tile.technique == Technique::Raycast ||
                               tile.technique == Technique::Isosurface || tile.technique == Technique::Slices;
    if (!usesGradients || !tile.shading.enabled || tile.shading.gradient != GradientSource::Texture)
        return false;
    // SimdRays takes them from the samples: as fast, and without the texture.
    return !paths.onHost(tile);
}

TileLevels askedLevels(const TileSpec& tile) {
    TileLevels levels;
    levels.volume = tile.level;
    if (tile.isosurface.colouredBy) levels.colours = tile.isosurface.colouredBy->level;
    for (const auto& layer : tile.layers.volumes)
        levels.layers.push_back(layer.level);
    return levels;
}

TileLevels levelsWithinBudget(const ResidencyManager& residency, const TileSpec& tile,
                              const RenderPaths& paths) {
    TileLevels levels = askedLevels(tile);
    while (true) {
        std::vector<LevelBytes> parts;
        const auto add = [&](const std::optional<Part>& part, int& level, bool gradients) {
            if (!part) return;
            // One volume read in two roles is one texture.
            std::uint64_t bytes = residency.bytesOf(part->key, part->form);
            if (gradients) bytes += residency.gradientBytesOf(part->key);
            const int coarsest =
                part->exactLevel ? part->key.level : residency.describe(part->key.dataset)->levels() - 1;
            parts.push_back({&level, coarsest, bytes});
        };
        add(drawnPart(tile, paths, levels.volume), levels.volume, wantsGradientTexture(tile, paths));
        add(clipPart(tile, paths, levels.clipObject), levels.clipObject, false);
        add(colourPart(tile, paths, levels.colours), levels.colours, false);
        for (std::size_t i = 0; i < tile.layers.volumes.size(); ++i)
            add(layerPart(tile, paths, i, levels.layers.at(i)), levels.layers.at(i), false);
        std::uint64_t sum = 0;
        for (const auto& part : parts)
            sum += part.bytes;
        if (sum <= residency.budgetBytes()) return levels;
        std::erase_if(parts, [](const LevelBytes& part) { return *part.level >= part.coarsest; });
        if (parts.empty()) {
            throw LimitExceeded(
                "the coarsest levels that this picture can be drawn from take " + byteText(sum),
                "the texture budget is " + byteText(residency.budgetBytes()), "raise --texture-budget")
                .withField("texture-budget");
        }
        ++*std::max_element(parts.begin(), parts.end(), [](const LevelBytes& a, const LevelBytes& b) {
               return a.bytes < b.bytes;
           })->level;
    }
}

bool isTileResident(const ResidencyManager& residency, const TileSpec& tile, const RenderPaths& paths,
                    const TileLevels& levels) {
    const auto resident = [&](const std::optional<Part>& part) {
        return !part || residency.isResident(part->key, part->form);
    };
    for (std::size_t i = 0; i < tile.layers.volumes.size(); ++i)
        if (!resident(layerPart(tile, paths, i, levels.layers.at(i)))) return false;
    const Part drawn = drawnPart(tile, paths, levels.volume);
    return resident(drawn) && resident(clipPart(tile, paths, levels.clipObject)) &&
           resident(colourPart(tile, paths, levels.colours)) &&
           (!wantsGradientTexture(tile, paths) || residency.areGradientsResident(drawn.key, drawn.form));
}

std::vector<WantedVolume> missingVolumes(const ResidencyManager& residency, const TileSpec& tile,
                                         const RenderPaths& paths, const TileLevels& levels) {
    std::vector<WantedVolume> missing;
    const auto add = [&](const std::optional<Part>& part) {
        if (part && !residency.isResident(part->key, part->form))
            missing.push_back({part->key, WantedPriority::Visible, part->form});
    };
    add(drawnPart(tile, paths, levels.volume));
    add(clipPart(tile, paths, levels.clipObject));
    add(colourPart(tile, paths, levels.colours));
    for (std::size_t i = 0; i < tile.layers.volumes.size(); ++i)
        add(layerPart(tile, paths, i, levels.layers.at(i)));
    return missing;
}

std::optional<TileVolumes> acquireTileBy(ResidencyManager& residency, const TileSpec& tile,
                                         const RenderPaths& paths, const TileLevels& levels,
                                         Deadline deadline, const DerivedTextureBuilder& buildGradients) {
    const auto acquire = [&](const Part& part) {
        return residency.acquireBy(deadline, part.key, part.form, part.use);
    };
    const Part drawn = drawnPart(tile, paths, levels.volume);
    auto volume = acquire(drawn);
    if (!volume) return std::nullopt;
    TileVolumes volumes{std::move(*volume), {}, {}, {}, {}, false, false};
    if (wantsGradientTexture(tile, paths)) {
        volumes.gradients = residency.acquireGradientsBy(deadline, drawn.key, drawn.form, buildGradients);
        if (!volumes.gradients) return std::nullopt;
    }
    if (const auto part = clipPart(tile, paths, levels.clipObject)) {
        volumes.clipObject = acquire(*part);
        if (!volumes.clipObject) return std::nullopt;
    }
    if (const auto part = colourPart(tile, paths, levels.colours)) {
        volumes.colours = acquire(*part);
        if (!volumes.colours) return std::nullopt;
    }
    for (std::size_t i = 0; i < tile.layers.volumes.size(); ++i) {
        auto layer = acquire(layerPart(tile, paths, i, levels.layers.at(i)));
        if (!layer) return std::nullopt;
        volumes.layers.push_back(std::move(*layer));
    }
    return volumes;
}

std::optional<TileVolumes> acquireTileAtHand(ResidencyManager& residency, const TileSpec& tile,
                                             const RenderPaths& paths, const TileLevels& levels,
                                             Deadline deadline, const DerivedTextureBuilder& buildGradients) {
    bool awaited = false;
    const auto acquire = [&](const Part& part) { return acquireAtHand(residency, part, deadline, awaited); };
    const Part drawn = drawnPart(tile, paths, levels.volume);
    auto volume = acquire(drawn);
    if (!volume) return std::nullopt;
    TileVolumes volumes{std::move(*volume), {}, {}, {}, {}, false, false};
    volumes.standIn = volumes.volume.volume().level != levels.volume;
    if (wantsGradientTexture(tile, paths)) {
        VolumeKey key = drawn.key;
        key.level = volumes.volume.volume().level;
        // Without them the shader takes six taps: slower, and at samples the same.
        volumes.gradients = residency.acquireResidentGradients(key, tile.floatTexels);
        if (!volumes.gradients || key.level != levels.volume) {
            volumes.standIn = true;
            awaited = residency.requestGradients(drawn.key, drawn.form, buildGradients) || awaited;
        }
    }
    if (const auto part = clipPart(tile, paths, levels.clipObject)) {
        volumes.clipObject = acquire(*part);
        if (!volumes.clipObject) return std::nullopt;
        volumes.standIn = volumes.standIn || volumes.clipObject->volume().level != levels.clipObject;
    }
    if (const auto part = colourPart(tile, paths, levels.colours)) {
        volumes.colours = acquire(*part);
        if (!volumes.colours) return std::nullopt;
        volumes.standIn = volumes.standIn || volumes.colours->volume().level != levels.colours;
    }
    for (std::size_t i = 0; i < tile.layers.volumes.size(); ++i) {
        auto layer = acquire(layerPart(tile, paths, i, levels.layers.at(i)));
        if (!layer) return std::nullopt;
        volumes.layers.push_back(std::move(*layer));
        volumes.standIn = volumes.standIn || volumes.layers.back().volume().level != levels.layers.at(i);
    }
    volumes.awaited = awaited;
    return volumes;
}

} // namespace voxsheet
