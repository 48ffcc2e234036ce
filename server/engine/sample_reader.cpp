#include "engine/sample_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace voxsheet::engine {

namespace {

int wrappedOnAxis(int index, int size, bool periodic) {
    if (!periodic) return std::clamp(index, 0, size - 1);
    const int rest = index % size;
    return rest < 0 ? rest + size : rest;
}

std::optional<double> finite(double value) {
    return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

/// Values of slices of a level, as doubles or rounded to floats.
template <typename Value>
std::vector<Value> readSlices(const VolumeProvider& volumes, const DatasetMeta& meta, const VolumeKey& key,
                              int zBegin, int zCount) {
    const FieldMeta& field = meta.fields.at(static_cast<std::size_t>(key.field));
    const ScalarType type = levelType(field.storedType, key.level);
    const glm::ivec3 dims = levelDims(meta.grid.dims, key.level);
    const auto count = static_cast<std::size_t>(sampleCount({dims.x, dims.y, zCount}));
    std::vector<std::byte> bytes(count * scalarBytes(type));
    volumes.readSlices(key, zBegin, zCount, bytes);
    std::vector<Value> values(count);
    visitScalar(type, [&]<typename T>() {
        for (std::size_t i = 0; i < count; ++i) {
            T stored;
            std::memcpy(&stored, bytes.data() + i * sizeof(T), sizeof(T));
            values[i] =
                static_cast<Value>(field.valueScale * static_cast<double>(stored) + field.valueOffset);
        }
    });
    return values;
}

} // namespace

std::vector<double> readValues(const VolumeProvider& volumes, const DatasetMeta& meta, const VolumeKey& key,
                               int zBegin, int zCount) {
    return readSlices<double>(volumes, meta, key, zBegin, zCount);
}

ValueSummary summariseField(const VolumeProvider& volumes, const DatasetMeta& meta, int field, int step) {
    int level = 0;
    while (level + 1 < meta.levels() && sampleCount(levelDims(meta.grid.dims, level)) > kSummarySamples)
        ++level;
    const glm::ivec3 dims = levelDims(meta.grid.dims, level);
    auto sorted = readSlices<float>(volumes, meta, {meta.key, field, step, level}, 0, dims.z);
    const FieldMeta& described = meta.fields.at(static_cast<std::size_t>(field));
    const ValueExtremes all = extremesOf(described).value_or(ValueExtremes{});
    ValueSummary summary = summariseValues(sorted, all.min, all.max);
    summary.integers = !isFloat(described.storedType) && described.valueScale == 1.0;
    return summary;
}

std::optional<ValueExtremes> extremesOf(const FieldMeta& field, std::optional<int> step) {
    std::optional<ValueExtremes> all;
    for (std::size_t i = 0; i < field.steps.size(); ++i) {
        const ValueStatistics& each = field.steps[i].statistics;
        if (each.finiteCount == 0 || (step && static_cast<std::size_t>(*step) != i)) continue;
        all = all ? ValueExtremes{std::min(all->min, each.min), std::max(all->max, each.max)}
                  : ValueExtremes{each.min, each.max};
    }
    return all;
}

std::optional<PointSample> samplePoint(const VolumeProvider& volumes, const DatasetMeta& meta, int field,
                                       int step, const PeriodicWindow& window, const glm::dvec3& world) {
    const auto indexIn = [&](const Grid& grid) {
        return glm::dvec3(glm::inverse(grid.worldFromIndex) * glm::dvec4(world, 1.0));
    };
    const Grid drawn = drawnGrid(meta.grid, window);
    const IndexBox box = boxIndex(drawn);
    const glm::dvec3 inBox = indexIn(drawn);
    for (int axis = 0; axis < 3; ++axis) {
        if (!(inBox[axis] >= box.low[axis] - 1e-9 && inBox[axis] <= box.high[axis] + 1e-9))
            return std::nullopt;
    }
    const glm::dvec3 p = indexIn(placedGrid(meta.grid, window));
    Level0Reader samples(volumes, meta, field, step);
    PointSample sample;
    sample.nearest = samples.wrapped(glm::ivec3(glm::floor(p + 0.5)));
    sample.value = finite(samples.at(sample.nearest));
    sample.interpolated = finite(samples.interpolated(p));
    return sample;
}

glm::ivec3 Level0Reader::wrapped(const glm::ivec3& index) const {
    const Grid& grid = meta_.grid;
    glm::ivec3 inside;
    for (int axis = 0; axis < 3; ++axis)
        inside[axis] = wrappedOnAxis(index[axis], grid.dims[axis], grid.periodic[axis]);
    return inside;
}

double Level0Reader::at(const glm::ivec3& index) {
    const glm::ivec3 inside = wrapped(index);
    auto slice = slices_.find(inside.z);
    if (slice == slices_.end())
        slice = slices_.emplace(inside.z, readValues(volumes_, meta_, key_, inside.z, 1)).first;
    return slice->second[static_cast<std::size_t>(inside.y) * static_cast<std::size_t>(meta_.grid.dims.x) +
                         static_cast<std::size_t>(inside.x)];
}

double Level0Reader::interpolated(const glm::dvec3& indexPoint) {
    const glm::ivec3 base(glm::floor(indexPoint));
    const glm::dvec3 w = indexPoint - glm::dvec3(base);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 offset(corner & 1, (corner >> 1) & 1, corner >> 2);
        double weight = 1.0;
        for (int axis = 0; axis < 3; ++axis)
            weight *= offset[axis] != 0 ? w[axis] : 1.0 - w[axis];
        if (weight > 0.0) sum += weight * at(base + offset);
    }
    return sum;
}

} // namespace voxsheet::engine
