// VTK's clipping planes, cropping and shading as a second opinion: our picture is no farther from the
// converged integral.
#include "fields/inside.h"
#include "fields/scenes.h"
#include "image/inside_scene.h"
#include "image/png_writer.h"
#include "image/vtk_peer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

namespace voxsheet::image {
namespace {

constexpr int kSamples = 40;
constexpr int kPixels = 128;

using VtkCase = std::tuple<fields::Geometry, Projection>;

class VtkClip : public testing::TestWithParam<VtkCase> {
protected:
    VtkClip() : grid(fields::gridOf(std::get<0>(GetParam()), kSamples)) {
        const auto field = fields::gaussianSum();
        sampled = fields::sampleField(field, grid, ScalarType::U16, "gauss");
        painter.volumes().add(sampled.meta, sampled.arrays);
        tile = fields::tileOf("gauss", grid, Technique::Raycast, kPixels);
        tile.camera = fields::cameraOf(grid, std::get<1>(GetParam()));
        tile.transfer = fields::filledTable(field.low, field.high);
        tile.unitLengthWorld *= 0.2; // bright pictures
    }

    void compare(VtkPeer& peer, const std::string& what) {
        const auto truth =
            fields::insideConverged(tile, fields::sourcesOf(painter.provider(), tile), 1.0 / 12.0);
        auto theirTile = tile;
        if (cropped) theirTile.clip.planes.clear();
        const auto theirs = peer.draw(theirTile);
        auto ours = painter.draw(tile);
        for (auto& pixel : ours.pixels)
            pixel = glm::round(pixel * 255.0) / 255.0; // what VTK hands out
        const auto ourDistance = fields::difference(ours, truth);
        const auto theirDistance = fields::difference(theirs, truth);
        const auto apart = fields::difference(ours, theirs);
        std::printf(
            "%-10s %-12s %-12s to the converged integral: voxsheet %.1f dB (p99.9 %.1e), VTK %.1f dB (p99.9 "
            "%.1e); apart %.1f dB\n",
            what.c_str(), fields::nameOf(std::get<0>(GetParam())), fields::nameOf(std::get<1>(GetParam())),
            ourDistance.psnr, ourDistance.p999, theirDistance.psnr, theirDistance.p999, apart.psnr);
        EXPECT_GE(ourDistance.psnr, 40.0) << what;
        EXPECT_GE(ourDistance.psnr, theirDistance.psnr - 1.0) << what;
        EXPECT_GE(apart.psnr, 25.0) << what << ": another scene gives less than 20 dB";
        EXPECT_GT(apart.pixels, 300U) << what;
        const std::string folder = VOXSHEET_BINARY_DIR "/tests/image/pictures";
        std::filesystem::create_directories(folder);
        const auto name = folder + "/vtk_" + what + "_" + fields::nameOf(std::get<0>(GetParam())) + "_" +
                          fields::nameOf(std::get<1>(GetParam()));
        writePng(name + ".png", theirs);
        writePng(name + "_voxsheet.png", ours);
    }

    Grid grid;
    fields::SampledField sampled;
    TilePainter painter;
    TileSpec tile;
    bool cropped = false;
};

TEST_P(VtkClip, Planes) {
    VtkPeer peer(sampled, VtkMapper::Gpu);
    tile.clip.planes = {planeThrough(grid, glm::dvec3(0.5), {-1.0, 0.2, -0.6}),
                        planeThrough(grid, glm::dvec3(0.6), {0.3, -1.0, 0.1})};
    compare(peer, "planes");
}

TEST_P(VtkClip, Box) {
    VtkPeer peer(sampled, VtkMapper::Gpu);
    const auto spacing = spacingWorld(grid);
    const auto low = glm::dvec3(6.3, 4.1, 11.7) * spacing;
    const auto high = glm::dvec3(30.2, 33.3, 28.9) * spacing;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 normal(0.0);
        normal[axis] = 1.0;
        tile.clip.planes.push_back({normal, low[axis]});
        tile.clip.planes.push_back({-normal, -high[axis]});
    }
    peer.crop(low, high);
    cropped = true;
    compare(peer, "box");
}

/// Orthographic only: VTK's head light shines along the view direction, ours from the eye.
class VtkLight : public VtkClip {};

TEST_P(VtkLight, HeadLight) {
    VtkPeer peer(sampled, VtkMapper::Gpu);
    tile.shading.enabled = true;
    tile.shading.specular = 0.2;
    tile.shading.shininess = 10.0;
    compare(peer, "light");
}

std::string caseName(const testing::TestParamInfo<VtkCase>& tested) {
    return std::string(fields::nameOf(std::get<0>(tested.param))) + "_" +
           fields::nameOf(std::get<1>(tested.param));
}

INSTANTIATE_TEST_SUITE_P(All, VtkClip,
                         testing::Combine(testing::Values(fields::Geometry::Isotropic,
                                                          fields::Geometry::Anisotropic),
                                          testing::Values(Projection::Perspective, Projection::Orthographic)),
                         caseName);
INSTANTIATE_TEST_SUITE_P(All, VtkLight,
                         testing::Combine(testing::Values(fields::Geometry::Isotropic,
                                                          fields::Geometry::Anisotropic),
                                          testing::Values(Projection::Orthographic)),
                         caseName);

} // namespace
} // namespace voxsheet::image
