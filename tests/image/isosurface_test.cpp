// Positions and normals of isosurfaces on every texture format, against the double-precision roots of the
// trilinear interpolant and the gradients there.
#include "image/isosurface_scene.h"
#include "image/measured_hits.h"

#include <algorithm>
#include <cmath>

namespace voxsheet::image {
namespace {

using fields::PixelHits;

struct Format {
    const char* name;
    ScalarType type;
    FloatTexels texels;
    double voxels;  ///< that a hit may lie off its root
    double degrees; ///< that a normal may be off the gradient there
};
// 0.01 voxel is what the refinement promises. Half floats hold distances to 2^-12 of their range, which moves
// roots by 0.01 voxel and more where the field is flat, and turns gradients by up to their noise over two
// voxels.
constexpr Format kFormats[] = {{"u8", ScalarType::U8, FloatTexels::Full, 0.01, 0.1},
                               {"u16", ScalarType::U16, FloatTexels::Full, 0.01, 0.1},
                               {"f32", ScalarType::F32, FloatTexels::Full, 0.01, 0.1},
                               {"half", ScalarType::F32, FloatTexels::Half, 0.05, 1.0}};

class IsosurfaceHits : public IsosurfaceScene {
protected:
    /// Hits where the reference has them and nowhere else, but at silhouettes.
    static void sameMask(const PixelHits& hits, const std::vector<bool>& silhouette,
                         const fields::Picture& picture) {
        std::size_t covered = 0;
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < hits.size(); ++i) {
            if (silhouette[i]) continue;
            const bool hit = picture.pixels[i].w > 0.5;
            covered += hit ? 1U : 0U;
            wrong += hit == hits[i].empty() ? 1U : 0U;
        }
        EXPECT_EQ(wrong, 0U);
        EXPECT_GT(covered, 300U);
    }

    /// Of all pixels that meet the surface, but at silhouettes: the distance of what the picture shows from
    /// the first root, in voxels, sorted.
    std::vector<double> voxelsOff(const TileSpec& tile, const Grid& grid,
                                  const std::vector<bool>& silhouette) {
        const auto roots = fields::firstHits(tile, fields::sourcesOf(painter.provider(), tile));
        const auto seen = measuredPositions(painter, tile);
        std::vector<double> off;
        for (std::size_t i = 0; i < roots.size(); ++i)
            if (!silhouette[i] && roots[i].surface >= 0)
                off.push_back(glm::distance(seen[i].position, roots[i].position) / meanVoxelEdgeWorld(grid));
        std::sort(off.begin(), off.end());
        return off;
    }

    /// Likewise the angle between the normal that the picture shows and the gradient at the first root, in
    /// degrees.
    std::vector<double> degreesOff(const TileSpec& tile, const std::vector<bool>& silhouette) {
        const auto roots = fields::firstHits(tile, fields::sourcesOf(painter.provider(), tile));
        const auto seen = measuredNormals(painter, tile);
        std::vector<double> off;
        for (std::size_t i = 0; i < roots.size(); ++i)
            if (!silhouette[i] && roots[i].surface >= 0)
                off.push_back(
                    glm::degrees(std::acos(std::min(glm::dot(seen[i].normal, roots[i].normal), 1.0))));
        std::sort(off.begin(), off.end());
        return off;
    }
};

TEST_F(IsosurfaceHits, AreTheRootsWithNoHolesOnEveryFormat) {
    const auto grid = fields::gridOf(fields::Geometry::Isotropic, 40);
    for (const auto& field : {fields::torusDistance(), fields::sphereDistance(0.7), fields::marschnerLobb()})
        for (const auto& format : kFormats) {
            const auto key = field.name + " " + format.name;
            add(field, grid, format.type, key);
            auto tile = isoTile(grid, key, field.name == "Marschner-Lobb" ? 0.5 : 0.013);
            tile.floatTexels = format.texels;
            const auto hits = hitsOf(tile);
            const auto silhouette = fields::silhouettes(hits, tile.sizePixels, 4.0);
            sameMask(hits, silhouette, painter.draw(tile));
            // Ridges of this field are thinner than a step in places: one hit in a thousand may be the
            // surface behind.
            const std::size_t missed = field.name == "Marschner-Lobb" ? 3 : 0;
            const auto farthest = [&](const std::vector<double>& off) {
                return off.at(off.size() - 1 - missed);
            };
            const double voxels = farthest(voxelsOff(tile, grid, silhouette));
            tile.shading.gradient = GradientSource::OnTheFly;
            const double taps = farthest(degreesOff(tile, silhouette));
            tile.shading.gradient = GradientSource::Texture;
            const double texture = farthest(degreesOff(tile, silhouette));
            std::printf(
                "%-22s farthest from its root %.4f voxel; normal off by %.3f (six taps), %.3f (texture) "
                "degrees\n",
                key.c_str(), voxels, taps, texture);
            // Gradients come through the filter: weights in steps of 1/256 voxel turn them, most where the
            // field bends within a voxel.
            const double coarse = field.name == "Marschner-Lobb" ? 1.5 : 0.2;
            const double degrees = format.degrees + (painter.filtersExactly() ? 0.0 : coarse);
            EXPECT_LE(voxels, format.voxels + measuredPositionError(grid) / meanVoxelEdgeWorld(grid)) << key;
            EXPECT_LE(taps, degrees) << key;
            EXPECT_LE(texture, degrees) << key;
        }
}

} // namespace
} // namespace voxsheet::image
