#include "formats_fixture.h"

#include <cmath>
#include <functional>

namespace voxsheet::import::testing {
namespace {

constexpr double kTiny = 1e-12; // rounding of a quotient

constexpr const char* kCrystal =
    "# made by hand\nCRYSTAL\n\nPRIMVEC\n 2 0 0\n 0 3 0\n 1 0 4\nCONVVEC\n 2 0 0\n 0 3 0\n"
    " 1 0 4\nPRIMCOORD\n 2 1\n 11 0.5 0.25 0.125\n Cl 1.5 1.5 2.0 0.1 0.0 -0.1\n";
constexpr const char* kMolecule = "MOLECULE\nATOMS\n 8 0.5 0.25 0.125\n H 1.5 1.5 2.0\n# end\n";
constexpr const char* kPlace = " 0.5 1.5 2.5\n 2 0 0\n 0 3 0\n 1 0 4\n";

/// Tells every sample's place by its digits.
double placeValue(int x, int y, int z, int field = 0) { return x + 10 * y + 100 * z + 1000 * field - 57.0; }

/// A DATAGRID_3D of `samples` in the file; a place beyond `period` has the value of the place it repeats.
std::string gridText(const std::string& name, const glm::ivec3& samples, const glm::ivec3& period,
                     int field = 0, const std::string& place = kPlace) {
    std::string text = "BEGIN_DATAGRID_3D" + name + "\n " + std::to_string(samples.x) + " " +
                       std::to_string(samples.y) + " " + std::to_string(samples.z) + "\n" + place;
    int column = 0;
    for (int z = 0; z < samples.z; ++z)
        for (int y = 0; y < samples.y; ++y)
            for (int x = 0; x < samples.x; ++x) {
                char word[64];
                std::snprintf(word, sizeof word, " %12.5E%s",
                              placeValue(x % period.x, y % period.y, z % period.z, field),
                              ++column % 6 == 0 ? "\n" : "");
                text += word;
            }
    return text + "\nEND_DATAGRID_3D\n";
}

std::string block(const std::string& grids) {
    return "BEGIN_BLOCK_DATAGRID_3D\n density of something\n" + grids + "END_BLOCK_DATAGRID_3D\n";
}

const glm::ivec3 kSamples(3, 4, 5);
const glm::ivec3 kPeriod(2, 3, 4);

std::string plainFile() { return kCrystal + block(gridText("_rho#1", kSamples, kPeriod)); }

void expectPlaces(const Loaded& loaded, const glm::ivec3& dims, int field = 0) {
    EXPECT_EQ(loaded.meta().grid.dims, dims);
    const auto values = loaded.values<double>(field);
    ASSERT_EQ(values.size(), static_cast<std::size_t>(dims.x * dims.y * dims.z));
    std::size_t at = 0;
    for (int z = 0; z < dims.z; ++z)
        for (int y = 0; y < dims.y; ++y)
            for (int x = 0; x < dims.x; ++x)
                EXPECT_EQ(values[at++], placeValue(x, y, z, field)) << x << ' ' << y << ' ' << z;
}

void expectNear(const glm::dvec3& is, const glm::dvec3& expected) {
    EXPECT_LT(glm::distance(is, expected), kTiny) << is.x << ' ' << is.y << ' ' << is.z;
}

/// The notes that reading the data gives.
std::vector<std::string> dataNotes(const fs::path& path) {
    const auto readers = makeOwnReaders();
    for (const auto& reader : readers)
        if (reader->recognises(readFileHead(path), {}))
            return reader->readData(reader->readHeader(path, {}, {}), [](int, int, auto&&) {}, {});
    return {"not recognised"};
}

class FormatsXsf : public FormatsTest {};

TEST_F(FormatsXsf, DropsTheRepeatedEndsOfACrystal) {
    const auto path = write("a.xsf", plainFile());
    const auto loaded = load(path);
    expectPlaces(loaded, kPeriod);
    const auto& meta = loaded.meta();
    EXPECT_EQ(meta.format, "xsf");
    EXPECT_EQ(meta.grid.periodic, glm::bvec3(true));
    expectNear(glm::dvec3(meta.grid.worldFromIndex[0]), {1, 0, 0});
    expectNear(glm::dvec3(meta.grid.worldFromIndex[2]), {0.25, 0, 1});
    expectNear(glm::dvec3(meta.grid.worldFromIndex[3]), {0.5, 1.5, 2.5});
    EXPECT_EQ(meta.lengthUnit, "Å");
    EXPECT_EQ(meta.fields[0].name, "rho#1");
    EXPECT_TRUE(meta.notes.empty());
    EXPECT_TRUE(dataNotes(path).empty());
    expectShearedSalt(meta);
}

TEST_F(FormatsXsf, SaysWhenDroppedSamplesDoNotRepeat) {
    const auto path = write("a.xsf", kCrystal + block(gridText("", kSamples, kSamples)));
    expectPlaces(load(path), kPeriod);
    const auto notes = dataNotes(path);
    ASSERT_EQ(notes.size(), 1U);
    expectMentions(notes[0], "do not repeat");
}

TEST_F(FormatsXsf, KeepsEverySampleOfAMolecule) {
    const auto loaded = load(write("a.xsf", kMolecule + block(gridText("_rho", kSamples, kSamples))));
    expectPlaces(loaded, kSamples);
    EXPECT_EQ(loaded.meta().grid.periodic, glm::bvec3(false));
    expectNear(glm::dvec3(loaded.meta().grid.worldFromIndex[0]), {1, 0, 0});
    EXPECT_EQ(loaded.meta().crystal->lattice[2], glm::dvec3(1, 0, 4));
    ASSERT_EQ(loaded.meta().crystal->atoms.size(), 2U);
    EXPECT_EQ(loaded.meta().crystal->atoms[1].atomicNumber, 1);
}

TEST_F(FormatsXsf, SlabsAndPolymersArePeriodicAlongTheirOwnAxes) {
    const auto read = [&](const std::string& keyword, const glm::ivec3& period) {
        auto text = kCrystal + block(gridText("", kSamples, period));
        return load(write("a.xsf", text.replace(text.find("CRYSTAL"), 7, keyword)));
    };
    const auto slab = read("SLAB", {2, 3, 5});
    expectPlaces(slab, {2, 3, 5});
    EXPECT_EQ(slab.meta().grid.periodic, glm::bvec3(true, true, false));
    const auto polymer = read("POLYMER", {2, 4, 5});
    expectPlaces(polymer, {2, 4, 5});
    EXPECT_EQ(polymer.meta().grid.periodic, glm::bvec3(true, false, false));
    expectPlaces(read("DIM-GROUP\n 2 1", {2, 3, 5}), {2, 3, 5});
}

TEST_F(FormatsXsf, IsPeriodicOnlyAlongLatticeTranslations) {
    // Along the first axis half a cell, along the second two, the third b + c.
    const std::string place = " 0 0 0\n 1 0 0\n 0 6 0\n 1 3 4\n";
    const auto loaded = load(write("a.xsf", kCrystal + block(gridText("", kSamples, {3, 3, 4}, 0, place))));
    expectPlaces(loaded, {3, 3, 4});
    EXPECT_EQ(loaded.meta().grid.periodic, glm::bvec3(false, true, true));
    expectNear(glm::dvec3(loaded.meta().grid.worldFromIndex[0]), {0.5, 0, 0});
    expectMentions(loaded.meta().notes.at(0), "first axis");
}

TEST_F(FormatsXsf, SeveralGridsBecomeFields) {
    const auto text = kCrystal +
                      block(gridText("_up", kSamples, kPeriod) + gridText("_up", kSamples, kPeriod, 1)) +
                      "BEGIN_BLOCK_DATAGRID_2D\nx\nBEGIN_DATAGRID_2D_y\n 1 1\n 0 0 0\n 1 0 0\n 0 1 0\n 5\n"
                      "END_DATAGRID_2D\nEND_BLOCK_DATAGRID_2D\n" +
                      block(gridText("", kSamples, kPeriod, 2));
    const auto loaded = load(write("a.xsf", text));
    ASSERT_EQ(loaded.meta().fields.size(), 3U);
    EXPECT_EQ(loaded.meta().fields[0].name, "up");
    EXPECT_EQ(loaded.meta().fields[1].name, "up (2)");
    EXPECT_EQ(loaded.meta().fields[2].name, "value");
    for (int field = 0; field < 3; ++field)
        expectPlaces(loaded, kPeriod, field);
    expectMentions(loaded.meta().notes.at(0), "DATAGRID_2D");
}

TEST_F(FormatsXsf, RefusesGridsThatDiffer) {
    const auto first = gridText("_up", kSamples, kPeriod);
    const auto error =
        loadError(write("a.xsf", kCrystal + block(first + gridText("_down", {3, 4, 6}, kPeriod))));
    expectMentions(error, "'up' (3 x 4 x 5) and 'down' (3 x 4 x 6)");
    expectMentions(error, "numbers of samples");
    const auto moved = gridText("_down", kSamples, kPeriod, 0, " 0 0 0\n 2 0 0\n 0 3 0\n 1 0 4\n");
    EXPECT_THROW((void)load(write("a.xsf", kCrystal + block(first + moved))), Unsupported);
}

TEST_F(FormatsXsf, IsKnownByItsContent) {
    for (const auto* name : {"no_ending", "CHGCAR", "LOCPOT.xsf"})
        expectPlaces(load(write(name, plainFile())), kPeriod);
    expectPlaces(load(write("a.xsf.gz", gzipped(plainFile()))), kPeriod);
    expectPlaces(load(write("a.bz2", bzipped(plainFile()))), kPeriod);
    // A VASP file whose comment is a keyword.
    const std::string chgcar =
        "CRYSTAL\n 1.0\n 2 0 0\n 0 3 0\n 1 0 4\n Na\n 1\nDirect\n 0 0 0\n\n 1 1 2\n 1 2\n";
    EXPECT_EQ(load(write("CHGCAR", chgcar)).meta().format, "chgcar");
    // Without a structure, and with Fortran's numbers.
    auto bare = block(gridText("", kSamples, kSamples));
    bare.replace(bare.find(" 2 0 0"), 6, " .2D+01 0.0D0 0");
    expectPlaces(load(write("x", bare)), kSamples);
}

TEST_F(FormatsXsf, FindsGridsOfLargeFiles) {
    // Large enough that the header phase passes over equal lines unread.
    const glm::ivec3 samples(121, 100, 90);
    const auto text =
        kMolecule + block(gridText("_a", samples, samples) + gridText("_b", samples, samples, 1));
    const auto loaded = load(write("a.xsf", text));
    ASSERT_EQ(loaded.meta().fields.size(), 2U);
    EXPECT_EQ(loaded.values<double>(1)[0], placeValue(0, 0, 0, 1));
    EXPECT_EQ(loaded.values<double>(1).back(), placeValue(120, 99, 89, 1));
    expectMentions(loadError(write("a.xsf", text.substr(0, text.size() / 2 + 900))),
                   "grid 2 needs 1089000 values");
}

TEST_F(FormatsXsf, RefusesAnimations) {
    const auto animated =
        "ANIMSTEPS 2\nCRYSTAL\nPRIMVEC 1\n 2 0 0\n 0 3 0\n 1 0 4\nPRIMCOORD 1\n 1 1\n 11 0 0 0\n"
        "PRIMCOORD 2\n 1 1\n 11 0 0 1\n";
    const auto path = write("a.axsf", animated);
    EXPECT_THROW((void)load(path), Unsupported);
    expectMentions(loadError(path), "ANIMSTEPS");
}

TEST_F(FormatsXsf, RefusesWrongFiles) {
    const auto good = plainFile();
    const auto replaced = [&](const std::string& from, const std::string& to) {
        auto text = good;
        const auto at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return loadError(write("a.xsf", text.replace(at, from.size(), to)));
    };
    for (const std::string dims :
         {" 0 4 5\n", " -3 4 5\n", " 3 4\n", " 3 4 5 6\n", " 3 4 nan\n", " 99999 99999 99999\n",
          " 9999999999 4 5\n", " 99999999999999999999 4 5\n", " 3 4 6\n", " 3 4 4\n", "\n"})
        EXPECT_FALSE(replaced(" 3 4 5\n", dims).empty()) << dims;
    expectMentions(replaced(" 3 4 5\n", " 3 4 4\n"), "numbers of samples");
    for (const std::string vector :
         {" 0 0 0\n", " nan 0 0\n", " inf 0 0\n", " 1e400 0 0\n", " 2 0\n", " x y z\n"}) {
        EXPECT_FALSE(replaced(" 2 0 0\n", vector).empty()) << vector; // PRIMVEC
        auto text = good;
        text.replace(text.find(" 2 0 0\n", text.find("DATAGRID")), 7, vector);
        EXPECT_FALSE(loadError(write("a.xsf", text)).empty()) << vector; // spanning vectors
    }
    for (const std::string count : {" 3 1\n", " 1 1\n", " -1 1\n", " 99999999999 1\n", " x\n"})
        EXPECT_FALSE(replaced(" 2 1\n", count).empty()) << count;
    expectMentions(replaced("-5.70000E+01", "************"), "'************'");
    expectMentions(replaced("CONVVEC", "NONSENSE"), "'NONSENSE' is no keyword");
    expectMentions(replaced("END_DATAGRID_3D", "1 2 3"), "numbers of samples");
    expectMentions(loadError(write("a.xsf", kCrystal)), "no grid");
    expectMentions(loadError(write("a.xsf", good.substr(0, good.find("END_DATAGRID")))), "END_DATAGRID_3D");
    expectMentions(loadError(write("a.xsf", good.substr(0, good.find("END_DATAGRID") - 20))),
                   "needs 60 values");
    const auto bands =
        "BEGIN_BLOCK_BANDGRID_3D\nx\nBEGIN_BANDGRID_3D\n 1\nEND_BANDGRID_3D\nEND_BLOCK_BANDGRID_3D\n";
    EXPECT_THROW((void)load(write("a.bxsf", bands)), Unsupported);
}

TEST_F(FormatsXsf, RefusesLyingSizesBeforeAllocating) {
    const auto head = std::string("BEGIN_DATAGRID_3D\n 1000 1000 1000\n") + kPlace;
    const auto path = write("a.xsf", kCrystal + block(head + " 1 2 3\nEND_DATAGRID_3D\n"));
    expectMentions(loadError(path), "cannot be in a file");
    ImportLimits limits;
    limits.maxBytes = 2 * 60 * sizeof(double) - 1;
    const auto grid = gridText("", kSamples, kPeriod);
    EXPECT_NO_THROW((void)load(write("a.xsf", plainFile()), {}, limits));
    EXPECT_THROW((void)load(write("a.xsf", kCrystal + block(grid + grid)), {}, limits), LimitExceeded);
}

} // namespace
} // namespace voxsheet::import::testing
