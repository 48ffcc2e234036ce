// Several volumes in one picture, each with its own transfer function, against the double-precision truth.
#include "base/errors.h"
#include "image/inside_scene.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace voxsheet::image {
namespace {

constexpr int kPixels = 80;
constexpr double kAlmostSame = 100.0; ///< dB

class Layers : public InsideScene {
protected:
    Layers() { add(fields::gaussianSum(), grid, ScalarType::F32, "base"); }

    TileSpec baseTile() {
        auto tile = fields::tileOf("base", grid, Technique::Raycast, kPixels);
        tile.transfer = fields::filledTable(0.1, 1.2);
        return tile;
    }
    static std::shared_ptr<const TransferTable> tableOf(const glm::dvec3& rgb, double low, double high,
                                                        double opacity,
                                                        ValueScale scale = ValueScale::Linear) {
        TransferFunction function;
        function.low = low;
        function.high = high;
        function.scale = scale;
        function.colours = {{0.0, 0.5 * rgb}, {1.0, rgb}};
        function.opacities = {{0.0, 0.0}, {0.3, 0.0}, {1.0, opacity}};
        return buildTransferTable(function);
    }
    static VolumeLayer layerOf(const std::string& key, std::shared_ptr<const TransferTable> table) {
        VolumeLayer layer;
        layer.dataset = key;
        layer.transfer = std::move(table);
        return layer;
    }
    /// Another grid in the same world, off centre.
    Grid otherGrid(fields::Geometry geometry, int samples, bool periodic) const {
        auto other = fields::gridOf(geometry, samples);
        const auto shift = centreWorld(grid) - centreWorld(other) + glm::dvec3(5.0, -3.0, 2.0);
        other.worldFromIndex[3] += glm::dvec4(shift, 0.0);
        other.periodic = glm::bvec3(periodic);
        return other;
    }
    double decibels(const fields::Picture& a, const fields::Picture& b, std::size_t leastPixels = 1000) {
        const auto same = fields::difference(a, b);
        EXPECT_GE(same.pixels, leastPixels);
        return std::min(same.psnr, same.psnrAlpha);
    }
    /// Leaping over empty space changes nothing.
    void sameWithoutSkipping(const TileSpec& tile, std::size_t leastPixels = 1000) {
        const auto skipped = painter.draw(tile);
        painter.techniques().setEmptySpaceSkipping(false);
        const auto whole = painter.draw(tile);
        painter.techniques().setEmptySpaceSkipping(true);
        EXPECT_GT(decibels(skipped, whole, leastPixels), kAlmostSame);
    }

