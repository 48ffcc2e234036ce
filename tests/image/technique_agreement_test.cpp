// Every technique on every kind of sample, geometry and projection, against the double-precision integrator
// at the same sample positions (is the technique right?) and against the converged integral (how good is the
// picture?).
#include "fields/integrator.h"
#include "fields/scenes.h"
#include "image/png_writer.h"
#include "image/tile_painter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace voxsheet::image {
namespace {

constexpr double kRequiredPsnr = 45.0;
constexpr int kSamples = 40;
constexpr int kPixels = 96;

using Case = std::tuple<Technique, ScalarType, fields::Geometry, Projection>;

std::string caseName(const testing::TestParamInfo<Case>& info) {
    const auto [technique, type, geometry, projection] = info.param;
    return std::string(fields::nameOf(technique)) + "_" + scalarName(type) + "_" + fields::nameOf(geometry) +
           "_" + fields::nameOf(projection);
}

class TechniqueAgreement : public testing::TestWithParam<Case> {};

void check(TilePainter& painter, const TileSpec& tile, const Grid& grid, const std::string& name) {
    const fields::Interpolant interpolant(painter.volumes(), {tile.dataset, 0, 0, 0});
    const auto value = [&](const glm::dvec3& texture) { return interpolant.at(texture); };
    const auto picture = painter.draw(tile);
    const auto same =
        fields::difference(picture, fields::integrateLikeTechnique(tile, grid, grid.dims, value));
    const auto converged =
        fields::difference(picture, fields::integrateConverged(tile, grid, grid.dims, value, 1.0 / 12.0));
    std::printf("%-60s same positions %6.1f dB (alpha %5.1f, p99.9 %.1e)   converged %5.1f dB (p99.9 %.1e)   "
                "%zu pixels\n",
                name.c_str(), same.psnr, same.psnrAlpha, same.p999, converged.psnr, converged.p999,
                same.pixels);
    EXPECT_GE(same.psnr, kRequiredPsnr) << name;
    EXPECT_GE(same.psnrAlpha, kRequiredPsnr) << name;
    EXPECT_LE(same.p999, 0.01) << name;
    EXPECT_GE(converged.psnr, 35.0) << name;
    EXPECT_GT(same.pixels, 500U) << name;
    const std::string folder = VOXSHEET_BINARY_DIR "/tests/image/pictures";
    std::filesystem::create_directories(folder);
    std::string file = name;
    std::replace(file.begin(), file.end(), ' ', '_');
    writePng(folder + "/" + file + ".png", picture);
}

TEST_P(TechniqueAgreement, WithTheIntegrator) {
    const auto [technique, type, geometry, projection] = GetParam();
    TilePainter painter;
    const auto grid = fields::gridOf(geometry, kSamples);
    for (const auto& field :
         {fields::gaussianSum(), fields::marschnerLobb(), fields::sphereDistance(), fields::linearRamp()}) {
        auto sampled = fields::sampleField(field, grid, type, field.name);
        painter.volumes().add(std::move(sampled.meta), std::move(sampled.arrays));
        auto tile = fields::tileOf(field.name, grid, technique, kPixels);
        tile.camera = fields::cameraOf(grid, projection);
        tile.transfer = field.name == "sphere distance" ? fields::sparseTable(field.low, field.high)
                                                        : fields::filledTable(field.low, field.high);
        check(painter, tile, grid, caseName({GetParam(), 0}) + " " + field.name);
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, TechniqueAgreement,
    testing::Combine(testing::Values(Technique::Raycast, Technique::Slices, Technique::Mip),
                     testing::Values(ScalarType::U8, ScalarType::U16, ScalarType::F32),
                     testing::Values(fields::Geometry::Isotropic, fields::Geometry::Anisotropic,
                                     fields::Geometry::Sheared),
                     testing::Values(Projection::Perspective, Projection::Orthographic)),
    caseName);

} // namespace
} // namespace voxsheet::image
