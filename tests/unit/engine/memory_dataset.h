// Small datasets in memory for the engine's tests.
#pragma once

#include "volume/memory_volume_provider.h"

#include <cstring>
#include <functional>
#include <memory>
#include <string>

namespace voxsheet::test {

/// f32 samples of `value` at (i, j, k), cell-centred unless changed.
inline DatasetMeta metaOf(const std::string& key, glm::ivec3 dims) {
    DatasetMeta meta;
    meta.key = key;
    meta.format = "test";
    meta.grid.dims = dims;
    FieldMeta field;
    field.name = "density";
    field.unit = "e/Å^3";
    meta.fields.push_back(field);
    return meta;
}

inline std::vector<std::byte> samplesOf(glm::ivec3 dims, const std::function<float(int, int, int)>& value) {
    std::vector<std::byte> bytes(static_cast<std::size_t>(sampleCount(dims)) * sizeof(float));
    std::size_t at = 0;
    for (int k = 0; k < dims.z; ++k) {
        for (int j = 0; j < dims.y; ++j) {
            for (int i = 0; i < dims.x; ++i, at += sizeof(float)) {
                const float v = value(i, j, k);
                std::memcpy(bytes.data() + at, &v, sizeof(float));
            }
        }
    }
    return bytes;
}

inline void addDataset(MemoryVolumeProvider& provider, DatasetMeta meta,
                       const std::function<float(int, int, int)>& value) {
    std::vector<std::vector<std::byte>> arrays;
    for (std::size_t i = 0; i < meta.fields.size() * meta.times.size(); ++i) {
        arrays.push_back(samplesOf(meta.grid.dims, value));
    }
    provider.add(std::move(meta), std::move(arrays));
}

} // namespace voxsheet::test
