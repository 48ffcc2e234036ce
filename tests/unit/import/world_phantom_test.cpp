// One phantom in every format that holds an orientation: 2 x 3 x 4 samples, all different, steps of 0.5, 2
// and 3 along axes turned by 3-4-5 about z and, after that, about x, in RAS. The same voxels at the same
// places.
#include "nifti_bytes.h"
#include "vtk_fixture.h"

#include <sstream>

namespace voxsheet::import::testing {
namespace {

const glm::dvec3 kSteps{0.5, 2.0, 3.0};
const glm::dmat3 kAboutZ{0.6, 0.8, 0, -0.8, 0.6, 0, 0, 0, 1}; // columns
const glm::dmat3 kAboutX{1, 0, 0, 0, 0.8, 0.6, 0, -0.6, 0.8};
const glm::dmat3 kDirection = kAboutX * kAboutZ;
const glm::dvec3 kOrigin{-11.0, 7.0, 40.0};
const glm::dvec3 kToLps{-1, -1, 1};

std::string text(double number) {
    std::ostringstream out;
    out.precision(17);
    out << number;
    return out.str();
}

std::string text(const glm::dvec3& v, const std::string& between) {
    return text(v.x) + between + text(v.y) + between + text(v.z);
}

std::string vector(const glm::dvec3& v) { return "(" + text(v, ",") + ")"; }

class WorldPhantom : public FormatsTest {
protected:
    /// \param tolerance  of what the header's numbers can hold, in world units
    void expectPhantom(const fs::path& file, double tolerance = 1e-12) {
        const auto loaded = loadAny(file);
        EXPECT_EQ(loaded.meta().grid.dims, glm::ivec3(2, 3, 4)) << file;
        EXPECT_EQ(loaded.values<short>(), samples_) << file;
        EXPECT_TRUE(loaded.meta().anatomical) << file;
        for (const glm::dvec3 index : {glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 2, 0),
                                       glm::dvec3(0, 0, 3), glm::dvec3(1, 2, 3)}) {
            const glm::dvec3 place(loaded.meta().grid.worldFromIndex * glm::dvec4(index, 1.0));
            const glm::dvec3 expected = kOrigin + kDirection * (kSteps * index);
            EXPECT_LT(glm::distance(place, expected), tolerance) << file << " at " << text(index, " ");
        }
    }

    std::vector<short> samples_ = ramp<short>(24);
};

TEST_F(WorldPhantom, NrrdInEverySpace) {
    for (const auto& [space, mirror] : {std::pair{"right-anterior-superior", glm::dvec3(1)},
                                        std::pair{"left-anterior-superior", glm::dvec3(-1, 1, 1)},
                                        std::pair{"left-posterior-superior", kToLps}}) {
        std::string directions;
        for (int axis = 0; axis < 3; ++axis)
            directions += " " + vector(mirror * kDirection[axis] * kSteps[axis]);
        expectPhantom(write(
            "a.nrrd", std::string("NRRD0004\ntype: short\ndimension: 3\nsizes: 2 3 4\nendian: "
                                  "little\nencoding: raw\nspace: ") +
                          space + "\nspace directions:" + directions +
                          "\nspace origin: " + vector(mirror * kOrigin) + "\n\n" + littleEndian(samples_)));
    }
}

TEST_F(WorldPhantom, MetaImage) {
    std::string rows;
    for (int axis = 0; axis < 3; ++axis)
        rows += " " + text(kToLps * kDirection[axis], " ");
    expectPhantom(
        write("a.mha", "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
                       "TransformMatrix =" +
                           rows + "\nOffset = " + text(kToLps * kOrigin, " ") +
                           "\nElementSpacing = " + text(kSteps, " ") +
                           "\nDimSize = 2 3 4\nElementType = MET_SHORT\nElementDataFile = LOCAL\n" +
                           littleEndian(samples_)));
}

TEST_F(WorldPhantom, NiftiBySform) {
    std::vector<double> rows;
    for (int row = 0; row < 3; ++row) {
        for (int axis = 0; axis < 3; ++axis)
            rows.push_back(kDirection[axis][row] * kSteps[axis]);
        rows.push_back(kOrigin[row]);
    }
    for (const int version : {1, 2}) {
        NiftiBytes bytes(version, false, {2, 3, 4}, 4);
        bytes.setSform(rows);
        expectPhantom(write("a.nii", bytes.with(littleEndian(samples_))), version == 1 ? 1e-5 : 1e-12);
    }
}

TEST_F(WorldPhantom, NiftiByQform) {
    // Half angles: about z cos 2/sqrt(5), sin 1/sqrt(5); about x 3/sqrt(10), 1/sqrt(10); x after z.
    const double whole = std::sqrt(50.0);
    for (const int version : {1, 2}) {
        NiftiBytes bytes(version, false, {2, 3, 4}, 4);
        bytes.setQform(2.0 / whole, -1.0 / whole, 3.0 / whole, kOrigin.x, kOrigin.y, kOrigin.z);
        bytes.setPixdim(0, 1.0);
        for (int axis = 0; axis < 3; ++axis)
            bytes.setPixdim(static_cast<std::size_t>(axis) + 1, kSteps[axis]);
        expectPhantom(write("a.nii", bytes.with(littleEndian(samples_))), version == 1 ? 1e-5 : 1e-12);
    }
}

TEST_F(WorldPhantom, RawWithASidecar) {
    const glm::dmat3 rows = glm::transpose(kDirection);
    write("a.raw", littleEndian(samples_));
    expectPhantom(write("a.json", R"({"dims": [2, 3, 4], "type": "i16", "anatomical": true, "direction": [)" +
                                      text(rows[0], ",") + "," + text(rows[1], ",") + "," +
                                      text(rows[2], ",") + R"(], "spacing": [)" + text(kSteps, ",") +
                                      R"(], "origin": [)" + text(kOrigin, ",") + "]}"));
}

} // namespace
} // namespace voxsheet::import::testing
