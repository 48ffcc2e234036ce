#include "formats_fixture.h"

#include <cmath>

namespace voxsheet::import::testing {
namespace {

constexpr const char* kStructure = "two atoms\n 1.0\n 2 0 0\n 0 3 0\n 1 0 4\n Na Cl_pv\n 1 1\n";

std::string gridText(const glm::ivec3& dims, double first, const char* format = " %.11E") {
    std::string text =
        " " + std::to_string(dims.x) + " " + std::to_string(dims.y) + " " + std::to_string(dims.z) + "\n";
    for (int i = 0; i < dims.x * dims.y * dims.z; ++i) {
        char word[64];
        std::snprintf(word, sizeof word, format, first + i * 0.5);
        text += word;
        if (i % 5 == 4) text += '\n';
    }
    return text + "\n";
}

std::string plainFile() {
    return std::string(kStructure) + "Direct\n 0 0 0\n 0.5 0.5 0.5\n\n" + gridText({2, 3, 4}, -1.0);
}

class FormatsChgcar : public FormatsTest {};

TEST_F(FormatsChgcar, ReadsGridCellAndAtoms) {
    const auto loaded = load(write("CHGCAR_3", plainFile()));
    const auto values = loaded.values<double>();
    ASSERT_EQ(values.size(), 24U);
    for (std::size_t i = 0; i < 24; ++i)
        EXPECT_DOUBLE_EQ(values[i], -1.0 + 0.5 * static_cast<double>(i));
    const auto& meta = loaded.meta();
    EXPECT_EQ(meta.grid.dims, glm::ivec3(2, 3, 4));
    EXPECT_EQ(meta.grid.periodic, glm::bvec3(true));
    EXPECT_EQ(glm::dvec3(meta.grid.worldFromIndex[2]), glm::dvec3(0.25, 0, 1));
    EXPECT_EQ(meta.lengthUnit, "Å");
    EXPECT_DOUBLE_EQ(meta.fields[0].valueScale, 1.0 / 24.0);
    expectShearedSalt(meta);
}

TEST_F(FormatsChgcar, AtomsGoWithTheGridWhereOptionsMoveIt) {
    ImportOptions options;
    options.origin = glm::dvec3(10, 20, 30);
    options.flip = glm::bvec3(true, false, false);
    const auto path = write("CHGCAR", plainFile());
    const auto before = load(path).meta();
    const auto after = load(path, options).meta();
    for (std::size_t i = 0; i < 2; ++i) {
        const auto index = [&](const DatasetMeta& meta) {
            return glm::inverse(meta.grid.worldFromIndex) *
                   glm::dvec4(meta.crystal->atoms[i].positionWorld, 1.0);
        };
        EXPECT_LT(glm::distance(index(before), index(after)), 1e-12);
    }
    EXPECT_EQ(after.crystal->lattice[0], -before.crystal->lattice[0]);
}

TEST_F(FormatsChgcar, DecidesTheQuantityByName) {
    const auto field = [&](const std::string& name, const ImportOptions& options = {}) {
        return load(write(name, plainFile()), options).meta().fields[0];
    };
    for (const auto* name : {"CHGCAR", "NaMgF3_AECCAR0", "run.PARCHG.0001", "my_chgcar.txt"})
        EXPECT_DOUBLE_EQ(field(name).valueScale, 1.0 / 24.0) << name;
    EXPECT_EQ(field("LOCPOT").valueScale, 1.0);
    EXPECT_EQ(field("LOCPOT").unit, "eV");
    EXPECT_EQ(field("ELFCAR_up").valueScale, 1.0);
    EXPECT_EQ(field("CHGCAR").unit, "e/Å^3");
    ImportOptions whole;
    whole.divideByCellVolume = false;
    EXPECT_EQ(field("CHGCAR", whole).valueScale, 1.0);
    const auto unnamed = load(write("density.vasp", plainFile())).meta();
    EXPECT_DOUBLE_EQ(unnamed.fields[0].valueScale, 1.0 / 24.0);
    EXPECT_FALSE(unnamed.notes.empty());
}

TEST_F(FormatsChgcar, ReadsCompressedFiles) {
    EXPECT_EQ(load(write("LOCPOT.gz", gzipped(plainFile()))).values<double>()[3], 0.5);
    EXPECT_EQ(load(write("LOCPOT.bz2", bzipped(plainFile()))).values<double>()[3], 0.5);
}

TEST_F(FormatsChgcar, ReadsSpinGridsBehindAugmentation) {
    const std::string augmentation =
        "augmentation occupancies   1   4\n  0.1E+01 -0.2E+00  0.3E-05  0.4E+00\n"
        "augmentation occupancies (imaginary part)   2   2\n  0.1E+01 -0.2E+00\n  0.5 0.5\n";
    const auto spin =
        load(write("CHGCAR", plainFile() + augmentation + gridText({2, 3, 4}, 7.0) + augmentation));
    ASSERT_EQ(spin.meta().fields.size(), 2U);
    EXPECT_EQ(spin.meta().fields[1].name, "magnetization");
    EXPECT_EQ(spin.values<double>(1)[1], 7.5);
    const auto once = gridText({2, 3, 4}, 1.0);
    const auto four = load(write("CHGCAR", plainFile() + once + once + gridText({2, 3, 4}, 9.0)));
    ASSERT_EQ(four.meta().fields.size(), 4U);
    EXPECT_EQ(four.meta().fields[3].name, "magnetization z");
    EXPECT_EQ(four.values<double>(3)[0], 9.0);
    const auto frames = load(write("CHG", plainFile() + plainFile()));
    EXPECT_EQ(frames.meta().fields.size(), 1U);
    ASSERT_FALSE(frames.meta().notes.empty());
    expectMentions(frames.meta().notes.back(), "frames");
}

TEST_F(FormatsChgcar, ReadsOldHeadersScalesAndCartesianAtoms) {
    const auto grid = gridText({2, 3, 4}, 0.0);
    const auto read = [&](const std::string& structure) {
        return load(write("CHGCAR", structure + "\n" + grid)).meta();
    };
    const auto vasp4 = read("Na Cl\n 2.0\n 1 0 0\n 0 1 0\n 0 0 1\n 1 1\nCartesian\n 0.5 0 0\n 0 0.5 0\n");
    EXPECT_EQ(vasp4.crystal->atoms[1].atomicNumber, 17);
    EXPECT_EQ(vasp4.crystal->atoms[0].positionWorld, glm::dvec3(1, 0, 0));
    EXPECT_EQ(vasp4.crystal->lattice[0], glm::dvec3(2, 0, 0));
    const auto nameless = read("something\n 2.0\n 1 0 0\n 0 1 0\n 0 0 1\n 1 1\nDirect\n 0.5 0 0\n 0 0.5 0\n");
    EXPECT_EQ(nameless.crystal->atoms[0].atomicNumber, 0);
    const auto volume =
        read("x\n -64\n 1 0 0\n 0 1 0\n 0 0 1\nH\n 1\nSelective dynamics\nDirect\n 0.5 0 0 T F T\n");
    EXPECT_NEAR(volume.crystal->lattice[1].y, 4.0, 1e-12);
    EXPECT_NEAR(volume.crystal->atoms[0].positionWorld.x, 2.0, 1e-12);
    const auto three = read("x\n 1 2 3\n 1 0 0\n 0 1 0\n 0 0 1\nH\n 1\nDirect\n 0.5 0.5 0.5\n");
    EXPECT_EQ(three.crystal->atoms[0].positionWorld, glm::dvec3(0.5, 1, 1.5));
}

TEST_F(FormatsChgcar, ReadsFortranNumbers) {
    auto text =
        std::string(kStructure) + "Direct\n 0 0 0\n 0.5 0.5 0.5\n\n 2 1 2\n .5D+01 -.25E+00 0.1-100 1.5\n";
    const auto values = load(write("LOCPOT", text)).values<double>();
    EXPECT_EQ(values[0], 5.0);
    EXPECT_EQ(values[1], -0.25);
    EXPECT_DOUBLE_EQ(values[2], 0.1e-100);
}

TEST_F(FormatsChgcar, FindsGridsOfLargeFilesWhateverTheirLines) {
    // Large enough that the header phase passes over equal lines unread.
    const glm::ivec3 dims(128, 100, 80);
    const auto head = std::string(kStructure) + "Direct\n 0 0 0\n 0.5 0.5 0.5\n\n";
    const auto equal = gridText(dims, 0.0, " %.1E");
    auto uneven = equal;
    uneven.insert(uneven.find('\n', uneven.size() / 2), "  ");
    for (const auto& grid : {equal, uneven}) {
        const auto path = write("LOCPOT", head + grid + " 0.5 0.5\n" + gridText(dims, 4.0, " %.1E"));
        const auto loaded = load(path);
        ASSERT_EQ(loaded.meta().fields.size(), 2U);
        EXPECT_EQ(loaded.values<double>(1)[0], 4.0);
        expectMentions(loadError(write("LOCPOT", head + grid.substr(0, grid.size() - 10))),
                       "the file ends after 1023999");
        expectMentions(loadError(write("LOCPOT", head + grid.substr(0, grid.size() / 2))),
                       "needs 1024000 values");
    }
}

TEST_F(FormatsChgcar, RefusesWrongFiles) {
    const auto good = plainFile();
    const auto replaced = [&](const std::string& from, const std::string& to) {
        auto text = good;
        const auto at = text.find(from);
        EXPECT_NE(at, std::string::npos);
        return loadError(write("CHGCAR", text.replace(at, from.size(), to)));
    };
    for (const std::string scale : {" 0.0\n", " nan\n", " x\n", " 1 2\n", " 1 -1 1\n", " 1e400\n"})
        EXPECT_FALSE(replaced(" 1.0\n", scale).empty()) << scale;
    for (const std::string vector : {" 2 0\n", " 0 0 0\n", " inf 0 0\n", " 0 3 0\n"})
        EXPECT_FALSE(replaced(" 2 0 0\n", vector).empty()) << vector;
    for (const std::string counts :
         {" 1 -1\n", " 1\n", " 1 1 1\n", " 1 999999999999\n", " 1 1e3\n", "\n", " 1 3\n"})
        EXPECT_FALSE(replaced(" 1 1\n", counts).empty()) << counts;
    for (const std::string dims :
         {" 2 3 5\n", " 0 3 4\n", " -2 3 4\n", " 2 3\n", " 99999 99999 99999\n", " 9999999999 3 4\n", "\n"})
        EXPECT_FALSE(replaced(" 2 3 4\n", dims).empty()) << dims;
    EXPECT_FALSE(replaced("Direct", "Upside down").empty());
    expectMentions(replaced("-5.00000000000E-01", "******************"), "'******************'");
    expectMentions(loadError(write("CHGCAR", good.substr(0, good.find(" 2 3 4\n")))), "no grid");
    expectMentions(loadError(write("CHGCAR", good.substr(0, good.size() - 30))), "24 values");
}

} // namespace
} // namespace voxsheet::import::testing
