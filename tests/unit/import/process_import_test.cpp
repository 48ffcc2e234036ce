// The real importer process: good files, bad files, cancelling, being killed.
#include "process_fixture.h"

#include <atomic>
#include <csignal>
#include <fcntl.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace voxsheet::import {
namespace {

namespace fs = std::filesystem;

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// Children of this process, by the kernel's list.
std::vector<pid_t> children() {
    std::vector<pid_t> all;
    for (const auto& task : fs::directory_iterator("/proc/self/task")) {
        std::ifstream list(task.path() / "children");
        for (pid_t child = 0; list >> child;)
            all.push_back(child);
    }
    return all;
}

using ProcessImport = ProcessTest;

TEST_F(ProcessImport, FillsTheStore) {
    double last = -1.0;
    const auto result = runImport(settings_, {{smallVolume()}, {}}, [&](double fraction) {
        EXPECT_GE(fraction, last);
        last = fraction;
    });
    EXPECT_EQ(last, 1.0);
    const store::VolumeStore store(settings_.storeFolder);
    const auto entry = store.open(result.key);
    ASSERT_NE(entry, nullptr);
    EXPECT_EQ(entry->meta()->grid.dims, glm::ivec3(4, 3, 2));
    EXPECT_EQ(entry->meta()->fields[0].steps[0].statistics.max, 23.0);
    EXPECT_EQ(entry->readValue({result.key, 0, 0, 0}, {3, 2, 1}), 23.0);
    EXPECT_TRUE(children().empty());
}

TEST_F(ProcessImport, KeyFollowsFileAndOptions) {
    const auto file = smallVolume();
    const auto key = import(file);
    EXPECT_EQ(import(file), key) << "from the store";
    EXPECT_EQ(import(file, {{"flip", nullptr}}), key) << "an option that is not set";
    const auto spaced = import(file, {{"spacing", {1.0, 1.0, 2.5}}});
    EXPECT_NE(spaced, key);
    EXPECT_DOUBLE_EQ(spacingWorld(store::VolumeStore(settings_.storeFolder).open(spaced)->meta()->grid).z,
                     2.5);
    const std::array<struct timespec, 2> times{{{5, 0}, {5, 0}}};
    ASSERT_EQ(::utimensat(AT_FDCWD, file.c_str(), times.data(), 0), 0);
    EXPECT_NE(import(file), key) << "modified";
}

TEST_F(ProcessImport, ADamagedEntryIsMadeAgain) {
    const auto file = smallVolume();
    const auto key = import(file);
    fs::resize_file(settings_.storeFolder / key / "f0_s0.raw", 5);
    EXPECT_EQ(import(file), key);
    EXPECT_NE(store::VolumeStore(settings_.storeFolder).open(key), nullptr);
}

TEST_F(ProcessImport, ManyAtOnceOfOneFileAgree) {
    const auto file = smallVolume();
    std::vector<std::string> keys(6);
    {
        std::vector<std::jthread> threads;
        for (auto& key : keys)
            threads.emplace_back([&] { key = import(file); });
    }
    for (const auto& key : keys)
        EXPECT_EQ(key, keys[0]);
    const store::VolumeStore store(settings_.storeFolder);
    EXPECT_NE(store.open(keys[0]), nullptr);
    EXPECT_EQ(std::distance(fs::directory_iterator(settings_.storeFolder), fs::directory_iterator()), 1);
}

TEST_F(ProcessImport, PreviewsReadNoVoxels) {
    const auto preview = previewFile(settings_, smallVolume());
    EXPECT_EQ(preview.meta.format, "nrrd");
    EXPECT_EQ(preview.meta.grid.dims, glm::ivec3(4, 3, 2));
    EXPECT_EQ(preview.meta.sourceType, ScalarType::U8);
    EXPECT_EQ(preview.voxelBytes, 24U);
    ASSERT_EQ(preview.files.size(), 1U);
    EXPECT_FALSE(fs::exists(settings_.storeFolder));
    EXPECT_THROW((void)previewFile(settings_, folder_ / "absent"), NotFound);
}

TEST_F(ProcessImport, PreviewsOfManyFilesKeepTheirOrder) {
    const auto good = smallVolume();
    const auto bad = write("bad.nrrd", "NRRD0004\ntype: uint8\n");
    const auto previews = previewFiles(settings_, {good, bad, folder_ / "absent", good});
    ASSERT_EQ(previews.size(), 4U);
    EXPECT_TRUE(std::holds_alternative<FilePreview>(previews[0]));
    EXPECT_THROW(std::rethrow_exception(std::get<std::exception_ptr>(previews[1])), InvalidInput);
    EXPECT_THROW(std::rethrow_exception(std::get<std::exception_ptr>(previews[2])), NotFound);
    EXPECT_TRUE(std::holds_alternative<FilePreview>(previews[3]));
}

TEST_F(ProcessImport, WhatIsNoFileIsNamedAsSuch) {
    EXPECT_TRUE(contains(failure(folder_ / "absent.nrrd", ErrorKind::NotFound), "absent.nrrd"));
    EXPECT_TRUE(contains(failure(folder_, ErrorKind::InvalidInput), "folder"));
    const auto pipe = folder_ / "pipe.nrrd";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    failure(pipe, ErrorKind::InvalidInput);
    failure("/dev/zero", ErrorKind::InvalidInput);
    failure(write("empty.nrrd", ""), ErrorKind::InvalidInput);
    if (::geteuid() != 0) {
        const auto closed = smallVolume("closed.nrrd");
        fs::permissions(closed, fs::perms::none);
        failure(closed, ErrorKind::IoError);
    }
}

TEST_F(ProcessImport, UnknownContentListsTheFormats) {
    const auto text =
        failure(write("notes.txt", "Dear diary, there are no voxels here.\n"), ErrorKind::InvalidInput);
    EXPECT_TRUE(contains(text, "NRRD")) << text;
    EXPECT_TRUE(contains(text, "NIfTI")) << text;
    const auto png = failure(write("a.png", std::string("\x89PNG\r\n\x1a\n", 8) + std::string(100, 'x')),
                             ErrorKind::Unsupported);
    EXPECT_TRUE(contains(png, "PNG")) << png;
    const auto dicom =
        failure(write("a", std::string(128, '\0') + "DICM" + std::string(100, 'x')), ErrorKind::Unsupported);
    EXPECT_TRUE(contains(dicom, "DICOM")) << dicom;
}

TEST_F(ProcessImport, LyingAndTruncatedFilesLeaveNothing) {
    failure(write("huge.nrrd", "NRRD0004\ntype: double\nendian: little\ndimension: 3\nsizes: 60000 60000 "
                               "60000\nencoding: raw\n\nxx"),
            ErrorKind::LimitExceeded);
    failure(write("short.nrrd", "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 40 30 20\nencoding: raw\n\nxx"),
            ErrorKind::InvalidInput);
    const auto flat =
        write("flat.nrrd", "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 1 1 1\nencoding: raw\n"
                           "space dimension: 3\nspace directions: (1,0,0) (2,0,0) (0,0,1)\n\nx");
    EXPECT_TRUE(contains(failure(flat, ErrorKind::InvalidInput), "flat.nrrd"))
        << "every sentence names its file";
    const store::VolumeStore store(settings_.storeFolder);
    EXPECT_EQ(store.usedBytes(), 0U);
}

TEST_F(ProcessImport, NamesThatLookLikeOptionsAreNames) {
    const auto here = fs::current_path();
    (void)smallVolume("--help");
    fs::current_path(folder_);
    EXPECT_NO_THROW((void)import("--help"));
    fs::current_path(here);
}

TEST_F(ProcessImport, OptionsAreChecked) {
    const auto file = smallVolume();
    for (const auto& [member, value] :
         std::vector<std::pair<std::string, nlohmann::json>>{{"spacing", {1, 0, 1}},
                                                             {"spacing", {1, 1}},
                                                             {"dims", {1, 2, -3}},
                                                             {"type", "u9"},
                                                             {"flip", {1, 0, 1}},
                                                             {"periodic", "yes"},
                                                             {"endian", 3},
                                                             {"colour", 1},
                                                             {"skip_bytes", -1},
                                                             {"no_data", "x"},
                                                             {"bit_mask", 0},
                                                             {"bit_mask", -1},
                                                             {"bit_mask", 1.5},
                                                             {"bit_mask", "0x"},
                                                             {"bit_mask", "0x10000000000000000"},
                                                             {"orientation", "LP"},
                                                             {"orientation", "LPX"},
                                                             {"orientation", 3}}) {
        try {
            (void)import(file, {{member, value}});
            ADD_FAILURE() << member;
        } catch (const InvalidInput& error) {
            EXPECT_EQ(error.field(), "options." + member);
        }
    }
    EXPECT_THROW((void)import(file, nlohmann::json::array()), InvalidInput);
}

TEST_F(ProcessImport, OptionsReachTheVolume) {
    std::string bytes = "HEAD";
    for (char i = 0; i < 24; ++i)
        bytes += std::string(1, '\0') + i; // big-endian
    const auto file = write("scan.bin", bytes);
    const auto key = import(file, {{"dims", {4, 3, 2}},
                                   {"type", "u16"},
                                   {"endian", "big"},
                                   {"skip_bytes", 4},
                                   {"spacing", {0.5, 2, 3}},
                                   {"origin", {10, 20, 30}},
                                   {"flip", {false, false, true}},
                                   {"periodic", {true, false, false}},
                                   {"no_data", 7}});
    const auto entry = store::VolumeStore(settings_.storeFolder).open(key);
    ASSERT_NE(entry, nullptr);
    const auto& meta = *entry->meta();
    EXPECT_EQ(meta.sourceType, ScalarType::U16);
    EXPECT_EQ(meta.grid.dims, glm::ivec3(4, 3, 2));
    EXPECT_EQ(spacingWorld(meta.grid), glm::dvec3(0.5, 2, 3));
    EXPECT_EQ(glm::dvec3(meta.grid.worldFromIndex[3]), glm::dvec3(10, 20, 33))
        << "the last slice is the first";
    EXPECT_EQ(meta.grid.worldFromIndex[2].z, -3.0);
    EXPECT_EQ(meta.grid.periodic, glm::bvec3(true, false, false));
    ASSERT_EQ(meta.fields[0].storedType, ScalarType::F32) << "for the value that is none";
    EXPECT_EQ(meta.fields[0].steps[0].statistics.max, 23.0);
    EXPECT_EQ(meta.fields[0].steps[0].statistics.finiteCount, 23U);
}

TEST_F(ProcessImport, MoreThanTheMemoryLimitIsRefusedBeforeItIsRead) {
    settings_.memoryLimitBytes = 64 << 20;
    const auto text = failure(largeVolume(256), ErrorKind::LimitExceeded);
    EXPECT_TRUE(contains(text, "memory")) << text;
}

TEST_F(ProcessImport, CancellingEndsTheChild) {
    std::atomic<bool> cancelled{false};
    const auto start = std::chrono::steady_clock::now();
    EXPECT_THROW((void)runImport(
                     settings_, {{largeVolume(400)}, {}}, [&](double) { cancelled = true; },
                     [&] { return cancelled.load(); }),
                 Cancelled);
    EXPECT_LT(std::chrono::steady_clock::now() - start,
              std::chrono::duration<double>(10.0 * fields::patience()));
    EXPECT_TRUE(children().empty());
    const store::VolumeStore cleaned(settings_.storeFolder);
    EXPECT_TRUE(fs::is_empty(settings_.storeFolder)) << "what the killed child left behind is removed";
}

TEST_F(ProcessImport, AKilledChildIsOneFailedImport) {
    const auto file = largeVolume(400);
    try {
        (void)runImport(settings_, {{file}, {}}, [&](double) {
            for (const auto child : children())
                ::kill(child, SIGKILL);
        });
        ADD_FAILURE() << "imported though it was killed";
    } catch (const LimitExceeded& error) {
        EXPECT_EQ(error.subject(), file.string());
        EXPECT_TRUE(contains(error.what(), "signal 9")) << error.what();
    }
    EXPECT_NO_THROW((void)import(smallVolume()));
}

TEST_F(ProcessImport, AStoppedChildIsNoticed) {
    settings_.stallSeconds = 1.0;
    try {
        (void)runImport(settings_, {{largeVolume(400)}, {}}, [&](double) {
            for (const auto child : children())
                ::kill(child, SIGSTOP);
        });
        ADD_FAILURE() << "imported though it was stopped";
    } catch (const LimitExceeded& error) {
        EXPECT_TRUE(contains(error.what(), "no progress")) << error.what();
    }
    EXPECT_TRUE(children().empty());
}

TEST_F(ProcessImport, RealBadFilesEndInASentenceWithinTwoSeconds) {
    const fs::path data(VOXSHEET_DATA_DIR);
    if (!fs::exists(data)) GTEST_SKIP() << "the real data are not beside the project";
    int read = 0;
    for (const auto* folder : {"bad_lfs_pointers", "bad_nifti_fuzz"})
        for (const auto& file : fs::directory_iterator(data / folder)) {
            const auto start = std::chrono::steady_clock::now();
            try {
                const auto entry = store::VolumeStore(settings_.storeFolder).open(import(file.path()));
                // One of the fuzzed files may be read as a single voxel.
                EXPECT_TRUE(contains(file.path().string(), "bad_nifti_fuzz")) << file.path();
                ASSERT_NE(entry, nullptr);
                EXPECT_EQ(entry->meta()->grid.dims, glm::ivec3(1)) << file.path();
                EXPECT_LE(++read, 1) << file.path();
            } catch (const Error& error) {
                EXPECT_EQ(error.subject(), file.path().string());
                EXPECT_NE(error.kind(), ErrorKind::Internal) << error.what();
                EXPECT_FALSE(contains(error.what(), "crashed")) << error.what();
                EXPECT_FALSE(contains(error.what(), "\n")) << error.what();
                EXPECT_EQ(contains(folder, "lfs"), contains(error.what(), "LFS")) << error.what();
            }
            EXPECT_LT(std::chrono::steady_clock::now() - start,
                      std::chrono::duration<double>(2.0 * fields::patience()))
                << file.path();
        }
    const auto skipped = data / "odd_nrrd_pynrrd/BallBinary30x30x30_byteskip_minus_five.nhdr";
    EXPECT_TRUE(contains(failure(skipped, ErrorKind::InvalidInput), "-5"));
}

TEST_F(ProcessImport, RealFilesGiveWhatTheirReadmeSays) {
    const fs::path data(VOXSHEET_DATA_DIR);
    if (!fs::exists(data)) GTEST_SKIP() << "the real data are not beside the project";
    struct Expected {
        const char* file;
        glm::ivec3 dims;
        ScalarType type;
        double min;
        double max;
    };
    const store::VolumeStore store(settings_.storeFolder);
    for (const auto& [file, dims, type, min, max] :
         std::vector<Expected>{{"vol_headsq_quarter/quarter.nhdr", {64, 64, 93}, ScalarType::I16, 0, 3926},
                               {"vol_HeadMR/HeadMRVolume.mhd", {48, 62, 42}, ScalarType::U8, 0, 255},
                               {"vol_ironprot/ironProt.vtk", {68, 68, 68}, ScalarType::U8, 0, 255}}) {
        const auto key = import(data / file);
        const auto entry = store.open(key);
        ASSERT_NE(entry, nullptr) << file;
        const auto& meta = *entry->meta();
        EXPECT_EQ(meta.grid.dims, dims) << file;
        EXPECT_EQ(meta.sourceType, type) << file;
        const auto& statistics = meta.fields[0].steps[0].statistics;
        EXPECT_NEAR(statistics.min, min, 0.05) << file;
        EXPECT_NEAR(statistics.max, max, 0.05) << file;
    }
}

TEST_F(ProcessImport, TheCadmiumVacancyPairHasTheRangeOfItsReadme) {
    const fs::path data(VOXSHEET_DATA_DIR);
    if (!fs::exists(data)) GTEST_SKIP() << "the real data are not beside the project";
    const store::VolumeStore store(settings_.storeFolder);
    double low = 0.0;
    double high = 0.0;
    for (const auto& folder : fs::directory_iterator(data / "chg_CdTe_vacancy")) {
        const auto entry = store.open(import(folder.path() / "LOCPOT.gz"));
        ASSERT_NE(entry, nullptr);
        EXPECT_EQ(entry->meta()->grid.dims, glm::ivec3(80));
        EXPECT_EQ(entry->meta()->grid.periodic, glm::bvec3(true));
        low = std::min(low, entry->meta()->fields[0].steps[0].statistics.min);
        high = std::max(high, entry->meta()->fields[0].steps[0].statistics.max);
    }
    EXPECT_NEAR(low, -101.6, 0.05);
    EXPECT_NEAR(high, 8.05, 0.05);
}

} // namespace
} // namespace voxsheet::import