    Grid grid = fields::gridOf(fields::Geometry::Isotropic, 32);
    std::shared_ptr<const TransferTable> green = tableOf({0.2, 0.9, 0.3}, 0.0, 1.0, 0.3);
};

TEST_F(Layers, OnTheSameGrid) {
    add(fields::marschnerLobb(), grid, ScalarType::U8, "waves");
    add(fields::sphereDistance(0.7), grid, ScalarType::F32, "ball");
    for (const auto projection : {Projection::Perspective, Projection::Orthographic}) {
        auto tile = baseTile();
        tile.camera = fields::cameraOf(grid, projection);
        const auto alone = painter.draw(tile);
        tile.layers.volumes = {layerOf("waves", green)};
        const auto two = agree(tile);
        EXPECT_LT(decibels(alone, two), 30.0) << "the layer shows";
        tile.layers.volumes.push_back(layerOf("ball", tableOf({0.9, 0.2, 0.1}, -0.7, 1.0, 0.2)));
        const auto three = agree(tile);
        EXPECT_LT(decibels(two, three), 30.0) << "the second layer shows";
        tile.layers.volumes.push_back(layerOf("base", tableOf({0.1, 0.3, 0.9}, 0.5, 1.5, 0.5)));
        (void)agree(tile);
        sameWithoutSkipping(tile);
    }
}

TEST_F(Layers, OnOtherGridsInTheSameWorld) {
    for (const auto geometry : {fields::Geometry::Anisotropic, fields::Geometry::Sheared})
        for (const auto type : {ScalarType::U8, ScalarType::F32})
            for (const bool periodic : {false, true}) {
                const auto key =
                    std::string(fields::nameOf(geometry)) + scalarName(type) + (periodic ? "p" : "");
                add(fields::marschnerLobb(), otherGrid(geometry, 23, periodic), type, key);
                auto tile = baseTile();
                tile.layers.volumes = {layerOf(key, green)};
                tile.layers.volumes[0].unitLengthWorld = 1.7;
                (void)agree(tile);
                sameWithoutSkipping(tile);
                tile.shading.enabled = true;
                tile.shading.lightsView = {glm::normalize(glm::dvec3(1.0, 2.0, 1.0))};
                tile.layers.volumes[0].level = 1;
                (void)agree(tile);
            }
}

TEST_F(Layers, MuchFinerOrCoarserThanTheDrawnVolumeAreNotSkipped) {
    // Voxels a seventh as large, and three times as large.
    for (const int samples : {160, 9}) {
        auto other = fields::gridOf(fields::Geometry::Sheared, samples);
        const double scale = 0.8 * boundingRadiusWorld(grid) / boundingRadiusWorld(other);
        for (int axis = 0; axis < 3; ++axis)
            other.worldFromIndex[axis] *= scale;
        other.worldFromIndex[3] += glm::dvec4(centreWorld(grid) - centreWorld(other) + glm::dvec3(3.0), 0.0);
        const auto key = "shell" + std::to_string(samples);
        add(fields::gaussianSum(), other, ScalarType::U16, key);
        auto tile = baseTile();
        tile.transfer = tableOf({1.0, 1.0, 1.0}, 5.0, 6.0, 0.5); // The drawn volume shows nothing.
        tile.layers.volumes = {layerOf(key, tableOf({0.9, 0.8, 0.2}, 0.1, 1.0, 0.6))};
        tile.layers.volumes[0].unitLengthWorld = 0.5;
        for (const double distance : {0.25, 0.5, 3.0}) {
            tile.sampleDistanceVoxels = distance;
            (void)agree(tile, 45.0, 150);
            sameWithoutSkipping(tile, 150);
        }
    }
}

TEST_F(Layers, ObeyPlanesAndClipObjects) {
    add(fields::marschnerLobb(), otherGrid(fields::Geometry::Sheared, 25, false), ScalarType::F32, "waves");
    addBall("ball");
    for (const bool shading : {false, true})
        for (const auto mode : {ClipMode::Probe, ClipMode::Clip}) {
            auto tile = baseTile();
            tile.shading.enabled = shading;
            tile.layers.volumes = {layerOf("waves", green)};
            tile.clip.planes = {planeThrough(grid, glm::dvec3(0.45), {0.3, 1.0, -0.5})};
            (void)agree(tile);
            const auto object = painter.provider().describe("ball")->grid;
            tile.clip.object = ClipObject{"ball", objectOver(object, grid, 0.6), mode, false};
            (void)agree(tile, 40.0); // Crossings of the object are found in 32-bit floats.
        }
}

TEST_F(Layers, WithoutWeightAreNotThere) {
    add(fields::marschnerLobb(), otherGrid(fields::Geometry::Sheared, 25, true), ScalarType::F32, "waves");
    for (const bool shading : {false, true}) {
        auto tile = baseTile();
        tile.shading.enabled = shading;
        tile.sampleDistanceVoxels = 0.6; // closer samples share normals where there are no layers
        const auto alone = painter.draw(tile);
        tile.layers.volumes = {layerOf("waves", green)};
        tile.layers.volumes[0].weight = 0.0;
        EXPECT_GT(decibels(alone, painter.draw(tile)), kAlmostSame);
        tile.layers.volumes[0].weight = 0.4;
        tile.layers.ownWeight = 0.7;
        (void)agree(tile);
        tile.layers.ownWeight = 0.0;
        (void)agree(tile);
    }
}

TEST_F(Layers, AreAsGoodAsTheDrawnVolume) {
    add(fields::marschnerLobb(), grid, ScalarType::F32, "waves");
    for (const bool shading : {false, true}) {
        auto tile = baseTile();
        tile.shading.enabled = shading;
        tile.layers.volumes = {layerOf("waves", green)};
        tile.layers.volumes[0].unitLengthWorld = 2.0;
        auto swapped = tile;
        std::swap(swapped.dataset, swapped.layers.volumes[0].dataset);
        std::swap(swapped.transfer, swapped.layers.volumes[0].transfer);
        std::swap(swapped.unitLengthWorld, swapped.layers.volumes[0].unitLengthWorld);
        EXPECT_GT(decibels(painter.draw(tile), painter.draw(swapped)), 90.0);
    }
}

TEST_F(Layers, TwiceTheSameVolumeIsTwiceItsDensity) {
    auto tile = baseTile();
    auto half = tile;
    half.unitLengthWorld *= 0.5;
    tile.layers.volumes = {layerOf("base", tile.transfer)};
    EXPECT_GT(decibels(painter.draw(tile), painter.draw(half)), 90.0);
}

TEST_F(Layers, LeaveOutSamplesWithoutAValue) {
    auto sampled = fields::sampleField(fields::marschnerLobb(), grid, ScalarType::F32, "holes");
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t i = 0; i < sampled.arrays[0].size() / sizeof(float) / 2; ++i)
        std::memcpy(sampled.arrays[0].data() + i * sizeof(float), &nan, sizeof nan);
    add(std::move(sampled));
    auto tile = baseTile();
    tile.layers.volumes = {layerOf("holes", green)};
    (void)agree(tile);
    // And the other way round: where the drawn volume has none, its layers still show.
    tile.dataset = "holes";
    tile.layers.volumes = {layerOf("base", green)};
    (void)agree(tile);
}

