// Reading VTK and TIFF files through the registry, as the importer does.
#pragma once

#include "formats_fixture.h"
#include "import/child/reader_registry.h"

#include <random>

namespace voxsheet::import::testing {

inline Loaded loadAny(const fs::path& path, const ImportOptions& options = {},
                      const ImportLimits& limits = {}) {
    static const ReaderRegistry readers;
    const auto& reader = readers.choose(path, options);
    Loaded loaded{reader.readHeader(path, options, limits), {}};
    const auto sink =
        applyOptions(loaded.header, options, [&](int field, int step, std::vector<std::byte>&& voxels) {
            EXPECT_EQ(voxels.size(), loaded.header.arrayBytes(field));
            EXPECT_TRUE(loaded.arrays.emplace(std::pair(field, step), std::move(voxels)).second);
        });
    const auto notes = reader.readData(loaded.header, sink, [](double) {});
    loaded.header.meta.notes.insert(loaded.header.meta.notes.end(), notes.begin(), notes.end());
    EXPECT_EQ(loaded.arrays.size(), loaded.meta().fields.size() * loaded.meta().times.size());
    return loaded;
}

/// The sentence of the error that reading ends in; a failed test if there is none.
inline std::string sentenceOf(const fs::path& path) {
    try {
        (void)loadAny(path);
    } catch (const Error& error) {
        // The importer puts the file's name before what a grid says about itself.
        EXPECT_TRUE(error.subject() == path.string() || error.subject().starts_with("grid")) << error.what();
        return error.what();
    }
    ADD_FAILURE() << path << " was read";
    return {};
}

template <typename T>
std::string bigEndian(const std::vector<T>& values) {
    std::string bytes;
    for (const T value : values) {
        std::string one(sizeof(T), '\0');
        std::memcpy(one.data(), &value, sizeof(T));
        bytes.append(one.rbegin(), one.rend());
    }
    return bytes;
}

template <typename T>
std::string littleEndian(const std::vector<T>& values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

} // namespace voxsheet::import::testing
