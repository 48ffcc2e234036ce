// Files written on the spot, and a short way to read one back through the readers.
#pragma once

#include "base/errors.h"
#include "import/formats/own_readers.h"

#include <gtest/gtest.h>

#include <bzlib.h>
#include <zlib.h>

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

template <typename T>
std::string bytesOf(const std::vector<T>& values, bool bigEndian = false) {
    std::string bytes(values.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    if (bigEndian)
        for (std::size_t at = 0; at < bytes.size(); at += sizeof(T))
            std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                         bytes.begin() + static_cast<std::ptrdiff_t>(at + sizeof(T)));
    return bytes;
}

/// Values that differ in every byte, from the whole range of the type.
template <typename T>
std::vector<T> ramp(std::size_t count) {
    std::vector<T> values(count);
    for (std::size_t i = 0; i < count; ++i) {
        if constexpr (std::is_floating_point_v<T>)
            values[i] = static_cast<T>(static_cast<double>(i) * 1.25 - 7.0);
        else
            values[i] = static_cast<T>(i * 0x9E3779B97F4A7C15ULL >> (64 - 8 * sizeof(T)));
    }
    return values;
}

inline std::string deflated(std::string_view bytes, int windowBits) {
    z_stream stream{};
    EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, windowBits, 8, Z_DEFAULT_STRATEGY), Z_OK);
    std::string out(deflateBound(&stream, static_cast<uLong>(bytes.size())) + 64, '\0');
    std::string in(bytes);
    stream.next_in = reinterpret_cast<Bytef*>(in.data());
    stream.avail_in = static_cast<uInt>(in.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}
inline std::string gzipped(std::string_view bytes) { return deflated(bytes, 15 + 16); }
inline std::string zlibbed(std::string_view bytes) { return deflated(bytes, 15); }

inline std::string bzipped(std::string_view bytes) {
    std::string in(bytes);
    auto size = static_cast<unsigned>(in.size() + in.size() / 50 + 1024);
    std::string out(size, '\0');
    EXPECT_EQ(
        BZ2_bzBuffToBuffCompress(out.data(), &size, in.data(), static_cast<unsigned>(in.size()), 9, 0, 0),
        BZ_OK);
    out.resize(size);
    return out;
}

} // namespace voxsheet::import::testing
