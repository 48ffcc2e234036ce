// Integrals through what clipping leaves of a uniform material: 1 - (1 - opacity)^(length / unit length),
// with the length in closed form; and through other volumes against converged integrals.
#include "image/inside_scene.h"
#include "volume/clip_shapes.h"

#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace voxsheet::image {
namespace {

constexpr int kPixels = 64;
constexpr double kOpacity = 0.03; ///< per unit length

class ClipIntegrals : public InsideScene {
protected:
    TileSpec uniformTile(const Grid& grid, Technique technique, Projection projection) {
        auto tile = fields::tileOf("uniform", grid, technique, kPixels);
        TransferFunction function;
        function.colours = {{0.0, {0.25, 0.5, 1.0}}};
        function.opacities = {{0.0, kOpacity}};
        tile.transfer = buildTransferTable(function);
        tile.camera = fields::cameraOf(grid, projection);
        tile.unitLengthWorld = 1.0;
        return tile;
    }
    void addUniform(const Grid& grid) {
        auto constant = fields::linearRamp(glm::dvec3(0.0));
        constant.low = 0.0;
        constant.high = 1.0;
        add(constant, grid, ScalarType::U8, "uniform");
    }

    /// World length of the pixel's ray for which `keeps` holds, inside the box, by fine steps.
    template <typename Keeps>
    static double keptLength(const TileSpec& tile, const Grid& grid, int x, int y, Keeps keeps) {
        const auto ray = fields::worldRay(tile, x + 0.5, y + 0.5);
        auto unclipped = tile;
        unclipped.clip = {};
        const auto range = fields::keptRange(unclipped, grid, ray);
        if (!(range.begin < range.end)) return 0.0;
        constexpr int steps = 2000;
        const double step = (range.end - range.begin) / steps;
        int kept = 0;
        for (int i = 0; i < steps; ++i)
            kept += keeps(ray.at(range.begin + (i + 0.5) * step)) ? 1 : 0;
        return kept * step * glm::length(ray.direction);
    }

