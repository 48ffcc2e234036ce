// An engine without a renderer over folders of its own, and files to open in it.
#pragma once

#include "base/errors.h"
#include "engine/engine.h"
#include "engine/shown_volumes.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <sstream>
#include <thread>

namespace voxsheet::engine {

namespace fs = std::filesystem;

class EngineTest : public testing::Test {
protected:
    void SetUp() override {
        importer = fs::path(VOXSHEET_BINARY_DIR) / "voxsheet-import";
        if (!fs::exists(importer)) GTEST_SKIP() << "voxsheet-import is not built";
        fs::create_directories(data);
    }

    EngineOptions options() const {
        EngineOptions options;
        options.storeDir = folder.path() / "store";
        options.uploadDir = folder.path() / "uploads";
        options.roots = {data};
        options.importer = importer;
        options.render = false;
        return options;
    }

    /// An NRRD of bytes, all `value`.
    fs::path volume(const std::string& name, glm::ivec3 dims, unsigned char value) const {
        const fs::path file = data / name;
        fs::create_directories(file.parent_path());
        std::ofstream stream(file, std::ios::binary);
        stream << "NRRD0004\ntype: uchar\ndimension: 3\nsizes: " << dims.x << " " << dims.y << " " << dims.z
               << "\nspacings: 1 1 1\nencoding: raw\n\n"
               << std::string(static_cast<std::size_t>(dims.x * dims.y * dims.z), static_cast<char>(value));
        return file;
    }

    static ImportRequest request(const fs::path& file) {
        ImportRequest request;
        request.files = {file};
        return request;
    }

    static CellStatus status(const Engine& engine, const std::string& cell) {
        for (const CellStatus& each : engine.cellStatuses(*engine.snapshot(), "")) {
            if (sheet::addressName(each.cell) == cell) return each;
        }
        return {};
    }

    static void setSource(Engine& engine, const std::string& cell, const std::string& source) {
        engine.apply(
            sheet::SetSource{engine.snapshot()->sheets.front().name, sheet::parseAddress(cell), source});
    }

    test::TemporaryFolder folder;
    fs::path data = folder.path() / "data";
    fs::path importer;
};

} // namespace voxsheet::engine
