// Options that hold for every format, and the promise that one volume looks the same from three medical
// formats.
#include "formats_fixture.h"
#include "nifti_bytes.h"

#include <cmath>
#include <limits>

namespace voxsheet::import::testing {
namespace {

class FormatsOptions : public FormatsTest {
protected:
    template <typename T>
    fs::path nrrd(const std::string& type, const std::vector<T>& values,
                  const std::string& fields = "") const {
        return write("x.nrrd", "NRRD0004\ntype: " + type +
                                   "\ndimension: 3\nsizes: 2 3 4\nendian: little\nencoding: raw\n" + fields +
                                   "\n" + bytesOf(values));
    }
};

TEST_F(FormatsOptions, ReplacesSpacingOriginAndPeriodicity) {
    ImportOptions options;
    options.spacing = glm::dvec3(1, 2, 4);
    options.origin = glm::dvec3(7, 8, 9);
    options.periodic = glm::bvec3(false, true, false);
    const auto path =
        nrrd("uchar", ramp<unsigned char>(24), "space: LPS\nspace directions: (3,0,0) (0,0,3) (0,3,0)\n");
    const auto grid = load(path, options).meta().grid;
    EXPECT_EQ(glm::dvec3(grid.worldFromIndex[0]), glm::dvec3(-1, 0, 0));
    EXPECT_EQ(glm::dvec3(grid.worldFromIndex[1]), glm::dvec3(0, 0, 2));
    EXPECT_EQ(glm::dvec3(grid.worldFromIndex[2]), glm::dvec3(0, -4, 0));
    EXPECT_EQ(glm::dvec3(grid.worldFromIndex[3]), glm::dvec3(7, 8, 9));
    EXPECT_EQ(grid.periodic, glm::bvec3(false, true, false));
    for (const auto& spacing : {glm::dvec3(0, 1, 1), glm::dvec3(-1, 1, 1), glm::dvec3(1, NAN, 1)}) {
        options.spacing = spacing;
        EXPECT_FALSE(loadError(path, options).empty());
    }
}

TEST_F(FormatsOptions, FlipsWithinTheBox) {
    const auto path = nrrd("uchar", ramp<unsigned char>(24), "spacings: 2 3 4\n");
    ImportOptions options;
    options.flip = glm::bvec3(false, true, false);
    for (const bool periodic : {false, true}) {
        options.periodic = glm::bvec3(periodic);
        auto plain = options;
        plain.flip = glm::bvec3(false);
        const auto before = load(path, plain).meta().grid;
        const auto after = load(path, options).meta().grid;
        EXPECT_EQ(centreWorld(before), centreWorld(after));
        const auto box = boxIndex(before);
        const auto low = after.worldFromIndex * glm::dvec4(box.low, 1.0);
        EXPECT_EQ(glm::dvec3(low),
                  glm::dvec3(before.worldFromIndex * glm::dvec4(box.low.x, box.high.y, box.low.z, 1.0)));
    }
}

TEST_F(FormatsOptions, TurnsTheNoDataValueIntoNan) {
    auto shorts = ramp<short>(24);
    shorts[5] = -9999;
    ImportOptions options;
    options.noDataValue = -9999.0;
    const auto loaded = load(nrrd("short", shorts), options);
    EXPECT_EQ(loaded.meta().sourceType, ScalarType::I16);
    EXPECT_EQ(loaded.meta().fields[0].storedType, ScalarType::F32);
    const auto values = loaded.values<float>();
    for (std::size_t i = 0; i < 24; ++i) {
        if (i == 5)
            EXPECT_TRUE(std::isnan(values[i]));
        else
            EXPECT_EQ(values[i], shorts[i]);
    }
    auto ints = ramp<int>(24);
    ints[7] = -9999;
    const auto doubles = load(nrrd("int", ints), options).values<double>();
    EXPECT_TRUE(std::isnan(doubles[7]));
    EXPECT_EQ(doubles[8], ints[8]);
    auto floats = ramp<float>(24);
    floats[3] = -9999.0F;
    EXPECT_TRUE(std::isnan(load(nrrd("float", floats), options).values<float>()[3]));
    // What the type cannot hold is nowhere in the file.
    const auto bytes = ramp<unsigned char>(24);
    EXPECT_EQ(load(nrrd("uchar", bytes), options).values<unsigned char>(), bytes);
    for (const double value : {0.5, 1e300, std::numeric_limits<double>::infinity(), 256.0, -1.0}) {
        options.noDataValue = value;
        EXPECT_EQ(load(nrrd("uchar", bytes), options).values<unsigned char>(), bytes) << value;
    }
    // A number that a float file can only hold rounded: 0.1 means the float nearest to it.
    floats[4] = 0.1F;
    options.noDataValue = 0.1;
    EXPECT_TRUE(std::isnan(load(nrrd("float", floats), options).values<float>()[4]));
}

TEST_F(FormatsOptions, KeepsTheBitsThatAreValues) {
    ImportOptions options;
    options.bitMask = 0x7fff;
    std::vector<short> flagged;
    for (int i = 0; i < 24; ++i)
        flagged.push_back(static_cast<short>(i % 2 == 0 ? i * 100 : (i * 100) | 0x8000));
    const auto path = nrrd("short", flagged);
    const auto loaded = load(path, options);
    EXPECT_EQ(loaded.meta().fields[0].storedType, ScalarType::I16);
    expectMentions(loaded.meta().notes.back(), "0x7fff");
    const auto values = loaded.values<short>();
    for (int i = 0; i < 24; ++i)
        EXPECT_EQ(values[static_cast<std::size_t>(i)], i * 100);
    // What the mask leaves is compared with the number for no value.
    options.noDataValue = 300.0;
    const auto floats = load(path, options).values<float>();
    EXPECT_TRUE(std::isnan(floats[3])) << "stored as 300 with the flag";
    EXPECT_EQ(floats[5], 500.0F);
    options.noDataValue.reset();

    options.bitMask = 0xf000'0000'0000'000eU; // beyond a type's bits it does nothing
    const auto bytes = load(nrrd("uchar", ramp<unsigned char>(24)), options).values<unsigned char>();
    const auto longs = load(nrrd("longlong", std::vector<long>(24, -1L)), options).values<long>();
    for (std::size_t i = 0; i < 24; ++i)
        EXPECT_EQ(bytes[i], ramp<unsigned char>(24)[i] & 0x0e);
    EXPECT_EQ(static_cast<unsigned long>(longs[0]), *options.bitMask);

    expectMentions(loadError(nrrd("float", ramp<float>(24)), options), "only floats");
    options.bitMask = 0xff00;
    expectMentions(loadError(nrrd("uchar", ramp<unsigned char>(24)), options), "leaves nothing");
}

TEST_F(FormatsOptions, OrientsWhatDoesNotSayItsSides) {
    ImportOptions options;
    options.orientation = "PIR";
    const auto meta =
        load(nrrd("uchar", ramp<unsigned char>(24), "spacings: 2 3 4\naxis mins: 5 6 7\n"), options).meta();
    EXPECT_TRUE(meta.anatomical);
    EXPECT_EQ(meta.lengthUnit, "mm");
    EXPECT_EQ(glm::dvec3(meta.grid.worldFromIndex[0]), glm::dvec3(0, -2, 0));
    EXPECT_EQ(glm::dvec3(meta.grid.worldFromIndex[1]), glm::dvec3(0, 0, -3));
    EXPECT_EQ(glm::dvec3(meta.grid.worldFromIndex[2]), glm::dvec3(4, 0, 0));
    EXPECT_EQ(glm::dvec3(meta.grid.worldFromIndex[3]), glm::dvec3(5, 6, 7));
    for (const auto& [letters, place] :
         {std::pair{"LAS", glm::dvec3(-1, 1, 1)}, std::pair{"RPI", glm::dvec3(1, -1, -1)}}) {
        options.orientation = letters;
        const auto grid = load(nrrd("uchar", ramp<unsigned char>(24)), options).meta().grid;
        EXPECT_EQ(glm::dvec3(grid.worldFromIndex * glm::dvec4(1, 1, 1, 1)), place) << letters;
    }
    const auto sheared =
        nrrd("uchar", ramp<unsigned char>(24), "space: LPS\nspace directions: (3,0,0) (1,0,3) (0,3,0)\n");
    expectMentions(loadError(sheared, options), "not perpendicular");
}

TEST_F(FormatsOptions, OneVolumeIsTheSameFromThreeFormats) {
    const auto values = ramp<short>(24);
    // RAS+ axes: i to the back-right, j up, k to the left; the others say the same in LPS+.
    NiftiBytes nifti(1, false, {2, 3, 4}, 4);
    nifti.setSform({1.5, 0, -2, 10, -1.5, 0, -2, 20, 0, 0.5, 0, 30});
    const auto first = load(write("a.nii", nifti.with(bytesOf(values))));
    const auto second =
        load(nrrd("short", values,
                  "space: left-posterior-superior\nspace directions: (-1.5,1.5,0) (0,0,0.5) (2,2,0)\n"
                  "space origin: (-10,-20,30)\n"));
    const std::string direction = "-1 1 0 0 0 1 1 1 0"; // rows, one per axis; lengths times ElementSpacing
    const auto third = load(
        write("a.mha", "NDims = 3\nDimSize = 2 3 4\nElementType = MET_SHORT\nElementSpacing = 1.5 0.5 "
                       "2\nTransformMatrix = " +
                           direction + "\nOffset = -10 -20 30\nElementDataFile = LOCAL\n" + bytesOf(values)));
    EXPECT_EQ(first.meta().grid, second.meta().grid);
    EXPECT_EQ(first.meta().grid, third.meta().grid);
    EXPECT_EQ(first.values<short>(), second.values<short>());
    EXPECT_EQ(first.values<short>(), third.values<short>());
    EXPECT_TRUE(first.meta().anatomical && second.meta().anatomical && third.meta().anatomical);
    EXPECT_EQ(first.meta().lengthUnit, second.meta().lengthUnit);
}

} // namespace
} // namespace voxsheet::import::testing
