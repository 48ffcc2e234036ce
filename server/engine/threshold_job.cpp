#include "engine/threshold_job.h"

#include "base/errors.h"
#include "engine/sample_reader.h"
#include "store/store_key.h"

#include <algorithm>
#include <array>
#include <bit>
#include <span>

namespace voxsheet::engine {

namespace {

constexpr const char* kQuantity = "signed distance";
constexpr const char* kVersion = "1"; ///< of the computation: another one, other keys
constexpr long kSlabSamples = 1L << 20;
/// Of an output sample: distance, nearest vertex, crossings of three edges, cell, and the entry's pyramid.
constexpr std::uint64_t kBytesPerDistance = 32;
constexpr double kReadShare = 0.25; ///< of the progress

int slabSlices(const glm::ivec3& dims) {
    const long slice = static_cast<long>(dims.x) * dims.y;
    return static_cast<int>(std::clamp(kSlabSamples / slice, 1L, static_cast<long>(dims.z)));
}

void throwIfCancelled(const ThresholdTask& task, const JobControl& control) {
    if (control.cancelled && control.cancelled())
        throw Cancelled("clip object " + task.text, "it is not needed any more");
}

void report(const JobControl& control, double progress) {
    if (control.progress) control.progress(progress);
}

std::vector<float> readLevel0(const ThresholdTask& task, const VolumeProvider& volumes,
                              const JobControl& control) {
    const DatasetMeta& meta = *task.input.meta;
    const glm::ivec3 dims = meta.grid.dims;
    const int slab = slabSlices(dims);
    std::vector<float> values;
    values.reserve(static_cast<std::size_t>(sampleCount(dims)));
    for (int z = 0; z < dims.z; z += slab) {
        throwIfCancelled(task, control);
        const int count = std::min(slab, dims.z - z);
        const auto read =
            readValues(volumes, meta, {meta.key, task.input.field, task.input.step, 0}, z, count);
        std::transform(read.begin(), read.end(), std::back_inserter(values),
                       [](double value) { return static_cast<float>(value); });
        report(control, kReadShare * (z + count) / dims.z);
    }
    throwIfCancelled(task, control);
    return values;
}

DatasetMeta resultMeta(const ThresholdTask& task, const std::string& key, const Grid& grid) {
    const DatasetMeta& compared = *task.input.meta;
    DatasetMeta meta;
    meta.key = key;
    meta.sourcePath = task.text;
    meta.format = "threshold";
    meta.grid = grid;
    meta.sourceType = ScalarType::F32;
    meta.lengthUnit = compared.lengthUnit;
    meta.anatomical = compared.anatomical;
    FieldMeta field;
    field.name = "distance";
    field.quantity = kQuantity;
    field.unit = compared.lengthUnit;
    field.storedType = ScalarType::F32;
    field.steps.resize(1);
    meta.fields.push_back(std::move(field));
    return meta;
}

} // namespace

std::string thresholdEntryKey(const ThresholdTask& task) {
    const std::array<std::string, 7> parts{"threshold",
                                           kVersion,
                                           task.input.meta->key,
                                           std::to_string(task.input.field),
                                           std::to_string(task.input.step),
                                           std::to_string(static_cast<int>(task.threshold.comparison)),
                                           std::to_string(std::bit_cast<std::uint64_t>(
                                               task.threshold.value == 0.0 ? 0.0 : task.threshold.value))};
    return store::storeKey(parts);
}

std::uint64_t thresholdMemoryBytes(const ThresholdTask& task) {
    const Grid& grid = task.input.meta->grid;
    const auto samples = static_cast<std::uint64_t>(sampleCount(grid.dims));
    const auto slab = static_cast<std::uint64_t>(slabSlices(grid.dims)) *
                      static_cast<std::uint64_t>(grid.dims.x) * static_cast<std::uint64_t>(grid.dims.y);
    const auto distances = static_cast<std::uint64_t>(sampleCount(distanceGrid(grid).dims));
    return samples * sizeof(float) + 2 * slab * sizeof(double) + distances * kBytesPerDistance;
}

ComputedEntry computeThreshold(const ThresholdTask& task, const store::VolumeStore& store,
                               const VolumeProvider& volumes, std::uint64_t memoryBudgetBytes,
                               const JobControl& control) {
    const std::string key = thresholdEntryKey(task);
    if (const auto entry = store.open(key)) return ComputedEntry(entry);
    requireMemory("clip object " + task.text, thresholdMemoryBytes(task), memoryBudgetBytes);
    DistanceVolume result;
    {
        const std::vector<float> values = readLevel0(task, volumes, control);
        result = signedDistance(task.input.meta->grid, values, task.threshold);
    }
    throwIfCancelled(task, control);
    report(control, 0.9);
    return {store, resultMeta(task, key, result.grid), std::as_bytes(std::span(result.distances))};
}

bool holdsSignedDistances(const DatasetMeta& meta) {
    return !meta.fields.empty() && meta.fields.front().quantity == kQuantity;
}

} // namespace voxsheet::engine