    struct Error {
        double largest = 0.0; ///< of alpha
        double mean = 0.0;
    };
    /// Of the picture's alpha from that of the kept lengths.
    template <typename Keeps>
    Error errorOf(const TileSpec& tile, const Grid& grid, Keeps keeps) {
        const auto picture = painter.draw(tile);
        Error error;
        int shown = 0;
        for (int y = 0; y < kPixels; ++y)
            for (int x = 0; x < kPixels; ++x) {
                const double length = keptLength(tile, grid, x, y, keeps);
                const double off = std::abs(picture.at(x, y).w - (1.0 - std::pow(1.0 - kOpacity, length)));
                error.largest = std::max(error.largest, off);
                error.mean += off;
                shown += length > 0.5 ? 1 : 0;
                EXPECT_NEAR(picture.at(x, y).y, 0.5 * picture.at(x, y).w, 1e-5);
            }
        error.mean /= std::max(shown, 1);
        EXPECT_GT(shown, 200);
        return error;
    }
};

TEST_F(ClipIntegrals, PlanesAndBoxesLeaveTheirLength) {
    const auto grid = fields::gridOf(fields::Geometry::Sheared, 32);
    addUniform(grid);
    for (const auto technique : {Technique::Raycast, Technique::Slices})
        for (const auto projection : {Projection::Perspective, Projection::Orthographic}) {
            auto tile = uniformTile(grid, technique, projection);
            const auto keeps = [&](const glm::dvec3& p) {
                return std::all_of(
                    tile.clip.planes.begin(), tile.clip.planes.end(),
                    [&](const ClipPlane& plane) { return glm::dot(plane.normal, p) >= plane.offset; });
            };
            tile.clip.planes = {planeThrough(grid, glm::dvec3(0.5), {-1.0, 0.2, -0.6})};
            // The reference counts to a 2000th of the path.
            EXPECT_LE(errorOf(tile, grid, keeps).largest, 2e-3) << fields::nameOf(technique);
            tile.clip.planes.clear();
            for (int axis = 0; axis < 3; ++axis) {
                glm::dvec3 normal(0.0);
                normal[axis] = 1.0;
                tile.clip.planes.push_back(planeThrough(grid, glm::dvec3(0.25), normal));
                tile.clip.planes.push_back(planeThrough(grid, glm::dvec3(0.8), -normal));
            }
            EXPECT_LE(errorOf(tile, grid, keeps).largest, 2e-3) << fields::nameOf(technique);
        }
}

TEST_F(ClipIntegrals, ShapesLeaveTheirLength) {
    const auto grid = fields::gridOf(fields::Geometry::Anisotropic, 32);
    addUniform(grid);
    for (const auto name : clipShapeNames())
        for (const auto mode : {ClipMode::Probe, ClipMode::Clip})
            for (const auto technique : {Technique::Raycast, Technique::Slices}) {
                const auto shape = *clipShapeFromName(name);
                auto tile = uniformTile(grid, technique, Projection::Perspective);
                ClipObject object;
                object.dataset = clipShapeKey(shape);
                object.mode = mode;
                const double size = 0.45 * boundingRadiusWorld(grid);
                object.objectFromWorld = glm::affineInverse(
                    glm::translate(glm::dmat4(1.0), centreWorld(grid)) *
                    glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1.0, 2.0, 3.0))) *
                    glm::scale(glm::dmat4(1.0), size * glm::dvec3(1.0, 0.9, 1.1)));
                tile.clip.object = object;
                const auto keeps = [&](const glm::dvec3& p) {
                    const auto inObject = glm::dvec3(object.objectFromWorld * glm::dvec4(p, 1.0));
                    return (clipShapeDistance(shape, inObject) < 0.0) == (mode == ClipMode::Probe);
                };
                const auto smooth = errorOf(tile, grid, keeps);
                tile.clip.object->binary = true;
                const auto binary = errorOf(tile, grid, keeps);
                std::printf("%-9s %-5s %-7s alpha off by %.4f (mean %.5f); binary %.4f (mean %.5f)\n",
                            std::string(name).c_str(), mode == ClipMode::Probe ? "probe" : "clip",
                            fields::nameOf(technique), smooth.largest, smooth.mean, binary.largest,
                            binary.mean);
                // Distances are interpolated over 1/32 of the shape: edges are rounded by a part of that, and
                // rays that graze lose it along their path.
                EXPECT_LE(smooth.largest, 0.06) << name;
                EXPECT_LE(smooth.mean, 0.002) << name;
                // What distances are for.
                EXPECT_LT(smooth.mean, 0.5 * binary.mean) << name;
            }
}

TEST_F(ClipIntegrals, PicturesAreNearTheConvergedIntegral) {
    const auto field = fields::gaussianSum();
    for (const auto geometry : {fields::Geometry::Isotropic, fields::Geometry::Sheared}) {
        const auto grid = fields::gridOf(geometry, 36);
        const std::string key = fields::nameOf(geometry);
        add(field, grid, ScalarType::U16, key);
        for (const auto technique : {Technique::Raycast, Technique::Slices, Technique::Mip})
            for (const bool lit : {false, true}) {
                auto tile = fields::tileOf(key, grid, technique, kPixels);
                tile.transfer = fields::filledTable(field.low, field.high);
                tile.unitLengthWorld *= 0.3;
                tile.shading.enabled = lit;
                tile.clip.planes = {planeThrough(grid, glm::dvec3(0.6), {-1.0, 0.2, -0.6})};
                ClipObject object;
                object.dataset = clipShapeKey(ClipShape::Torus);
                object.mode = ClipMode::Clip;
                object.objectFromWorld = glm::affineInverse(
                    glm::translate(glm::dmat4(1.0), centreWorld(grid)) *
                    glm::scale(glm::dmat4(1.0), glm::dvec3(0.5 * boundingRadiusWorld(grid))));
                tile.clip.object = object;
                const auto sources = fields::sourcesOf(painter.provider(), tile);
                const auto same =
                    fields::difference(painter.draw(tile), fields::insideConverged(tile, sources));
                std::printf("%-9s %-7s %-5s to the converged integral %.1f dB\n", key.c_str(),
                            fields::nameOf(technique), lit ? "lit" : "unlit", same.psnr);
                EXPECT_GE(same.psnr, 40.0);
                EXPECT_GE(same.pixels, 300U);
            }
    }
}

} // namespace
} // namespace voxsheet::image
