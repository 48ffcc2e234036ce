// The phantom in the formats that hold an anatomical orientation.
#include "nifti_bytes.h"
#include "world_phantom.h"

namespace voxsheet::import::testing {
namespace {

std::string inBrackets(const glm::dvec3& v) { return "(" + text(v, ",") + ")"; }

TEST_F(WorldPhantom, NrrdInEverySpace) {
    struct Space {
        const char* name;
        glm::dvec3 mirror;
        bool anatomical;
    };
    for (const auto& [space, mirror, anatomical] :
         {Space{"right-anterior-superior", glm::dvec3(1), true},
          Space{"left-anterior-superior", glm::dvec3(-1, 1, 1), true},
          Space{"left-posterior-superior", kToLps, true}, Space{"scanner-xyz", glm::dvec3(1), false},
          Space{"3D-right-handed", glm::dvec3(1), false},
          Space{"3D-left-handed", glm::dvec3(1, 1, -1), false}}) {
        std::string directions;
        for (int axis = 0; axis < 3; ++axis)
            directions += " " + inBrackets(mirror * kDirection[axis] * kSteps[axis]);
        expectPhantom(
            write("a.nrrd", std::string("NRRD0004\ntype: short\ndimension: 3\nsizes: 2 3 4\nendian: "
                                        "little\nencoding: raw\nspace: ") +
                                space + "\nspace directions:" + directions + "\nspace origin: " +
                                inBrackets(mirror * kOrigin) + "\n\n" + littleEndian(samples_)),
            samples_, {kDirection, kOrigin, anatomical, glm::bvec3(false)});
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
