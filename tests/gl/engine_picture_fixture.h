// The engine with a renderer over folders of its own.
#pragma once

#include "base/errors.h"
#include "engine/engine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>

#include <unistd.h>

namespace voxsheet::engine {

namespace fs = std::filesystem;

class EnginePicture : public testing::Test {
protected:
    void SetUp() override {
        const fs::path importer = fs::path(VOXSHEET_BINARY_DIR) / "voxsheet-import";
        if (!fs::exists(importer)) GTEST_SKIP() << "voxsheet-import is not built";
        fs::create_directories(folder);
        EngineOptions options;
        options.storeDir = folder / "store";
        options.uploadDir = folder / "uploads";
        options.roots = {folder};
        options.importer = importer;
        try {
            engine = std::make_unique<Engine>(options);
        } catch (const GpuError& error) {
            GTEST_SKIP() << error.what();
        }
    }
    void TearDown() override {
        engine.reset();
        std::error_code ignored;
        fs::remove_all(folder, ignored);
    }

    /// A ball of 200 in a box of 0, `edge` samples wide.
    fs::path ball(const std::string& name, int edge) const {
        std::string voxels;
        for (int k = 0; k < edge; ++k)
            for (int j = 0; j < edge; ++j)
                for (int i = 0; i < edge; ++i) {
                    const double r = std::hypot(i - edge / 2, j - edge / 2, k - edge / 2);
                    voxels += r < edge * 0.35 ? static_cast<char>(200) : '\0';
                }
        const fs::path file = folder / name;
        std::ofstream(file, std::ios::binary) << "NRRD0004\ntype: uchar\ndimension: 3\nsizes: " << edge << " "
                                              << edge << " " << edge << "\nencoding: raw\n\n"
                                              << voxels;
        return file;
    }

    void open(const std::vector<fs::path>& files) {
        std::vector<ImportRequest> requests;
        for (const fs::path& file : files) {
            requests.emplace_back();
            requests.back().files = {file};
        }
        engine->importDatasets(requests);
        ASSERT_TRUE(engine->waitIdle(60));
    }

    static const unsigned char* pixel(const TilePixels& picture, int x, int y) {
        return picture.rgba8.data() +
               (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.size.x) +
                static_cast<std::size_t>(x)) *
                   4;
    }

    fs::path folder = fs::temp_directory_path() / ("voxsheet-picture-" + std::to_string(::getpid()));
    std::unique_ptr<Engine> engine;
};

} // namespace voxsheet::engine
