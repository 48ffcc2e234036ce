// Importer processes for tests: the real one, and scripts in its place.
#pragma once

#include "base/errors.h"
#include "fields/patience.h"
#include "import/import_client.h"
#include "store/volume_store.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace voxsheet::import {

class ProcessTest : public ::testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (std::filesystem::temp_directory_path() / "voxsheet-import-XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
        settings_.executable = std::filesystem::path(VOXSHEET_BINARY_DIR) / "voxsheet-import";
        settings_.storeFolder = folder_ / "store";
        ASSERT_TRUE(std::filesystem::exists(settings_.executable)) << "voxsheet-import is not built";
    }
    void TearDown() override {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }

    [[nodiscard]] std::filesystem::path write(const std::string& name, const std::string& contents) const {
        const auto path = folder_ / name;
        std::ofstream(path, std::ios::binary) << contents;
        return path;
    }

    /// 4 x 3 x 2 samples of u8, valued 0 .. 23.
    [[nodiscard]] std::filesystem::path smallVolume(const std::string& name = "small.nrrd") const {
        std::string text = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 3 2\nencoding: raw\n\n";
        for (char i = 0; i < 24; ++i)
            text += i;
        return write(name, text);
    }

    /// A volume of zeros that takes a while, without taking disk.
    [[nodiscard]] std::filesystem::path largeVolume(int edge) const {
        const auto n = std::to_string(edge);
        const auto path =
            write("large.nrrd", "NRRD0004\ntype: float\nendian: little\ndimension: 3\nsizes: " + n + " " + n +
                                    " " + n + "\nencoding: raw\n\n");
        const auto header = std::filesystem::file_size(path);
        std::filesystem::resize_file(path, header + static_cast<std::uintmax_t>(edge) *
                                                        static_cast<std::uintmax_t>(edge) *
                                                        static_cast<std::uintmax_t>(edge) * 4);
        return path;
    }

    /// A shell script that runs in the importer's place.
    void replaceImporter(const std::string& script) {
        settings_.executable = write("importer.sh", "#!/bin/sh\n" + script + "\n");
        std::filesystem::permissions(settings_.executable, std::filesystem::perms::owner_all);
    }

    [[nodiscard]] std::string import(const std::filesystem::path& file,
                                     const nlohmann::json& options = nlohmann::json::object()) const {
        return runImport(settings_, {{file}, options}).key;
    }

    /// Runs the import, expects an error of the kind within `seconds`, and returns its sentence.
    std::string failure(const std::filesystem::path& file, ErrorKind kind, double seconds = 2.0,
                        const nlohmann::json& options = nlohmann::json::object()) const {
        const auto start = std::chrono::steady_clock::now();
        try {
            (void)import(file, options);
        } catch (const Error& error) {
            const double took =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            EXPECT_EQ(errorKindName(error.kind()), std::string(errorKindName(kind))) << error.what();
            EXPECT_LT(took, seconds * fields::patience()) << error.what();
            return error.what();
        }
        ADD_FAILURE() << file << " was imported";
        return {};
    }

    std::filesystem::path folder_;
    ImporterSettings settings_;
};

} // namespace voxsheet::import
