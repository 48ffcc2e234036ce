// Label maps, and volumes painted over planes, against the double-precision truth.
#include "base/errors.h"
#include "image/inside_scene.h"

#include <cmath>
#include <set>
#include <tuple>

namespace voxsheet::image {
namespace {

constexpr int kPixels = 96;

/// Eight whole numbers in blocks and shells.
fields::AnalyticField labelField() {
    fields::AnalyticField field;
    field.low = 0.0;
    field.high = 7.0;
    field.value = [](const glm::dvec3& p) {
        const double shell = std::floor(4.0 * glm::length(p));
        return std::clamp(shell + (p.x > 0.1 ? 3.0 : 0.0), 0.0, 7.0);
    };
    return field;
}

/// A colour of its own for each number; `clear` of them are.
std::shared_ptr<const TransferTable> labelTable(const std::set<int>& clear, float opacity) {
    auto table = std::make_shared<TransferTable>();
    table->low = 0.0;
    table->high = 7.0;
    for (int i = 0; i < 8; ++i)
        table->entries.emplace_back(i & 1 ? 1.0F : 0.2F, i & 2 ? 1.0F : 0.2F, i & 4 ? 1.0F : 0.2F,
                                    clear.contains(i) ? 0.0F : opacity);
    return table;
}

std::shared_ptr<const TransferTable> ramp(double low, double high) {
    TransferFunction function;
    function.low = low;
    function.high = high;
    function.colours = {{0.0, {0.0, 0.3, 1.0}}, {1.0, {1.0, 0.6, 0.0}}};
    function.opacities = {{0.0, 1.0}};
    function.nan = {0.2, 0.6, 0.4, 0.5};
    return buildTransferTable(function);
}

/// Whole numbers as they are: fields of integer types would be scaled to the type's range.
void addLabels(TilePainter& painter, const Grid& grid, const std::string& key) {
    auto sampled = fields::sampleField(labelField(), grid, ScalarType::F32, key);
    painter.volumes().add(std::move(sampled.meta), std::move(sampled.arrays));
}

class Categories : public InsideScene {
protected:
    static TileSpec flat(const std::string& key, const Grid& grid, const glm::dvec3& normal) {
        auto tile = fields::tileOf(key, grid, Technique::Plane, kPixels);
        const auto cut = planeThrough(grid, glm::dvec3(0.437, 0.561, 0.383), normal);
        tile.plane = {cut.normal, cut.offset, PlaneInterpolation::Linear};
        tile.camera = fields::cameraOf(grid, Projection::Orthographic);
        return tile;
    }

    /// With another threshold.
    static TileSpec withThreshold(TileSpec tile, double threshold) {
        tile.layers.volumes.front().threshold = threshold;
        return tile;
    }

