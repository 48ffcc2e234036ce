#include "formats_fixture.h"

#include <cmath>
#include <functional>

namespace voxsheet::import::testing {
namespace {

constexpr double kBohr = 0.529177210903; // Å, CODATA 2018
constexpr double kTiny = 1e-12;          // rounding of a product

constexpr const char* kAtoms = "    8    8.000000    1.000000    2.000000    3.000000\n"
                               "    1    1.000000   -1.000000    0.500000    0.000000\n";

std::string headText(const std::string& countAndOrigin, const std::string& axes,
                     const std::string& atoms = kAtoms) {
    return "water\nelectron density\n" + countAndOrigin + "\n" + axes + atoms;
}

constexpr const char* kAxes = "    2    0.5 0.0 0.0\n    3    0.1 0.6 0.0\n    4    0.0 0.0 0.7\n";

/// In the file's order: x outermost, z, then the values of a sample fastest; rows of z end a line.
std::string dataText(const glm::ivec3& dims, const std::function<double(int, int, int, int)>& value,
                     int fields = 1, const char* format = " %13.5E") {
    std::string text;
    for (int x = 0; x < dims.x; ++x)
        for (int y = 0; y < dims.y; ++y) {
            int column = 0;
            for (int z = 0; z < dims.z; ++z)
                for (int field = 0; field < fields; ++field) {
                    if (column > 0 && column % 6 == 0) text += '\n';
                    ++column;
                    char word[64];
                    std::snprintf(word, sizeof word, format, value(x, y, z, field));
                    text += word;
                }
            text += '\n';
        }
    return text;
}

/// Tells every sample's place by its digits.
double placeValue(int x, int y, int z, int field) { return x + 10 * y + 100 * z + 1000 * field - 57.0; }

const glm::ivec3 kDims(2, 3, 4);

std::string plainFile() { return headText("    2   -1.0 2.0 -3.0", kAxes) + dataText(kDims, placeValue); }

void expectPlaces(const Loaded& loaded, int field = 0) {
    const auto values = loaded.values<double>(field);
    ASSERT_EQ(values.size(), 24U);
    std::size_t at = 0;
    for (int z = 0; z < kDims.z; ++z)
        for (int y = 0; y < kDims.y; ++y)
            for (int x = 0; x < kDims.x; ++x)
                EXPECT_EQ(values[at++], placeValue(x, y, z, field)) << x << ' ' << y << ' ' << z;
}

void expectNear(const glm::dvec3& is, const glm::dvec3& expected) {
    EXPECT_LT(glm::distance(is, expected), kTiny) << is.x << ' ' << is.y << ' ' << is.z;
}

class FormatsCube : public FormatsTest {};

TEST_F(FormatsCube, PutsTheFirstAxisFirstAndBohrIntoAngstrom) {
    const auto loaded = load(write("water.cube", plainFile()));
    expectPlaces(loaded);
    const auto& meta = loaded.meta();
    EXPECT_EQ(meta.format, "cube");
    EXPECT_EQ(meta.grid.dims, kDims);
    EXPECT_EQ(meta.grid.periodic, glm::bvec3(false));
    EXPECT_EQ(meta.lengthUnit, "Å");
    EXPECT_EQ(meta.fields[0].name, "value");
    expectNear(glm::dvec3(meta.grid.worldFromIndex[0]), kBohr * glm::dvec3(0.5, 0, 0));
    expectNear(glm::dvec3(meta.grid.worldFromIndex[1]), kBohr * glm::dvec3(0.1, 0.6, 0)); // sheared
    expectNear(glm::dvec3(meta.grid.worldFromIndex[2]), kBohr * glm::dvec3(0, 0, 0.7));
    expectNear(glm::dvec3(meta.grid.worldFromIndex[3]), kBohr * glm::dvec3(-1, 2, -3));
    ASSERT_TRUE(meta.crystal);
    ASSERT_EQ(meta.crystal->atoms.size(), 2U);
    EXPECT_EQ(meta.crystal->atoms[0].atomicNumber, 8);
    EXPECT_EQ(meta.crystal->atoms[1].atomicNumber, 1);
    expectNear(meta.crystal->atoms[1].positionWorld, kBohr * glm::dvec3(-1, 0.5, 0));
    expectNear(meta.crystal->lattice[1], kBohr * glm::dvec3(0.3, 1.8, 0));
    EXPECT_EQ(meta.crystal->comment, "water; electron density");
}

TEST_F(FormatsCube, NegativeVoxelNumbersAreAngstrom) {
    const auto data = dataText(kDims, placeValue);
    const auto all =
        load(write("a.cube", headText("2 -1 2 -3", "-2 0.5 0 0\n-3 0.1 0.6 0\n-4 0 0 0.7\n") + data));
    expectPlaces(all);
    expectNear(glm::dvec3(all.meta().grid.worldFromIndex[1]), {0.1, 0.6, 0});
    expectNear(glm::dvec3(all.meta().grid.worldFromIndex[3]), {-1, 2, -3});
    expectNear(all.meta().crystal->atoms[0].positionWorld, {1, 2, 3});
    const auto one =
        load(write("b.cube", headText("2 -1 2 -3", "2 0.5 0 0\n3 0.1 0.6 0\n-4 0 0 0.7\n") + data)).meta();
    expectNear(glm::dvec3(one.grid.worldFromIndex[0]), {kBohr * 0.5, 0, 0});
    expectNear(glm::dvec3(one.grid.worldFromIndex[2]), {0, 0, 0.7});
    expectNear(glm::dvec3(one.grid.worldFromIndex[3]), kBohr * glm::dvec3(-1, 2, -3));
    expectMentions(one.notes.front(), "mix");
}

TEST_F(FormatsCube, NegativeNumberOfAtomsAnnouncesOrbitals) {
    // The ids go on over a line end, as Gaussian writes ten to a line.
    const auto text = headText("   -2   -1.0 2.0 -3.0    1", kAxes) + "    3    5\n    7   12\n" +
                      dataText(kDims, placeValue, 3);
    const auto loaded = load(write("orbitals.cube", text));
    ASSERT_EQ(loaded.meta().fields.size(), 3U);
    EXPECT_EQ(loaded.meta().fields[0].name, "orbital 5");
    EXPECT_EQ(loaded.meta().fields[2].name, "orbital 12");
    EXPECT_EQ(loaded.meta().crystal->atoms.size(), 2U);
    for (int field = 0; field < 3; ++field)
        expectPlaces(loaded, field);
    const auto twice = headText("-2 0 0 0", kAxes) + "2 5 5\n" + dataText(kDims, placeValue, 2);
    EXPECT_EQ(load(write("twice.cube", twice)).meta().fields[1].name, "orbital 5 (2)");
}

TEST_F(FormatsCube, ReadsSeveralValuesAtAVoxel) {
    const auto text = headText("    2   -1.0 2.0 -3.0    2", kAxes) + dataText(kDims, placeValue, 2);
    const auto loaded = load(write("gradient.cube", text));
    ASSERT_EQ(loaded.meta().fields.size(), 2U);
    EXPECT_EQ(loaded.meta().fields[1].name, "value 2");
    expectPlaces(loaded, 0);
    expectPlaces(loaded, 1);
    const auto both = headText("-2 0 0 0 2", kAxes) + "2 5 6\n" + dataText(kDims, placeValue, 4);
    EXPECT_THROW((void)load(write("both.cube", both)), Unsupported);
}

TEST_F(FormatsCube, IsKnownByItsContent) {
    expectPlaces(load(write("no_ending", plainFile())));
    expectPlaces(load(write("CHGCAR_of_water", plainFile())));
    expectPlaces(load(write("water.cube.gz", gzipped(plainFile()))));
    expectPlaces(load(write("water.bz2", bzipped(plainFile()))));
    const std::string chgcar =
        "two atoms\n 1.0\n 2 0 0\n 0 3 0\n 1 0 4\n Na Cl\n 1 1\nDirect\n 0 0 0\n .5 .5 .5\n"
        "\n 1 1 2\n 1 2\n";
    EXPECT_EQ(load(write("CHGCAR", chgcar)).meta().format, "chgcar");
    EXPECT_EQ(load(write("really_chgcar.cube", chgcar)).meta().format, "chgcar");
    // A colour table of the same ending.
    expectMentions(loadError(write("look.cube", "TITLE \"warm\"\nLUT_3D_SIZE 2\n0 0 0\n1 1 1\n")),
                   "no number of atoms");
}

TEST_F(FormatsCube, ReadsFortranNumbersAndNoAtoms) {
    const auto text =
        headText("0 0D0 .5D+01 0", "1 1 0 0\n1 0 1 0\n-3 0 0 1\n", "") + "1.5D-01\n-.25D+02 0.1-100";
    const auto loaded = load(write("a.cube", text));
    const auto values = loaded.values<double>();
    ASSERT_EQ(values.size(), 3U);
    EXPECT_EQ(values[0], 0.15);
    EXPECT_EQ(values[1], -25.0);
    EXPECT_DOUBLE_EQ(values[2], 0.1e-100);
    EXPECT_TRUE(loaded.meta().crystal->atoms.empty());
    expectNear(glm::dvec3(loaded.meta().grid.worldFromIndex[3]), {0, 5 * kBohr, 0});
}

TEST_F(FormatsCube, ReadsGhostAtomsAndLeftHandedFrames) {
    const auto text = headText("2 0 0 0", "2 -0.5 0 0\n3 0 0.6 0\n4 0 0 0.7\n", "0 0 1 2 3\n-1 0.5 1 1 1\n") +
                      dataText(kDims, placeValue);
    const auto loaded = load(write("a.cube", text));
    expectPlaces(loaded);
    EXPECT_LT(glm::determinant(glm::dmat3(loaded.meta().grid.worldFromIndex)), 0.0);
    EXPECT_EQ(loaded.meta().crystal->atoms[0].atomicNumber, 0);
    EXPECT_EQ(loaded.meta().crystal->atoms[1].atomicNumber, 0);
}

TEST_F(FormatsCube, IsPeriodicWhereTheOptionSaysSo) {
    ImportOptions options;
    options.periodic = glm::bvec3(true, false, true);
    EXPECT_EQ(load(write("a.cube", plainFile()), options).meta().grid.periodic,
              glm::bvec3(true, false, true));
}

TEST_F(FormatsCube, RefusesWrongFiles) {
    const auto good = plainFile();
    const auto replaced = [&](const std::string& from, const std::string& to) {
        auto text = good;
        const auto at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return loadError(write("a.cube", text.replace(at, from.size(), to)));
    };
    const std::string first = "    2    0.5 0.0 0.0\n";
    for (const std::string axis :
         {"0 0.5 0 0\n", "2 nan 0 0\n", "2 inf 0 0\n", "2 1e400 0 0\n", "2.5 1 0 0\n", "2 1 0\n", "\n",
          "99999999999 1 0 0\n", "-9223372036854775808 1 0 0\n", "99999999999999999999 1 0 0\n"})
        EXPECT_FALSE(replaced(first, axis).empty()) << axis;
    for (const std::string axis : {"2 0 0 0\n", "2 0 0 5\n", "2 1e-320 0 0\n", "2 1e300 0 0\n"})
        EXPECT_FALSE(replaced(first, axis).empty()) << axis;
    expectMentions(replaced(first, "2 0 0 5\n"), "do not span space");
    for (const std::string count :
         {"3 0 0 0", "1 0 0 0", "-9223372036854775808 0 0 0", "99999999999 0 0 0", "2 0 0 nan", "2 0 0 0 0",
          "2 0 0 0 -1", "2 0 0 0 99999", "2 0 0 0 2", "-2 0 0 0", "x 0 0 0"})
        EXPECT_FALSE(replaced("    2   -1.0 2.0 -3.0", count).empty()) << count;
    expectMentions(replaced("-5.70000E+01", "************"), "'************'");
    expectMentions(loadError(write("a.cube", good.substr(0, good.size() - 30))), "of 24 values");
    expectMentions(loadError(write("a.cube", good.substr(0, good.size() - 2))), "within the last value");
    expectMentions(loadError(write("a.cube", good.substr(0, good.find("    1    1.000000")))),
                   "it ends before");
    expectMentions(loadError(write("a.cube", good + "1.0\n")), "more values");
    expectPlaces(load(write("a.cube", good + "\nthe end\n")));
}

TEST_F(FormatsCube, RefusesLyingSizesBeforeAllocating) {
    const auto refused = [&](const std::string& head) {
        const auto path = write("a.cube", head + " 1.0 2.0\n");
        const auto readers = makeOwnReaders();
        for (const auto& reader : readers)
            if (reader->recognises(readFileHead(path), {})) {
                EXPECT_THROW((void)reader->readHeader(path, {}, {}), Error) << head;
                return;
            }
        ADD_FAILURE() << "not recognised";
    };
    const std::string axes = "1000 1 0 0\n1000 0 1 0\n1000 0 0 1\n";
    refused(headText("2 0 0 0", axes));
    refused(headText("2 0 0 0 4000", kAxes));
    refused(headText("-2 0 0 0", kAxes) + "4000 1 2 3\n");
    refused(headText("9999999 0 0 0", axes));
    refused(headText("2 0 0 0", "1073741824 1 0 0\n1073741824 0 1 0\n1073741824 0 0 1\n"));
}

} // namespace
} // namespace voxsheet::import::testing
