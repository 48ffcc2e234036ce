// Scenes that look inside volumes, and their comparison with the truth.
#pragma once

#include "fields/inside.h"
#include "fields/sampled_field.h"
#include "fields/scenes.h"
#include "image/tile_painter.h"
#include "volume/clip_shapes.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace voxsheet::image {

class InsideScene : public testing::Test {
protected:
    void add(const fields::AnalyticField& field, const Grid& grid, ScalarType type, const std::string& key) {
        add(fields::sampleField(field, grid, type, key));
    }
    void add(fields::SampledField sampled) {
        painter.volumes().add(std::move(sampled.meta), std::move(sampled.arrays));
    }

    /// Distances of a ball whose radius is 0.6 of half the edge of the grid's box, as a dataset of its own
    /// world.
    void addBall(const std::string& key, int samples = 48) {
        add(fields::sphereDistance(0.6), fields::gridOf(fields::Geometry::Isotropic, samples),
            ScalarType::F32, key);
    }

    /// Draws and compares with the truth at the same positions; returns the picture.
    fields::Picture agree(const TileSpec& tile, double leastDecibels = 45.0, std::size_t leastPixels = 300) {
        const auto truth = fields::insidePicture(tile, fields::sourcesOf(painter.provider(), tile));
        auto picture = painter.draw(tile);
        const auto same = fields::difference(picture, truth);
        std::printf("%-11s %6.1f dB (alpha %6.1f, p99.9 %.1e) %zu pixels\n", fields::nameOf(tile.technique),
                    same.psnr, same.psnrAlpha, same.p999, same.pixels);
        EXPECT_GE(same.psnr, leastDecibels) << fields::nameOf(tile.technique);
        EXPECT_GE(same.psnrAlpha, leastDecibels) << fields::nameOf(tile.technique);
        EXPECT_GE(same.pixels, leastPixels) << fields::nameOf(tile.technique);
        return picture;
    }

    TilePainter painter;
};

/// A plane through a point of the grid's box (fractions of its axes) that keeps what lies along `normal`.
[[nodiscard]] inline ClipPlane planeThrough(const Grid& grid, const glm::dvec3& fractions,
                                            const glm::dvec3& normal) {
    const auto box = boxIndex(grid);
    const auto index = box.low + fractions * (box.high - box.low);
    const auto unit = glm::normalize(normal);
    return {unit, glm::dot(unit, glm::dvec3(grid.worldFromIndex * glm::dvec4(index, 1.0)))};
}

/// The object's world laid over the cell's: its grid's centre on the cell's, scaled so that the object's half
/// edge is `halfEdgeRadii` of the cell's bounding radius, and turned a little.
[[nodiscard]] inline glm::dmat4 objectOver(const Grid& object, const Grid& cell, double halfEdgeRadii) {
    const double scale = 0.5 * (object.dims.x - 1) / (halfEdgeRadii * boundingRadiusWorld(cell));
    const double angle = 0.4;
    glm::dmat4 matrix(1.0);
    matrix[0] = {scale * std::cos(angle), scale * std::sin(angle), 0.0, 0.0};
    matrix[1] = {-scale * std::sin(angle), scale * std::cos(angle), 0.0, 0.0};
    matrix[2] = {0.0, 0.0, scale, 0.0};
    matrix[3] = glm::dvec4(centreWorld(object) - glm::dmat3(matrix) * centreWorld(cell), 1.0);
    return matrix;
}

} // namespace voxsheet::image
