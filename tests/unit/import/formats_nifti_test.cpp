#include "formats_fixture.h"
#include "nifti_bytes.h"

#include <cmath>
#include <limits>

namespace voxsheet::import::testing {
namespace {

class FormatsNifti : public FormatsTest {
protected:
    template <typename T>
    void roundTrip(int datatype) {
        const auto values = ramp<T>(24);
        for (const int version : {1, 2})
            for (const bool big : {false, true}) {
                const auto file = NiftiBytes(version, big, {2, 3, 4}, datatype).with(bytesOf(values, big));
                const auto loaded = load(write("x.nii", file));
                EXPECT_EQ(loaded.template values<T>(), values) << datatype;
                EXPECT_EQ(loaded.meta().grid.dims, glm::ivec3(2, 3, 4));
                EXPECT_EQ(load(write("x.nii.gz", gzipped(file))).template values<T>(), values) << datatype;
                const auto header = NiftiBytes(version, big, {2, 3, 4}, datatype, false).header();
                write("p.img", bytesOf(values, big));
                EXPECT_EQ(load(write("p.hdr", header)).template values<T>(), values) << datatype;
                EXPECT_EQ(load(folder_ / "p.img").template values<T>(), values) << datatype;
            }
    }
    static std::string small(const std::vector<unsigned char>& values) { return bytesOf(values); }
};

TEST_F(FormatsNifti, ReadsEveryTypeVersionAndByteOrder) {
    roundTrip<unsigned char>(2);
    roundTrip<short>(4);
    roundTrip<int>(8);
    roundTrip<float>(16);
    roundTrip<double>(64);
    roundTrip<signed char>(256);
    roundTrip<unsigned short>(512);
    roundTrip<unsigned>(768);
    roundTrip<long>(1024);
    roundTrip<unsigned long>(1280);
}

TEST_F(FormatsNifti, ReadsCompressedPairs) {
    const auto values = ramp<unsigned char>(24);
    const auto header = NiftiBytes(1, true, {2, 3, 4}, 2, false).header();
    write("p.img.gz", gzipped(bytesOf(values)));
    const auto loaded = load(write("p.hdr", header));
    EXPECT_EQ(loaded.values<unsigned char>(), values);
    EXPECT_EQ(loaded.header.files.size(), 2U);
    fs::remove(folder_ / "p.hdr");
    EXPECT_EQ(load(write("p.hdr.gz", gzipped(header))).values<unsigned char>(), values);
    EXPECT_EQ(load(folder_ / "p.img.gz").values<unsigned char>(), values);
    fs::remove(folder_ / "p.img.gz");
    expectMentions(loadError(folder_ / "p.hdr.gz"), ".img");
    // Raw voxels that happen to start like gzip are still raw.
    auto tricky = values;
    tricky[0] = 0x1f;
    tricky[1] = 0x8b;
    write("p.img", bytesOf(tricky));
    EXPECT_EQ(load(folder_ / "p.hdr.gz").values<unsigned char>(), tricky);
}

TEST_F(FormatsNifti, SplitsColoursComplexNumbersTimeAndVectors) {
    const auto values = ramp<unsigned char>(48);
    const auto rgb = load(write("rgb.nii", NiftiBytes(1, false, {2, 2, 2, 2}, 128).with(bytesOf(values))));
    ASSERT_EQ(rgb.meta().fields.size(), 3U);
    EXPECT_EQ(rgb.meta().fields[2].name, "blue");
    EXPECT_EQ(rgb.values<unsigned char>(1, 1)[3], values[(8 + 3) * 3 + 1]);

    const auto floats = ramp<float>(16);
    const auto complex = load(write("c.nii", NiftiBytes(1, true, {2, 2, 2}, 32).with(bytesOf(floats, true))));
    EXPECT_EQ(complex.meta().fields[1].name, "imaginary");
    EXPECT_EQ(complex.values<float>(1)[3], floats[7]);

    const auto rgba = load(write("rgba.nii", NiftiBytes(2, false, {3, 2, 2}, 2304).with(bytesOf(values))));
    ASSERT_EQ(rgba.meta().fields.size(), 4U);
    EXPECT_EQ(rgba.meta().fields[3].name, "alpha");
    const auto doubles = ramp<double>(16);
    const auto wide = load(write("d.nii", NiftiBytes(1, true, {2, 2, 2}, 1792).with(bytesOf(doubles, true))));
    ASSERT_EQ(wide.meta().fields.size(), 2U);
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(wide.values<double>(0)[i], doubles[2 * i]);
        EXPECT_EQ(wide.values<double>(1)[i], doubles[2 * i + 1]);
    }
    for (std::size_t i = 0; i < 12; ++i)
        EXPECT_EQ(rgba.values<unsigned char>(3)[i], values[4 * i + 3]);

