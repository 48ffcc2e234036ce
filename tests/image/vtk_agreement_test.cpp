// VTK as a second opinion: an independent renderer on the same scene must give the same picture, up to its
// own errors.
#include "fields/integrator.h"
#include "fields/scenes.h"
#include "image/png_writer.h"
#include "image/tile_painter.h"
#include "image/vtk_peer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

namespace voxsheet::image {
namespace {

constexpr int kSamples = 40;
constexpr int kPixels = 128;

/// What VTK hands out: 8 bits per channel.
fields::Picture inEightBits(fields::Picture picture) {
    for (auto& pixel : picture.pixels)
        for (int channel = 0; channel < 4; ++channel)
            pixel[channel] = std::round(pixel[channel] * 255.0) / 255.0;
    return picture;
}

using Case = std::tuple<ScalarType, fields::Geometry, Projection>;

std::string caseName(const testing::TestParamInfo<Case>& info) {
    const auto [type, geometry, projection] = info.param;
    return std::string(scalarName(type)) + "_" + fields::nameOf(geometry) + "_" + fields::nameOf(projection);
}

class VtkAgreement : public testing::TestWithParam<Case> {};

TEST_P(VtkAgreement, IsNoNearerToTheTruth) {
    const auto [type, geometry, projection] = GetParam();
    const auto field = fields::gaussianSum();
    const auto grid = fields::gridOf(geometry, kSamples);
    const auto sampled = fields::sampleField(field, grid, type, "gauss");
    TilePainter painter;
    painter.volumes().add(sampled.meta, sampled.arrays);
    VtkPeer peer(sampled, VtkMapper::Gpu);
    const fields::Interpolant interpolant(painter.volumes(), {"gauss", 0, 0, 0});
    for (const bool filled : {true, false}) {
        auto tile = fields::tileOf("gauss", grid, Technique::Raycast, kPixels);
        tile.camera = fields::cameraOf(grid, projection);
        tile.transfer =
            filled ? fields::filledTable(field.low, field.high) : fields::sparseTable(field.low, field.high);
        const auto truth = fields::integrateConverged(
            tile, grid, grid.dims, [&](const glm::dvec3& texture) { return interpolant.at(texture); },
            1.0 / 12.0);
        const auto theirs = peer.draw(tile);
        const auto theirDistance = fields::difference(theirs, truth);
        for (const auto technique : {Technique::Raycast, Technique::Slices}) {
            tile.technique = technique;
            const auto ours = inEightBits(painter.draw(tile));
            const auto ourDistance = fields::difference(ours, truth);
            const auto apart = fields::difference(ours, theirs);
            std::printf("%s %s %-8s to the converged integral: voxsheet %.1f dB (p99.9 %.1e), VTK %.1f dB "
                        "(p99.9 %.1e); "
                        "apart %.1f dB\n",
                        caseName({GetParam(), 0}).c_str(), filled ? "filled" : "sparse",
                        fields::nameOf(technique), ourDistance.psnr, ourDistance.p999, theirDistance.psnr,
                        theirDistance.p999, apart.psnr);
            // At one distance of samples both are limited by it; the phase of the samples moves the figure by
            // half a decibel.
            EXPECT_GE(ourDistance.psnr, theirDistance.psnr - 1.0);
            // Two pictures of the same scene: a wrong camera, table, unit length or box gives 15 to 25 dB.
            EXPECT_GE(apart.psnr, 30.0);
            EXPECT_GT(apart.pixels, 300U);
        }
        const std::string folder = VOXSHEET_BINARY_DIR "/tests/image/pictures";
        std::filesystem::create_directories(folder);
        writePng(folder + "/vtk_" + caseName({GetParam(), 0}) + (filled ? "_filled.png" : "_sparse.png"),
                 theirs);
    }
}

INSTANTIATE_TEST_SUITE_P(All, VtkAgreement,
                         testing::Combine(testing::Values(ScalarType::U8, ScalarType::U16, ScalarType::F32),
                                          testing::Values(fields::Geometry::Isotropic,
                                                          fields::Geometry::Anisotropic),
                                          testing::Values(Projection::Perspective, Projection::Orthographic)),
                         caseName);

} // namespace
} // namespace voxsheet::image