TEST_F(Layers, LogarithmicTables) {
    auto field = fields::gaussianSum();
    const auto base = field.value;
    field.value = [base](const glm::dvec3& p) { return 1e-4 * std::pow(10.0, 4.0 * base(p)); };
    add(field, grid, ScalarType::F32, "decades");
    auto tile = baseTile();
    tile.layers.volumes = {layerOf("decades", tableOf({0.9, 0.3, 0.2}, 1e-4, 1e-1, 0.5, ValueScale::Log)),
                           layerOf("decades", tableOf({0.2, 0.3, 0.9}, 1e-4, 1e-2, 0.1))};
    (void)agree(tile);
}

TEST_F(Layers, TheShaderCanFilterThemForItself) {
    add(fields::marschnerLobb(), otherGrid(fields::Geometry::Sheared, 25, true), ScalarType::F32, "waves");
    auto tile = baseTile();
    tile.shading.enabled = true;
    tile.layers.volumes = {layerOf("waves", green)};
    const auto filtered = painter.draw(tile);
    painter.techniques().setShaderFiltering(true);
    EXPECT_GT(decibels(filtered, painter.draw(tile)), 60.0); // As for the drawn volume.
}

TEST_F(Layers, OfOneVolumeShareItsTexture) {
    auto tile = baseTile();
    tile.layers.volumes = {layerOf("base", green), layerOf("base", tile.transfer)};
    (void)painter.draw(tile);
    EXPECT_EQ(painter.residency().state().textures, 1);
}

TEST_F(Layers, RefusesWhatItCannotBlend) {
    const auto fieldAtFault = [&](const TileSpec& tile) {
        try {
            (void)painter.draw(tile);
        } catch (const InvalidInput& error) {
            return error.field();
        }
        return std::string("none");
    };
    auto tile = baseTile();
    tile.layers.volumes = {layerOf("base", green)};
    for (const auto technique :
         {Technique::Slices, Technique::Mip, Technique::Surface, Technique::Isosurface}) {
        tile.technique = technique;
        EXPECT_EQ(fieldAtFault(tile), "layers") << fields::nameOf(technique);
    }
    tile.technique = Technique::Raycast;
    tile.layers.volumes[0].weight = 1.5;
    EXPECT_EQ(fieldAtFault(tile), "layers.weights");
    tile.layers.volumes.assign(4, layerOf("base", green));
    EXPECT_EQ(fieldAtFault(tile), "layers");
}

} // namespace
} // namespace voxsheet::image
