// Scenes with isosurfaces, and their comparison with the truth but at silhouettes.
#pragma once

#include "fields/hit_map.h"
#include "image/inside_scene.h"

namespace voxsheet::image {

class IsosurfaceScene : public InsideScene {
protected:
    static constexpr int kPixels = 96;

    TileSpec isoTile(const Grid& grid, const std::string& key, double value) {
        auto tile = fields::tileOf(key, grid, Technique::Isosurface, kPixels);
        tile.transfer = fields::filledTable(-1.0, 1.0);
        tile.isosurface.surfaces = {{value, glm::vec4(0.9F, 0.6F, 0.3F, 1.0F)}};
        return tile;
    }

    fields::PixelHits hitsOf(const TileSpec& tile) {
        return fields::isosurfaceHits(tile, fields::sourcesOf(painter.provider(), tile));
    }

    /// As agree(), but for pixels at silhouettes.
    fields::Picture agreeInside(const TileSpec& tile, const Grid& grid, double leastDecibels = 45.0,
                                std::size_t leastPixels = 300) {
        const auto silhouette =
            fields::silhouettes(hitsOf(tile), tile.sizePixels, 3.0 * meanVoxelEdgeWorld(grid));
        auto truth = fields::insidePicture(tile, fields::sourcesOf(painter.provider(), tile));
        auto picture = painter.draw(tile);
        const auto whole = picture;
        for (std::size_t i = 0; i < silhouette.size(); ++i)
            if (silhouette[i]) truth.pixels[i] = picture.pixels[i] = glm::dvec4(0.0);
        const auto same = fields::difference(picture, truth);
        std::printf("isosurface  %6.1f dB (largest %.1e) %zu pixels\n", same.psnr, same.largest, same.pixels);
        EXPECT_GE(same.psnr, leastDecibels);
        EXPECT_GE(same.psnrAlpha, leastDecibels);
        EXPECT_GE(same.pixels, leastPixels);
        return whole;
    }
};

} // namespace voxsheet::image
