// Each technique x shading x texture format x projection against the double-precision truth.
#include "fields/hit_map.h"
#include "image/inside_scene.h"
#include "volume/texture_encoding.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cstring>

namespace voxsheet::image {
namespace {

constexpr int kPixels = 64;
constexpr int kSamples = 32;

enum class Light { None, SixTaps, GradientTexture };
enum class Format { U8, U16, F32, Half };

const char* nameOf(Light light) {
    return light == Light::None ? "unlit" : light == Light::SixTaps ? "six taps" : "texture";
}
const char* nameOf(Format format) {
    return format == Format::U8    ? "u8"
           : format == Format::U16 ? "u16"
           : format == Format::F32 ? "f32"
                                   : "half";
}

/// The samples as a half-float texture holds them.
void roundToHalf(fields::SampledField& sampled) {
    const auto count = static_cast<std::size_t>(sampleCount(sampled.meta.grid.dims));
    std::vector<float> values(count);
    std::memcpy(values.data(), sampled.arrays[0].data(), count * sizeof(float));
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const auto encoding =
        chooseTextureEncoding(ScalarType::F32, double(*low), double(*high), false, FloatTexels::Half);
    std::vector<std::byte> texels(count * 2);
    encodeTexels(ScalarType::F32, encoding, sampled.arrays[0], texels);
    for (std::size_t i = 0; i < count; ++i) {
        std::uint16_t bits = 0;
        std::memcpy(&bits, texels.data() + 2 * i, 2);
        values[i] = static_cast<float>(encoding.storedScale * double(glm::unpackHalf1x16(bits)) +
                                       encoding.storedOffset);
    }
    std::memcpy(sampled.arrays[0].data(), values.data(), count * sizeof(float));
}

class TechniqueMatrix : public InsideScene, public testing::WithParamInterface<Technique> {
protected:
    TechniqueMatrix() {
        grid.worldFromIndex = fields::gridOf(fields::Geometry::Anisotropic, kSamples).worldFromIndex;
        for (const auto format : {Format::U8, Format::U16, Format::F32, Format::Half}) {
            const auto type = format == Format::U8    ? ScalarType::U8
                              : format == Format::U16 ? ScalarType::U16
                                                      : ScalarType::F32;
            auto sampled = fields::sampleField(field, grid, type, nameOf(format));
            auto held = sampled;
            if (format == Format::Half) roundToHalf(held);
            painter.volumes().add(std::move(sampled.meta), std::move(sampled.arrays));
            held.meta.key = std::string("held as ") + nameOf(format);
            painter.volumes().add(std::move(held.meta), std::move(held.arrays));
        }
    }

    TileSpec tileOf(Light light, Format format, Projection projection) {
        auto tile = fields::tileOf(nameOf(format), grid, GetParam(), kPixels);
        tile.camera = fields::cameraOf(grid, projection);
        tile.transfer = fields::filledTable(field.low, field.high);
        tile.unitLengthWorld *= 0.5;
        tile.floatTexels = format == Format::Half ? FloatTexels::Half : FloatTexels::Full;
        tile.clip.planes = {planeThrough(grid, {0.6, 0.5, 0.8}, {-0.5, 0.1, -1.0})};
        tile.isosurface.surfaces = {{0.1, {0.2F, 0.6F, 0.9F, 0.4F}}, {0.3, {0.9F, 0.6F, 0.3F, 1.0F}}};
        tile.isosurface.caps = true;
        tile.shading.enabled = light != Light::None;
        tile.shading.gradient =
            light == Light::GradientTexture ? GradientSource::Texture : GradientSource::OnTheFly;
        tile.shading.headLight = 0.5;
        tile.shading.lightsView = {glm::normalize(glm::dvec3(0.5, 0.8, 0.4))};
        return tile;
    }

    /// Where neighbouring surfaces or faces meet, a pixel may show either.
    std::vector<bool> edgesOf(const TileSpec& tile, const fields::Sources& sources) const {
        const double jump = 3.0 * meanVoxelEdgeWorld(grid);
        if (tile.technique == Technique::Isosurface)
            return fields::silhouettes(fields::isosurfaceHits(tile, sources), tile.sizePixels, jump);
        if (tile.technique == Technique::Surface)
            return fields::silhouettes(fields::faceHits(tile, sources), tile.sizePixels, jump);
        return std::vector<bool>(static_cast<std::size_t>(kPixels * kPixels));
    }

    fields::AnalyticField field = fields::gaussianSum();
    Grid grid = fields::gridOf(fields::Geometry::Sheared, kSamples);
};

TEST_P(TechniqueMatrix, AgreesWithTheTruth) {
    for (const auto light : {Light::None, Light::SixTaps, Light::GradientTexture})
        for (const auto format : {Format::U8, Format::U16, Format::F32, Format::Half})
            for (const auto projection : {Projection::Perspective, Projection::Orthographic}) {
                const auto tile = tileOf(light, format, projection);
                auto asHeld = tile;
                asHeld.dataset = std::string("held as ") + nameOf(format);
                const auto sources = fields::sourcesOf(painter.provider(), asHeld);
                auto truth = fields::insidePicture(asHeld, sources);
                auto picture = painter.draw(tile);
                const auto edges = edgesOf(asHeld, sources);
                for (std::size_t i = 0; i < edges.size(); ++i)
                    if (edges[i]) truth.pixels[i] = picture.pixels[i] = glm::dvec4(0.0);
                const auto same = fields::difference(picture, truth);
                std::printf("%-10s %-8s %-4s %-12s %6.1f dB (alpha %6.1f, largest %.1e) %zu pixels\n",
                            fields::nameOf(GetParam()), nameOf(light), nameOf(format),
                            fields::nameOf(projection), same.psnr, same.psnrAlpha, same.largest, same.pixels);
                EXPECT_GE(same.psnr, 45.0);
                EXPECT_GE(same.psnrAlpha, 45.0);
                EXPECT_GE(same.pixels, 200U);
            }
}

INSTANTIATE_TEST_SUITE_P(All, TechniqueMatrix,
                         testing::Values(Technique::Raycast, Technique::Slices, Technique::Mip,
                                         Technique::Surface, Technique::Isosurface),
                         [](const testing::TestParamInfo<Technique>& tested) {
                             return fields::nameOf(tested.param);
                         });

} // namespace
} // namespace voxsheet::image
