// The phantom in formats of materials and of VTK, and in those that hold steps alone: what a format cannot
// say stays as it is without it, or comes from options.
#include "tiff_bytes.h"
#include "world_phantom.h"

#include <cstdio>

namespace voxsheet::import::testing {
namespace {

constexpr double kAngstromPerBohr = 0.529177210903; // CODATA 2018, as Gaussian's cube files mean it

const PhantomPlace kTurned{kDirection, kOrigin, false, glm::bvec3(false)};
const PhantomPlace kUpright{glm::dmat3(1.0), kOrigin, false, glm::bvec3(false)};
const PhantomPlace kUprightAtZero{glm::dmat3(1.0), glm::dvec3(0.0), false, glm::bvec3(false)};

class WorldPhantomFurther : public WorldPhantom {
protected:
    /// Numbers with few digits, all different, whatever their order.
    std::vector<double> numbers_ = [] {
        std::vector<double> values;
        for (int i = 0; i < 24; ++i)
            values.push_back(3.0 * i - 7.0);
        return values;
    }();

    [[nodiscard]] double at(int x, int y, int z) const {
        return numbers_[static_cast<std::size_t>(x + kDims.x * (y + kDims.y * z))];
    }
    /// In the order of the file format, several in a line.
    [[nodiscard]] std::string inLines(bool zFastest, const glm::ivec3& samples) const {
        std::string lines;
        int column = 0;
        const auto add = [&](int x, int y, int z) {
            lines += " " + text(at(x % kDims.x, y % kDims.y, z % kDims.z)) + (++column % 6 == 0 ? "\n" : "");
        };
        const auto outer = zFastest ? samples.x : samples.z;
        const auto inner = zFastest ? samples.z : samples.x;
        for (int a = 0; a < outer; ++a)
            for (int y = 0; y < samples.y; ++y)
                for (int c = 0; c < inner; ++c)
                    zFastest ? add(a, y, c) : add(c, y, a);
        return lines + "\n";
    }
    /// What the periodic formats write of a cell: its three edges, a line each.
    static std::string edges(const glm::dvec3& samples) {
        std::string lines;
        for (int axis = 0; axis < 3; ++axis)
            lines += " " + text(kDirection[axis] * kSteps[axis] * samples[axis]) + "\n";
        return lines;
    }
};

TEST_F(WorldPhantomFurther, VtiHoldsATurnedImage) {
    if (ReaderRegistry().descriptions().find(".vti") == std::string::npos)
        GTEST_SKIP() << "this build is without VTK";
    const auto rows = glm::transpose(kDirection);
    // The extent begins elsewhere: the image's origin is that of index 0.
    const glm::dvec3 first(4, -2, 10);
    std::string numbers;
    for (const short sample : samples_)
        numbers += std::to_string(sample) + " ";
    expectPhantom(write("a.vti", "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" "
                                 "byte_order=\"LittleEndian\">\n<ImageData WholeExtent=\"4 5 -2 0 10 13\" "
                                 "Origin=\"" +
                                     text(kOrigin - kDirection * (kSteps * first)) + "\" Spacing=\"" +
                                     text(kSteps) + "\" Direction=\"" + text(rows[0]) + " " + text(rows[1]) +
                                     " " + text(rows[2]) +
                                     "\">\n<Piece Extent=\"4 5 -2 0 10 13\"><PointData>"
                                     "<DataArray type=\"Int16\" Name=\"v\" format=\"ascii\">" +
                                     numbers + "</DataArray></PointData></Piece></ImageData></VTKFile>\n"),
                  samples_, kTurned);
}

TEST_F(WorldPhantomFurther, LegacyVtk) {
    expectPhantom(write("a.vtk", "# vtk DataFile Version 3.0\nx\nBINARY\nDATASET STRUCTURED_POINTS\n"
                                 "DIMENSIONS 2 3 4\nORIGIN " +
                                     text(kOrigin) + "\nSPACING " + text(kSteps) +
                                     "\nPOINT_DATA 24\nSCALARS v short 1\nLOOKUP_TABLE default\n" +
                                     bigEndian(samples_)),
                  samples_, kUpright);
}

TEST_F(WorldPhantomFurther, TiffWithOptions) {
    const auto file = folder_ / "a.tif";
    TiffPageOptions page;
    page.width = 2;
    page.height = 3;
    writeTiff(file, page, 4, samples_);
    ImportOptions options;
    options.spacing = kSteps;
    options.origin = kOrigin;
    expectPhantom(file, samples_, kUpright, 1e-12, options);
    // Mirrored within the box: the first row is where the last one was.
    options.flip = glm::bvec3(false, true, false);
    auto mirrored = kUpright;
    mirrored.direction[1] = -mirrored.direction[1];
    mirrored.origin.y += 2.0 * kSteps.y;
    expectPhantom(file, samples_, mirrored, 1e-12, options);
}

TEST_F(WorldPhantomFurther, Slc) {
    std::vector<unsigned char> bytes(24);
    for (std::size_t i = 0; i < 24; ++i)
        bytes[i] = static_cast<unsigned char>(7 * i + 3);
    expectPhantom(
        write("a.slc", "11111\n2 3 4 8\n" + text(kSteps) + "\n1 6 0 0\n2 1 Xabcdef" + bytesOf(bytes)), bytes,
        kUprightAtZero);
}

TEST_F(WorldPhantomFurther, Chgcar) {
    // Values for an electrostatic potential are not divided by the volume.
    PhantomPlace place{kDirection, glm::dvec3(0.0), false, glm::bvec3(true)};
    expectPhantom(write("LOCPOT", "x\n 1.0\n" + edges(kDims) + " H\n 1\nDirect\n 0 0 0\n\n 2 3 4\n" +
                                      inLines(false, kDims)),
                  numbers_, place, 1e-9);
    ImportOptions options;
    options.origin = kOrigin;
    place.origin = kOrigin;
    expectPhantom(folder_ / "LOCPOT", numbers_, place, 1e-9, options);
}

TEST_F(WorldPhantomFurther, CubeInBohrAndAngstrom) {
    for (const double unit : {kAngstromPerBohr, 1.0}) {
        std::string axes;
        for (int axis = 0; axis < 3; ++axis)
            axes += (unit == 1.0 ? " -" : " ") + std::to_string(kDims[axis]) + " " +
                    text(kDirection[axis] * kSteps[axis] / unit) + "\n";
        expectPhantom(write("a.cube", "x\ny\n 1 " + text(kOrigin / unit) + "\n" + axes + " 1 1 0 0 0\n" +
                                          inLines(true, kDims)),
                      numbers_, kTurned, 1e-9);
    }
}

TEST_F(WorldPhantomFurther, XsfOfAMoleculeAndOfACrystal) {
    const auto grid = [&](const std::string& head, const glm::ivec3& samples, const glm::dvec3& spans) {
        return head + "BEGIN_BLOCK_DATAGRID_3D\nx\nBEGIN_DATAGRID_3D_x\n " + std::to_string(samples.x) + " " +
               std::to_string(samples.y) + " " + std::to_string(samples.z) + "\n " + text(kOrigin) + "\n" +
               edges(spans) + inLines(false, samples) + "END_DATAGRID_3D\nEND_BLOCK_DATAGRID_3D\n";
    };
    expectPhantom(write("molecule.xsf", grid("MOLECULE\nATOMS\n 1 0 0 0\n", kDims, kDims - 1)), numbers_,
                  kTurned, 1e-9);
    auto place = kTurned;
    place.periodic = glm::bvec3(true);
    expectPhantom(
        write("crystal.xsf",
              grid("CRYSTAL\nPRIMVEC\n" + edges(kDims) + "PRIMCOORD\n 1 1\n 1 0 0 0\n", kDims + 1, kDims)),
        numbers_, place, 1e-9);
}

} // namespace
} // namespace voxsheet::import::testing
