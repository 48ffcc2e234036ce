// One volume as NIfTI, NRRD and MetaImage gives one picture.
#include "../unit/import/nifti_bytes.h"
#include "engine_picture_fixture.h"

#include <algorithm>
#include <sstream>

namespace voxsheet::engine {
namespace {

/// Turned by 3-4-5 about z and then about x, in RAS; steps of 1.5, 1 and 2 mm.
const glm::dmat3 kAboutZ{0.6, 0.8, 0, -0.8, 0.6, 0, 0, 0, 1}; // columns
const glm::dmat3 kAboutX{1, 0, 0, 0, 0.8, 0.6, 0, -0.6, 0.8};
const glm::dmat3 kDirection = kAboutX * kAboutZ;
const glm::dvec3 kSteps{1.5, 1.0, 2.0};
const glm::dvec3 kOrigin{-31.0, 17.0, 40.0};
const glm::ivec3 kDims{24, 30, 16};

/// A body with a limb of its own along each axis, brighter from one limb to the next: no mirror image of it
/// looks like it.
std::string voxels() {
    std::string bytes;
    for (int k = 0; k < kDims.z; ++k)
        for (int j = 0; j < kDims.y; ++j)
            for (int i = 0; i < kDims.x; ++i) {
                std::int16_t value = 0;
                if (i >= 3 && i < 20 && j >= 4 && j < 8 && k >= 3 && k < 6) value = 300;
                if (i >= 3 && i < 7 && j >= 4 && j < 26 && k >= 3 && k < 6) value = 600;
                if (i >= 3 && i < 7 && j >= 4 && j < 8 && k >= 3 && k < 13) value = 900;
                bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
            }
    return bytes;
}

std::string text(const glm::dvec3& v, const char* between) {
    std::ostringstream out;
    out.precision(17);
    out << v.x << between << v.y << between << v.z;
    return out.str();
}

class FormatPictures : public EnginePicture {
protected:
    fs::path write(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder / name, std::ios::binary) << bytes;
        return folder / name;
    }
    fs::path nifti() const {
        import::testing::NiftiBytes header(2, false, {kDims.x, kDims.y, kDims.z}, 4);
        std::vector<double> rows;
        for (int row = 0; row < 3; ++row) {
            for (int axis = 0; axis < 3; ++axis)
                rows.push_back(kDirection[axis][row] * kSteps[axis]);
            rows.push_back(kOrigin[row]);
        }
        header.setSform(rows);
        return write("a.nii", header.with(voxels()));
    }
    /// \param mirror  of the world, from RAS to what the header speaks of
    fs::path nrrd(const std::string& name, const std::string& space, const glm::dvec3& mirror) const {
        std::string directions;
        for (int axis = 0; axis < 3; ++axis)
            directions += " (" + text(mirror * kDirection[axis] * kSteps[axis], ",") + ")";
        return write(name, "NRRD0004\ntype: short\ndimension: 3\nsizes: 24 30 16\nendian: little\n"
                           "encoding: raw\nspace: " +
                               space + "\nspace directions:" + directions + "\nspace origin: (" +
                               text(mirror * kOrigin, ",") + ")\n\n" + voxels());
    }
    fs::path metaImage() const {
        const glm::dvec3 toLps(-1, -1, 1);
        std::string rows;
        for (int axis = 0; axis < 3; ++axis)
            rows += " " + text(toLps * kDirection[axis], " ");
        return write("a.mha", "ObjectType = Image\nNDims = 3\nBinaryData = True\nTransformMatrix =" + rows +
                                  "\nOffset = " + text(toLps * kOrigin, " ") + "\nElementSpacing = " +
                                  text(kSteps, " ") + "\nDimSize = 24 30 16\nElementType = MET_SHORT\n" +
                                  "ElementDataFile = LOCAL\n" + voxels());
    }

    std::vector<unsigned char> picture(const char* cell, sheet::StyleMap style) {
        style["background"] = sheet::Colour{{0, 0, 0, 255}};
        style["camera.azimuth"] = 25.0;
        style["camera.elevation"] = 20.0;
        View view;
        view.request = std::move(style);
        TileQuality quality;
        quality.sizePixels = {160, 160};
        const PreparedTile tile =
            engine->prepareTile(*engine->snapshot(), "", sheet::parseAddress(cell), view, quality);
        EXPECT_TRUE(tile.spec) << tile.message;
        if (!tile.spec) return {};
        FrameSpec frame;
        frame.tiles.push_back(*tile.spec);
        auto rendered = engine->render(std::move(frame), FramePriority::Final).get();
        EXPECT_TRUE(rendered.tiles.at(0).error.empty()) << rendered.tiles.at(0).error;
        return rendered.tiles.at(0).rgba8;
    }

    /// Pixels that differ by more than rounding does.
    static int different(const std::vector<unsigned char>& a, const std::vector<unsigned char>& b) {
        EXPECT_EQ(a.size(), b.size());
        int count = 0;
        for (std::size_t pixel = 0; pixel + 3 < std::min(a.size(), b.size()); pixel += 4) {
            int most = 0;
            for (std::size_t channel = 0; channel < 3; ++channel)
                most = std::max(most, std::abs(a[pixel + channel] - b[pixel + channel]));
            count += most > 2 ? 1 : 0; // matrices of the last digit apart
        }
        return count;
    }
};

TEST_F(FormatPictures, OneVolumeGivesOnePicture) {
    // In A1, B1, A2 and B2; the last one is mirrored.
    open({metaImage(), nifti(), nrrd("b.nrrd", "left-posterior-superior", {-1, -1, 1}),
          nrrd("c.nrrd", "left-posterior-superior", {1, -1, 1})});
    const std::vector<sheet::StyleMap> styles{
        {{"technique", std::string("raycast")}},
        {{"technique", std::string("slices")}},
        {{"technique", std::string("isosurface")}},
        {{"technique", std::string("plane")}, {"plane.axis", std::string("coronal")}},
        {{"technique", std::string("plane")}, {"plane.axis", std::string("sagittal")}},
    };
    for (const auto& style : styles) {
        const auto name = std::get<std::string>(style.at("technique"));
        const auto first = picture("A1", style);
        const std::vector<unsigned char> nothing(first.size(), 0);
        EXPECT_GT(different(first, nothing), 200) << name << ": little is seen";
        EXPECT_EQ(different(first, picture("B1", style)), 0) << name << ": NIfTI";
        EXPECT_EQ(different(first, picture("A2", style)), 0) << name << ": NRRD";
        // The mirror is the sagittal plane itself.
        if (style.contains("plane.axis") && std::get<std::string>(style.at("plane.axis")) == "sagittal")
            continue;
        EXPECT_GT(different(first, picture("B2", style)), 200) << name << ": its mirror image looks like it";
    }
}

} // namespace
} // namespace voxsheet::engine