    NiftiBytes series(1, false, {2, 2, 2, 3, 2}, 2);
    series.setPixdim(4, 500.0);
    series.setUnits(2 + 16); // mm, ms
    const auto loaded = load(write("t.nii", series.with(bytesOf(values))));
    EXPECT_EQ(loaded.meta().times, (std::vector<double>{0.0, 0.5, 1.0}));
    ASSERT_EQ(loaded.meta().fields.size(), 2U);
    EXPECT_EQ(loaded.values<unsigned char>(1, 2)[0], values[8 * 5]); // time varies faster than the fifth axis
}

TEST_F(FormatsNifti, UsesSformThenQformThenSpacing) {
    const std::string voxels(24, 'v');
    NiftiBytes bytes(1, false, {2, 3, 4}, 2);
    bytes.setPixdim(1, 2.0);
    bytes.setPixdim(2, 3.0);
    bytes.setPixdim(3, -4.0);
    auto meta = load(write("x.nii", bytes.with(voxels))).meta();
    EXPECT_FALSE(meta.anatomical);
    EXPECT_EQ(spacingWorld(meta.grid), glm::dvec3(2, 3, 4));
    EXPECT_FALSE(meta.notes.empty());

    bytes.setQform(0, 0, std::sqrt(0.5), 10, 20, 30); // a quarter turn about z
    bytes.setPixdim(0, -1.0);
    meta = load(write("x.nii", bytes.with(voxels))).meta();
    EXPECT_TRUE(meta.anatomical);
    const auto& q = meta.grid.worldFromIndex;
    EXPECT_NEAR(glm::distance(glm::dvec3(q[0]), glm::dvec3(0, 2, 0)), 0.0, 1e-6);
    EXPECT_NEAR(glm::distance(glm::dvec3(q[1]), glm::dvec3(-3, 0, 0)), 0.0, 1e-6);
    EXPECT_NEAR(glm::distance(glm::dvec3(q[2]), glm::dvec3(0, 0, -4)), 0.0, 1e-6);
    EXPECT_EQ(glm::dvec3(q[3]), glm::dvec3(10, 20, 30));

    bytes.setSform({-2, 0, 0, 1, 0, 0, 3, 2, 0, 4, 0, 3});
    meta = load(write("x.nii", bytes.with(voxels))).meta();
    EXPECT_EQ(glm::dvec3(meta.grid.worldFromIndex[0]), glm::dvec3(-2, 0, 0));
    EXPECT_EQ(glm::dvec3(meta.grid.worldFromIndex[1]), glm::dvec3(0, 0, 4));
    EXPECT_EQ(glm::dvec3(meta.grid.worldFromIndex[2]), glm::dvec3(0, 3, 0));
    EXPECT_EQ(glm::dvec3(meta.grid.worldFromIndex[3]), glm::dvec3(1, 2, 3));

    bytes.setUnits(3); // micrometres
    meta = load(write("x.nii", bytes.with(voxels))).meta();
    EXPECT_NEAR(meta.grid.worldFromIndex[3].x, 0.001, 1e-12);
    EXPECT_EQ(meta.lengthUnit, "mm");

    bytes.setSform(std::vector<double>(12, 0.0)); // announced, but empty: the qform counts
    meta = load(write("x.nii", bytes.with(voxels))).meta();
    EXPECT_TRUE(meta.anatomical);
    EXPECT_NEAR(meta.grid.worldFromIndex[3].y, 0.02, 1e-9);
}

TEST_F(FormatsNifti, TakesSlopeAndIntercept) {
    const auto scaled = [&](double slope, double intercept) {
        NiftiBytes bytes(2, false, {2, 3, 4}, 2);
        bytes.setScaling(slope, intercept);
        const auto field = load(write("x.nii", bytes.with(std::string(24, 'v')))).meta().fields[0];
        return std::pair(field.valueScale, field.valueOffset);
    };
    EXPECT_EQ(scaled(0.5, 10.0), std::pair(0.5, 10.0));
    EXPECT_EQ(scaled(0.0, 10.0), std::pair(1.0, 0.0));
    EXPECT_EQ(scaled(std::nan(""), 10.0), std::pair(1.0, 0.0));
}

TEST_F(FormatsNifti, RefusesWrongHeaders) {
    const std::string voxels(24, 'v');
    const auto message = [&](auto&& change) {
        NiftiBytes bytes(1, false, {2, 3, 4}, 2);
        change(bytes);
        return loadError(write("x.nii", bytes.with(voxels)));
    };
    for (const int axes : {0, -1, 8, 32767})
        EXPECT_FALSE(message([&](auto& bytes) {
                         bytes.template set<std::int16_t>(40, static_cast<std::int16_t>(axes));
                     }).empty())
            << axes;
    for (const int size : {0, -3, 5, 32767})
        EXPECT_FALSE(message([&](auto& bytes) {
                         bytes.template set<std::int16_t>(44, static_cast<std::int16_t>(size));
                     }).empty())
            << size;
    for (const int type : {0, 1, 3, 1536, 2048, -2})
        EXPECT_FALSE(message([&](auto& bytes) {
                         bytes.template set<std::int16_t>(70, static_cast<std::int16_t>(type));
                     }).empty())
            << type;
    for (const float offset : {0.0F, 348.0F, 352.5F, -352.0F, 1e30F, std::numeric_limits<float>::quiet_NaN()})
        EXPECT_FALSE(message([&](auto& bytes) { bytes.template set<float>(108, offset); }).empty()) << offset;
    for (const double spacing : {0.0, std::nan(""), std::numeric_limits<double>::infinity()})
        EXPECT_FALSE(message([&](auto& bytes) { bytes.setPixdim(2, spacing); }).empty()) << spacing;
    EXPECT_FALSE(message([](auto& bytes) { bytes.setSform({1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0}); }).empty());
    EXPECT_FALSE(message([](auto& bytes) {
                     bytes.setSform({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, std::nan(""), 0});
                 }).empty());
    EXPECT_FALSE(message([](auto& bytes) { bytes.setQform(std::nan(""), 0, 0, 0, 0, 0); }).empty());
    expectMentions(message([](auto& bytes) { bytes.set(0, std::int32_t{349}); }),
                   "does not start with a NIfTI header");
    expectMentions(message([](auto& bytes) { bytes.set(344, std::int32_t{0}); }), "Analyze");
    auto analyze = NiftiBytes(1, false, {2, 3, 4}, 2).header();
    analyze.replace(344, 4, std::string(4, '\0'));
    expectMentions(loadError(write("a.hdr", analyze)), "Analyze");
}

TEST_F(FormatsNifti, NamesBothSizesOfShortFilesAndAllowsLongerOnes) {
    const auto values = ramp<unsigned char>(24);
    const auto file = NiftiBytes(1, false, {2, 3, 4}, 2).with(bytesOf(values));
    const auto shorter = loadError(write("x.nii", file.substr(0, file.size() - 1)));
    expectMentions(shorter, "24 bytes");
    expectMentions(shorter, "23 bytes");
    expectMentions(loadError(write("x.nii.gz", gzipped(file.substr(0, file.size() - 1)))), "only 23 bytes");
    EXPECT_EQ(load(write("x.nii", file + "more")).values<unsigned char>(), values);
    EXPECT_EQ(load(write("x.nii.gz", gzipped(file + "more"))).values<unsigned char>(), values);
    auto damaged = gzipped(file);
    damaged[damaged.size() - 7] = static_cast<char>(damaged[damaged.size() - 7] ^ 0x10); // checksum
    expectMentions(loadError(write("x.nii.gz", damaged)), "damaged");
}

} // namespace
} // namespace voxsheet::import::testing
