#include "formats_fixture.h"

namespace voxsheet::import::testing {
namespace {

using namespace std::string_literals;

class FormatsSlc : public FormatsTest {
protected:
    /// 3 x 2 x 2 voxels, and an icon of 2 x 1 pixels whose bytes look like a slice.
    static std::string header(int compression, const std::string& sizes = "3 2 2 8",
                              const std::string& lengths = "1.0 0.5 2.000000") {
        return "11111\n" + sizes + "\n" + lengths + "\n1 6 0 " + std::to_string(compression) +
               "\n2 1 X5 X\x82\x01\x01";
    }
    static std::string coded(const std::string& runs) { return std::to_string(runs.size()) + " X" + runs; }
    [[nodiscard]] fs::path file(const std::string& bytes) const { return write("v.slc", bytes); }

    const std::vector<unsigned char> voxels_{7, 7, 7, 7, 1, 2, 3, 4, 5, 6, 7, 7};
    const std::string first_ = coded("\x04\x07\x82\x01\x02\x00"s);
    const std::string second_ = coded("\x84\x03\x04\x05\x06\x02\x07\x00"s);
};

TEST_F(FormatsSlc, ReadsPlainAndRunLengthSlices) {
    const auto packed = load(file(header(1) + first_ + second_));
    EXPECT_EQ(packed.values<unsigned char>(), voxels_);
    EXPECT_EQ(packed.meta().format, "slc");
    EXPECT_EQ(packed.meta().grid.dims, glm::ivec3(3, 2, 2));
    EXPECT_EQ(spacingWorld(packed.meta().grid), glm::dvec3(1, 0.5, 2));
    EXPECT_EQ(glm::dvec3(packed.meta().grid.worldFromIndex[3]), glm::dvec3(0));
    EXPECT_EQ(load(file(header(0) + bytesOf(voxels_))).values<unsigned char>(), voxels_);
}

TEST_F(FormatsSlc, ASliceMayEndWithoutItsZero) {
    const auto unended = coded("\x04\x07\x82\x01\x02"s);
    EXPECT_EQ(load(file(header(1) + unended + second_)).values<unsigned char>(), voxels_);
}

TEST_F(FormatsSlc, RefusesDamagedSlices) {
    expectMentions(loadError(file(header(1) + first_ + coded("\x84\x03\x04\x05\x06\x03\x07\x00"s))),
                   "slice 1 holds more than its 6 voxels");
    expectMentions(loadError(file(header(1) + first_ + coded("\x84\x03\x04\x05\x06\x00\x02\x07"s))),
                   "slice 1 holds 4 of its 6 voxels");
    expectMentions(loadError(file(header(1) + first_ + coded("\x86\x03\x04\x05\x06"s))),
                   "slice 1 ends within a run");
    expectMentions(loadError(file(header(1) + first_ + second_.substr(0, 6))), "length of slice 1");
    expectMentions(loadError(file(header(1) + first_ + "    ")), "length of slice 1");
    expectMentions(loadError(file(header(1) + first_ + "6 Y\x06\x01....")), "no 'X'");
    expectMentions(loadError(file(header(0) + bytesOf(voxels_).substr(1))), "12 bytes");
}

TEST_F(FormatsSlc, RefusesWrongHeaders) {
    const auto all = first_ + second_;
    for (const auto& sizes : {"0 2 2 8"s, "-3 2 2 8"s, "3 2 4294967299 8"s, "2000000 2000000 2000000 8"s,
                              "99999 2 2 8"s, "3 2 2 0"s, "3 2 2 16"s})
        EXPECT_FALSE(loadError(file(header(1, sizes) + all)).empty()) << sizes;
    expectMentions(loadError(file(header(1, "3 2 2 16") + all)), "16 bits");
    for (const auto& lengths : {"1 1 0"s, "1 nan 1"s, "1 inf 1"s, "1 x 1"s, "-1 1 1e-320"s})
        EXPECT_FALSE(loadError(file(header(1, "3 2 2 8", lengths) + all)).empty()) << lengths;
    expectMentions(loadError(file(header(2) + all)), "compression");
    const auto whole = header(1) + all;
    for (std::size_t length = 16; length < whole.size(); ++length)
        EXPECT_FALSE(loadError(file(whole.substr(0, length))).empty()) << length;
}

} // namespace
} // namespace voxsheet::import::testing
