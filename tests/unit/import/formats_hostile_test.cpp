// Damaged and hostile files of every format: the right voxels or an Error, never anything else.
#include "formats_fixture.h"
#include "nifti_bytes.h"
#include "sample_files.h"

#include <random>

namespace voxsheet::import::testing {
namespace {

/// Loads, allowing at most 64 MiB; nothing but an Error may come out. True when the file was read.
bool survives(const fs::path& path) {
    ImportLimits limits;
    limits.maxBytes = 64ULL << 20;
    try {
        (void)load(path, {}, limits); // checks the sizes of what it gets
        return true;
    } catch (const Error& error) {
        EXPECT_FALSE(error.subject().empty());
        EXPECT_FALSE(error.why().empty());
        return false;
    }
}

class FormatsHostile : public FormatsTest {};

TEST_F(FormatsHostile, SamplesAreGood) {
    for (const auto& sample : volumeSamples())
        EXPECT_TRUE(survives(write(sample.name, sample.bytes))) << sample.name;
}

TEST_F(FormatsHostile, TruncatedAnywhereIsAnError) {
    constexpr std::size_t offsets = 16;
    for (const auto& sample : volumeSamples())
        for (std::size_t cut = 0; cut < offsets; ++cut) {
            const auto length = (sample.bytes.size() - sample.mayMiss) * cut / offsets;
            EXPECT_FALSE(survives(write(sample.name, sample.bytes.substr(0, length))))
                << sample.name << " at " << length;
        }
    for (const auto& sample : volumeSamples()) {
        const auto length = sample.bytes.size() - sample.mayMiss - 1;
        EXPECT_FALSE(survives(write(sample.name, sample.bytes.substr(0, length))))
            << sample.name << " at " << length;
    }
}

TEST_F(FormatsHostile, MutatedFilesNeverCrash) {
    constexpr int rounds = 400;
    std::mt19937 random(20240607);
    const auto below = [&](std::size_t limit) { return static_cast<std::size_t>(random() % limit); };
    static const std::vector<std::string> splinters{
        "-1",       "0",     "99999999999", "nan",      "\n\n",      "LIST", ":", "=", std::string(3, '\0'),
        "\xff\xff", "1e308", "(",           "%d 1 9 1", "2147483647"};
    int read = 0;
    int refused = 0;
    for (const auto& sample : volumeSamples()) {
        const auto header = std::min<std::size_t>(sample.bytes.size(), 400);
        for (int round = 0; round < rounds; ++round) {
            auto bytes = sample.bytes;
            const auto changes = 1 + below(3);
            for (std::size_t change = 0; change < changes; ++change) {
                const auto at = below(random() % 4 == 0 ? bytes.size() : header);
                switch (random() % 4) {
                case 0:
                    bytes[at] = static_cast<char>(random());
                    break;
                case 1:
                    bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
                    break;
                case 2:
                    bytes.erase(at, 1 + below(8));
                    break;
                default:
                    bytes.insert(at, splinters[below(splinters.size())]);
                }
            }
            survives(write(sample.name, bytes)) ? ++read : ++refused;
        }
    }
    // Both happen: the mutations are neither all harmless nor all fatal.
    EXPECT_GT(read, 100);
    EXPECT_GT(refused, 100);
}

TEST_F(FormatsHostile, RandomBytesAreNoVolume) {
    std::mt19937 random(7);
    for (const auto* name :
         {"x.nrrd", "x.mha", "x.nii", "x.nii.gz", "CHGCAR", "x.cube", "x.xsf", "x.raw", "x.json", "x"}) {
        std::string bytes(2000, '\0');
        for (auto& byte : bytes)
            byte = static_cast<char>(random());
        EXPECT_FALSE(survives(write(name, bytes))) << name;
        EXPECT_FALSE(survives(write(name, std::string(2000, '\n')))) << name;
        EXPECT_FALSE(survives(write(name, std::string(2000, '\0')))) << name;
    }
}

TEST_F(FormatsHostile, LyingSizesAreRefusedInTheHeaderPhase) {
    // Each promises gigabytes; nothing is allocated, as the header phase already compares with the file.
    NiftiBytes nifti(1, false, {1000, 1000, 1000}, 64);
    const std::vector<std::pair<std::string, std::string>> liars{
        {"a.nrrd",
         "NRRD0004\ntype: double\ndimension: 3\nsizes: 1000 1000 1000\nendian: little\nencoding: raw\n\nabc"},
        {"b.nrrd", "NRRD0004\ntype: double\ndimension: 3\nsizes: 1000 1000 1000\nencoding: ascii\n\n1 2 3"},
        {"c.nrrd",
         "NRRD0004\ntype: double\ndimension: 3\nsizes: 1000 1000 1000\nendian: little\nencoding: gzip\n\n" +
             gzipped("abc")},
        {"d.mha",
         "NDims = 3\nDimSize = 1000 1000 1000\nElementType = MET_DOUBLE\nElementDataFile = LOCAL\nabc"},
        {"e.nii", nifti.with("abc")},
        {"f.nii.gz", gzipped(nifti.with("abc"))},
        {"h.xsf",
         "BEGIN_BLOCK_DATAGRID_3D\nx\nBEGIN_DATAGRID_3D\n1000 1000 1000\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"},
        {"g.cube", "x\ny\n0 0 0 0\n1000 1 0 0\n1000 0 1 0\n1000 0 0 1\n1 2 3\n"},
        {"CHGCAR", "x\n1\n1 0 0\n0 1 0\n0 0 1\nH\n1\nDirect\n0 0 0\n\n1000 1000 1000\n1 2 3\n"},
    };
    for (const auto& [name, bytes] : liars) {
        const auto path = write(name, bytes);
        const auto head = readFileHead(path);
        for (const auto& reader : makeOwnReaders()) {
            if (!reader->recognises(head, {})) continue;
            EXPECT_THROW((void)reader->readHeader(path, {}, {}), InvalidInput) << name;
            break;
        }
    }
}

} // namespace
} // namespace voxsheet::import::testing
