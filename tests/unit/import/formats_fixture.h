// Files written on the spot, and a short way to read one back through the readers.
#pragma once

#include "base/errors.h"
#include "import/formats/own_readers.h"
#include "packed_bytes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace voxsheet::import::testing {

namespace fs = std::filesystem;

class FormatsTest : public ::testing::Test {
protected:
    void SetUp() override {
        auto pattern = (fs::temp_directory_path() / "voxsheet-formats-XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
    }
    void TearDown() override { fs::remove_all(folder_); }

    fs::path write(const std::string& name, std::string_view bytes) const {
        const auto path = folder_ / name;
        fs::create_directories(path.parent_path());
        std::ofstream out(path, std::ios::binary);
        out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        return path;
    }

    fs::path folder_;
};

struct Loaded {
    SourceHeader header;
    std::map<std::pair<int, int>, std::vector<std::byte>> arrays; ///< by field and step

    [[nodiscard]] const DatasetMeta& meta() const { return header.meta; }

    template <typename T>
    [[nodiscard]] std::vector<T> values(int field = 0, int step = 0) const {
        const auto& bytes = arrays.at({field, step});
        std::vector<T> result(bytes.size() / sizeof(T));
        std::memcpy(result.data(), bytes.data(), bytes.size());
        return result;
    }
};

/// Recognises, reads and checks that every array came once and has its size. Throws what the readers throw.
inline Loaded load(const fs::path& path, const ImportOptions& options = {}, const ImportLimits& limits = {}) {
    const auto head = readFileHead(path);
    for (const auto& reader : makeOwnReaders()) {
        if (!reader->recognises(head, options)) continue;
        Loaded loaded{reader->readHeader(path, options, limits), {}};
        double last = 0.0;
        const auto progress = [&](double fraction) {
            EXPECT_GE(fraction, last);
            EXPECT_LE(fraction, 1.0);
            last = fraction;
        };
        const auto sink =
            applyOptions(loaded.header, options, [&](int field, int step, std::vector<std::byte>&& voxels) {
                EXPECT_EQ(voxels.size(), loaded.header.arrayBytes(field));
                EXPECT_TRUE(loaded.arrays.emplace(std::pair(field, step), std::move(voxels)).second);
            });
        (void)reader->readData(loaded.header, sink, progress);
        EXPECT_EQ(loaded.arrays.size(), loaded.meta().fields.size() * loaded.meta().times.size());
        return loaded;
    }
    throw InvalidInput(path.string(), "no reader recognises it");
}

/// The message of the Error that load() throws; a failure if it throws none.
inline std::string loadError(const fs::path& path, const ImportOptions& options = {},
                             const ImportLimits& limits = {}) {
    try {
        (void)load(path, options, limits);
    } catch (const Error& error) {
        return error.what();
    }
    ADD_FAILURE() << path << " was read without an error";
    return {};
}

inline void expectMentions(const std::string& text, const std::string& words) {
    EXPECT_NE(text.find(words), std::string::npos) << "expected '" << words << "' in: " << text;
}

/// The crystal of the small files that tests of crystal formats write: Na at the origin, Cl beside it, in a
/// cell whose last vector leans.
inline void expectShearedSalt(const DatasetMeta& meta) {
    ASSERT_TRUE(meta.crystal);
    EXPECT_EQ(meta.crystal->lattice[2], glm::dvec3(1, 0, 4));
    ASSERT_EQ(meta.crystal->atoms.size(), 2U);
    EXPECT_EQ(meta.crystal->atoms[0].atomicNumber, 11);
    EXPECT_EQ(meta.crystal->atoms[1].atomicNumber, 17);
    EXPECT_EQ(meta.crystal->atoms[1].positionWorld, glm::dvec3(1.5, 1.5, 2));
}

} // namespace voxsheet::import::testing
