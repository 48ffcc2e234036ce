// A store in a temporary folder, and small datasets to put into it.
#pragma once

#include "store/store_writer.h"
#include "volume/grid.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

namespace voxsheet::store {

class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "voxsheet-test-XXXXXX").string();
        if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
        path_ = pattern;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

inline DatasetMeta sampleMeta(const std::string& key, glm::ivec3 dims = {20, 9, 6}, int fields = 1,
                              int steps = 1) {
    DatasetMeta meta;
    meta.key = key;
    meta.sourcePath = "/data/" + key + ".nrrd";
    meta.format = "nrrd";
    meta.grid.dims = dims;
    for (int f = 0; f < fields; ++f) {
        auto& field = meta.fields.emplace_back();
        field.name = "field" + std::to_string(f);
        field.storedType = ScalarType::I16;
        field.valueScale = 0.5;
        field.valueOffset = -1.0;
    }
    meta.times.clear();
    for (int s = 0; s < steps; ++s)
        meta.times.push_back(s * 0.25);
    return meta;
}

/// Sample i of the array is i + base.
inline std::vector<std::byte> rampSamples(glm::ivec3 dims, int base = 0) {
    std::vector<short> samples(static_cast<std::size_t>(sampleCount(dims)));
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = static_cast<short>(static_cast<int>(i) + base);
    std::vector<std::byte> bytes(samples.size() * sizeof(short));
    std::memcpy(bytes.data(), samples.data(), bytes.size());
    return bytes;
}

inline void writeSample(const VolumeStore& store, const std::string& key, glm::ivec3 dims = {20, 9, 6}) {
    StoreWriter writer(store, sampleMeta(key, dims));
    writer.addArray(0, 0, rampSamples(dims));
    writer.commit();
}

} // namespace voxsheet::store
