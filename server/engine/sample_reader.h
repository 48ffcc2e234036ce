// Samples of the store as values (after slope and intercept).
#pragma once

#include "engine/default_look.h"
#include "volume/periodic_window.h"
#include "volume/volume_provider.h"

#include <glm/glm.hpp>

#include <map>
#include <optional>
#include <vector>

namespace voxsheet::engine {

/// Slices [zBegin, zBegin + zCount) of `key` as values. Throws as VolumeProvider::readSlices.
[[nodiscard]] std::vector<double> readValues(const VolumeProvider& volumes, const DatasetMeta& meta,
                                             const VolumeKey& key, int zBegin, int zCount);

/// Distribution of the field's values at a step, from the finest level with at most kSummarySamples samples
/// (extremes from the statistics of all steps, so that a series keeps one look). Throws as readValues.
inline constexpr long kSummarySamples = 300'000;
[[nodiscard]] ValueSummary summariseField(const VolumeProvider& volumes, const DatasetMeta& meta, int field,
                                          int step);

/// Of one step, or of all. Empty if no value is finite.
[[nodiscard]] std::optional<ValueExtremes> extremesOf(const FieldMeta& field, std::optional<int> step = {});

/// Level-0 values at single points, read slice by slice as they are needed, and kept. Keeps references:
/// outlived by its arguments.
class Level0Reader {
public:
    Level0Reader(const VolumeProvider& volumes, const DatasetMeta& meta, int field, int step)
        : volumes_(volumes), meta_(meta), key_{meta.key, field, step, 0} {}

    /// Of a sample; an index beyond the ends is the nearest one, or wraps. Throws as readValues.
    [[nodiscard]] double at(const glm::ivec3& index);
    /// Trilinear at a point of the index frame; NaN if one of the eight is.
    [[nodiscard]] double interpolated(const glm::dvec3& indexPoint);
    /// The index as it is in the file.
    [[nodiscard]] glm::ivec3 wrapped(const glm::ivec3& index) const;

private:
    const VolumeProvider& volumes_;
    const DatasetMeta& meta_;
    VolumeKey key_;
    std::map<int, std::vector<double>> slices_;
};

/// What the level-0 samples say about one point of the world.
struct PointSample {
    glm::ivec3 nearest{0};              ///< index of the nearest sample
    std::optional<double> value;        ///< of the nearest sample; absent: NaN
    std::optional<double> interpolated; ///< trilinear; absent: one of the eight is NaN, as in the picture
};

/// Of the volume as a window shows it; wraps on periodic axes. Empty: the point lies outside the drawn box.
/// Throws as readValues.
[[nodiscard]] std::optional<PointSample> samplePoint(const VolumeProvider& volumes, const DatasetMeta& meta,
                                                     int field, int step, const PeriodicWindow& window,
                                                     const glm::dvec3& world);

} // namespace voxsheet::engine