    /// Pixels whose centre lies on an edge of a voxel may fall to either side.
    void sameButForEdges(const TileSpec& tile, int leastSeen) {
        const auto picture = painter.draw(tile);
        const auto truth = fields::insidePicture(tile, fields::sourcesOf(painter.provider(), tile));
        int seen = 0;
        int apart = 0;
        for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
            seen += truth.pixels[i].w > 0.0 ? 1 : 0;
            const auto error = glm::abs(picture.pixels[i] - truth.pixels[i]);
            apart += std::max({error.x, error.y, error.z, error.w}) > 1e-4 ? 1 : 0;
        }
        EXPECT_GT(seen, leastSeen);
        EXPECT_LE(apart, seen / 200);
    }
};

TEST_F(Categories, PlanesShowTheNearestLabelAndNoOther) {
    for (const auto geometry : {fields::Geometry::Isotropic, fields::Geometry::Sheared}) {
        const Grid grid = fields::gridOf(geometry, 21);
        addLabels(painter, grid, fields::nameOf(geometry));
        for (const glm::dvec3 normal : {glm::dvec3(0, 0, 1), glm::dvec3(0.5, -0.7, 0.6)}) {
            auto tile = flat(fields::nameOf(geometry), grid, normal);
            tile.transfer = labelTable({0, 4}, 0.3F);
            tile.categories = true;
            sameButForEdges(tile, 500);
            for (const auto& pixel : painter.draw(tile).pixels) {
                ASSERT_TRUE(pixel.w == 0.0 || pixel.w == 1.0) << "opaque or clear";
                for (int c = 0; pixel.w > 0.0 && c < 3; ++c)
                    ASSERT_TRUE(std::abs(pixel[c] - 0.2) < 1e-6 || pixel[c] == 1.0)
                        << "no colour between two";
            }
        }
    }
}

TEST_F(Categories, VolumesShowTheNearestLabelToo) {
    const Grid grid = fields::gridOf(fields::Geometry::Anisotropic, 21);
    addLabels(painter, grid, "labels");
    for (const auto technique : {Technique::Raycast, Technique::Slices, Technique::Surface}) {
        auto tile = fields::tileOf("labels", grid, technique, kPixels);
        tile.transfer = labelTable({0, 3}, 0.2F);
        tile.categories = true;
        // Samples on the border of two voxels may fall to either side: one of a ray's many.
        static_cast<void>(agree(tile, technique == Technique::Surface ? 30.0 : 38.0, 800));
    }
}

TEST_F(Categories, AnotherVolumeIsPaintedOverAPlaneWhereItLiesInTheWorld) {
    const Grid grid = fields::gridOf(fields::Geometry::Isotropic, 24);
    add(fields::gaussianSum(), grid, ScalarType::U8, "base");
    for (const auto geometry : {fields::Geometry::Anisotropic, fields::Geometry::Sheared}) {
        auto other = fields::gridOf(geometry, 17);
        other.worldFromIndex[3] +=
            glm::dvec4(centreWorld(grid) - centreWorld(other) + glm::dvec3(3.0, -2.0, 1.0), 0.0);
        const std::string name = fields::nameOf(geometry);
        add(fields::marschnerLobb(), other, ScalarType::F32, name);
        auto tile = flat("base", grid, {0.3, 0.2, 1.0});
        tile.transfer = ramp(0.0, 1.2);
        const auto alone = painter.draw(tile);
        VolumeLayer layer;
        layer.dataset = name;
        layer.transfer = ramp(0.0, 1.0);
        layer.weight = 0.6;
        tile.layers.volumes = {layer};
        const auto both = agree(tile, 45.0, 800);
        EXPECT_LT(fields::difference(alone, both).psnr, 30.0) << "the overlay shows";
        // Next to the threshold an error of a filter's last bit decides over a pixel.
        tile.layers.volumes[0].threshold = 0.75;
        const auto part = agree(tile, 30.0, 800);
        EXPECT_LT(fields::difference(part, both).psnr, 40.0) << "the threshold hides a part";
        tile.layers.volumes[0].threshold = 2.0;
        EXPECT_GT(fields::difference(alone, painter.draw(tile)).psnr, 100.0) << "nothing is that large";
    }
}

TEST_F(Categories, AValueOfWholeNumbersAtTheThresholdIsSeen) {
    const Grid grid = fields::gridOf(fields::Geometry::Isotropic, 24);
    add(fields::gaussianSum(), grid, ScalarType::U8, "base");
    for (const auto type : {ScalarType::U8, ScalarType::I16}) {
        auto flatField = labelField();
        flatField.low = 0.0;
        flatField.high = type == ScalarType::U8 ? 255.0 : 65535.0;
        flatField.value = [](const glm::dvec3&) { return 2.0; };
        const std::string name = type == ScalarType::U8 ? "bytes" : "shorts";
        add(flatField, grid, type, name);
        auto tile = flat("base", grid, {0.1, 0.2, 1.0});
        tile.transfer = ramp(0.0, 1.2);
        VolumeLayer layer;
        layer.dataset = name;
        layer.transfer = labelTable({}, 1.0F);
        layer.categories = true;
        layer.threshold = 2.0;
        tile.layers.volumes = {layer};
        EXPECT_LT(fields::difference(painter.draw(tile), painter.draw(withThreshold(tile, 3.0))).psnr, 30.0)
            << name;
    }
}

TEST_F(Categories, LabelsArePaintedOverAPlane) {
    const Grid grid = fields::gridOf(fields::Geometry::Isotropic, 24);
    add(fields::gaussianSum(), grid, ScalarType::U8, "base");
    const Grid coarse = fields::gridOf(fields::Geometry::Anisotropic, 13);
    addLabels(painter, coarse, "labels");
    auto tile = flat("base", grid, {0.1, 0.2, 1.0});
    tile.plane.interpolation = PlaneInterpolation::Nearest;
    tile.transfer = ramp(0.0, 1.2);
    VolumeLayer layer;
    layer.dataset = "labels";
    layer.transfer = labelTable({0, 1}, 1.0F);
    layer.weight = 0.5;
    layer.categories = true;
    tile.layers.volumes = {layer};
    const auto picture = painter.draw(tile);
    const auto truth = fields::insidePicture(tile, fields::sourcesOf(painter.provider(), tile));
    int seen = 0;
    int apart = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        seen += truth.pixels[i].w > 0.0 ? 1 : 0;
        const auto error = glm::abs(picture.pixels[i] - truth.pixels[i]);
        // The table of the base has 4096 entries, and its 8 bits are 16 in the texture at best.
        apart += std::max({error.x, error.y, error.z, error.w}) > 2e-3 ? 1 : 0;
    }
    EXPECT_GT(seen, 500);
    EXPECT_LE(apart, seen / 100);
}

TEST_F(Categories, LayersOfOtherTechniquesAreRefused) {
    const Grid grid = fields::gridOf(fields::Geometry::Isotropic, 12);
    add(fields::gaussianSum(), grid, ScalarType::U8, "base");
    auto tile = fields::tileOf("base", grid, Technique::Slices, kPixels);
    tile.transfer = ramp(0.0, 1.0);
    VolumeLayer layer;
    layer.dataset = "base";
    layer.transfer = tile.transfer;
    tile.layers.volumes = {layer};
    EXPECT_THROW((void)painter.draw(tile), InvalidInput);
}

} // namespace
} // namespace voxsheet::image
