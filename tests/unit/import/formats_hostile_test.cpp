// Damaged and hostile files of every format: the right voxels or an Error, never anything else.
#include "formats_fixture.h"
#include "nifti_bytes.h"

#include <random>

namespace voxsheet::import::testing {
namespace {

struct Sample {
    std::string name;
    std::string bytes;
    std::size_t mayMiss = 0; ///< bytes at the end that carry no voxels
};

/// One self-contained file for each way of storing voxels.
std::vector<Sample> samples() {
    const auto values = ramp<short>(5 * 6 * 7);
    const auto raw = bytesOf(values);
    std::vector<Sample> result;
    const std::string nrrd =
        "NRRD0005\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 5 6 7\n"
        "space directions: (1,0,0) (0,2,0) (0,0.5,3)\nkinds: domain domain domain\nendian: little\n"
        "space origin: (1,2,3)\nencoding: ";
    std::string text;
    for (const auto value : values)
        text += std::to_string(value) + "\n";
    std::string hex;
    for (const char byte : raw) {
        char digits[3];
        std::snprintf(digits, sizeof digits, "%02x", static_cast<unsigned>(static_cast<unsigned char>(byte)));
        hex += digits;
    }
    result.push_back({"raw.nrrd", nrrd + "raw\n\n" + raw});
    result.push_back({"gzip.nrrd", nrrd + "gzip\n\n" + gzipped(raw)});
    result.push_back({"bzip2.nrrd", nrrd + "bzip2\n\n" + bzipped(raw)});
    result.push_back(
        {"ascii.nrrd", nrrd + "ascii\n\n" + text, 6}); // a shortened last number is still a number
    result.push_back({"hex.nrrd", nrrd + "hex\n\n" + hex});

    const std::string meta =
        "ObjectType = Image\nNDims = 3\nDimSize = 5 6 7\nElementSpacing = 1 2 3\nOffset = 4 5 6\n"
        "TransformMatrix = 1 0 0 0 1 0 0 0 1\nElementType = MET_SHORT\n";
    result.push_back({"raw.mha", meta + "ElementDataFile = LOCAL\n" + raw});
    result.push_back({"zlib.mha", meta + "CompressedData = True\nElementDataFile = LOCAL\n" + zlibbed(raw)});

    for (const int version : {1, 2}) {
        NiftiBytes header(version, version == 2, {5, 6, 7}, 4);
        header.setSform({1, 0, 0, 4, 0, 2, 0, 5, 0, 0, 3, 6});
        const auto file = header.with(bytesOf(values, version == 2));
        result.push_back({"v" + std::to_string(version) + ".nii", file});
        result.push_back({"v" + std::to_string(version) + ".nii.gz", gzipped(file)});
    }

    std::string chgcar =
        "NaCl\n 1.0\n 2 0 0\n 0 3 0\n 1 0 4\n Na Cl\n 1 1\nDirect\n 0 0 0\n 0.5 0.5 0.5\n\n 5 6 7\n";
    for (std::size_t i = 0; i < values.size(); ++i) {
        char word[32];
        std::snprintf(word, sizeof word, " %18.11E%s", static_cast<double>(values[i]) / 7.0,
                      i % 5 == 4 ? "\n" : "");
        chgcar += word;
    }
    result.push_back({"CHGCAR", chgcar, 1});
    result.push_back({"LOCPOT.gz", gzipped(chgcar)});

    std::string xsf =
        "CRYSTAL\nPRIMVEC\n 2 0 0\n 0 3 0\n 1 0 4\nPRIMCOORD\n 2 1\n 11 0 0 0\n Cl 1 1 1\n"
        "BEGIN_BLOCK_DATAGRID_3D\nrho\nBEGIN_DATAGRID_3D_rho\n 5 6 7\n 0 0 0\n 2 0 0\n 0 3 0\n 1 0 4\n";
    for (const auto value : values)
        xsf += " " + std::to_string(value) + "\n";
    xsf += "END_DATAGRID_3D\nEND_BLOCK_DATAGRID_3D\n";
    result.push_back({"salt.xsf", xsf, 4}); // "_3D" and a line end
    result.push_back({"salt.xsf.gz", gzipped(xsf)});

    std::string cube =
        "salt\ndensity\n   -2 0 0 0\n 5 1 0 0\n 6 0 1 0\n -7 0.1 0 1\n 11 11 0 0 0\n 17 17 1 1 1\n"
        "   2   4   5\n";
    for (const auto value : values)
        for (const double factor : {1.0, 0.5}) {
            char word[32];
            std::snprintf(word, sizeof word, " %13.5E", factor * value);
            cube += word;
            cube += factor < 1.0 ? "\n" : "";
        }
    result.push_back({"salt.cube", cube, 1});
    result.push_back({"salt.cube.gz", gzipped(cube)});
    return result;
}

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
    for (const auto& sample : samples())
        EXPECT_TRUE(survives(write(sample.name, sample.bytes))) << sample.name;
}

TEST_F(FormatsHostile, TruncatedAnywhereIsAnError) {
    constexpr std::size_t offsets = 16;
    for (const auto& sample : samples())
        for (std::size_t cut = 0; cut < offsets; ++cut) {
            const auto length = (sample.bytes.size() - sample.mayMiss) * cut / offsets;
            EXPECT_FALSE(survives(write(sample.name, sample.bytes.substr(0, length))))
                << sample.name << " at " << length;
        }
    for (const auto& sample : samples()) {
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
    for (const auto& sample : samples()) {
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
    const std::vector<Sample> liars{
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
    for (const auto& liar : liars) {
        const auto path = write(liar.name, liar.bytes);
        const auto head = readFileHead(path);
        for (const auto& reader : makeOwnReaders()) {
            if (!reader->recognises(head, {})) continue;
            EXPECT_THROW((void)reader->readHeader(path, {}, {}), InvalidInput) << liar.name;
            break;
        }
    }
}

} // namespace
} // namespace voxsheet::import::testing
