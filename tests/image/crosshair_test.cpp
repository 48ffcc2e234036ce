// The crosshair of linked planes in pictures of volumes: where it lies, before and behind what is opaque.
#include "image/inside_scene.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace voxsheet::image {
namespace {

constexpr int kPixels = 160;
constexpr double kBallRadius = 0.6; // of half the box's edge

class CrosshairPictures : public InsideScene {
protected:
    void SetUp() override {
        grid_ = fields::gridOf(fields::Geometry::Isotropic, 48);
        add(fields::sphereDistance(kBallRadius), grid_, ScalarType::F32, "ball");
    }

    [[nodiscard]] TileSpec tileOf(Technique technique,
                                  Projection projection = Projection::Perspective) const {
        auto tile = fields::tileOf("ball", grid_, technique, kPixels);
        tile.camera = fields::cameraOf(grid_, projection);
        tile.transfer = tableOf(0.0, 0.0);
        tile.isosurface.surfaces = {{1e6, glm::vec4(1.0F)}}; // nowhere
        return tile;
    }
    /// Blue, of one opacity within the ball (values below 0) and one without.
    [[nodiscard]] static std::shared_ptr<const TransferTable> tableOf(double within, double without) {
        TransferFunction function;
        function.colours = {{0.0, {0.0, 0.0, 1.0}}, {1.0, {0.0, 0.0, 1.0}}};
        function.low = -1.0;
        function.high = 1.0;
        function.opacities = {{0.0, within}, {0.499, within}, {0.501, without}, {1.0, without}};
        return buildTransferTable(function);
    }

    [[nodiscard]] glm::dvec3 inBox(const glm::dvec3& fractions) const {
        const auto box = boxIndex(grid_);
        return glm::dvec3(grid_.worldFromIndex * glm::dvec4(box.low + fractions * (box.high - box.low), 1.0));
    }
    /// Places along the crosshair's three lines, and the pixels that see them.
    template <typename Visit>
    void alongLines(const TileSpec& tile, const glm::dvec3& fractions, const Visit& visit) const {
        const bool perspective = tile.camera.projection == Projection::Perspective;
        for (int axis = 0; axis < 3; ++axis)
            for (int i = 1; i < 60; ++i) {
                auto place = fractions;
                place[axis] = i / 60.0;
                const auto world = inBox(place);
                const glm::dvec3 view(tile.camera.viewFromWorld * glm::dvec4(world, 1.0));
                const double half = perspective
                                        ? -view.z * std::tan(glm::radians(tile.camera.fovYDegrees / 2.0))
                                        : tile.camera.heightWorld / 2.0;
                const auto pixel = glm::ivec2(glm::floor(kPixels / 2.0 * (1.0 + glm::dvec2(view) / half)));
                visit(world, pixel);
            }
    }
    static bool isYellow(const glm::dvec4& pixel) {
        return pixel.w > 0.9 && pixel.x > 0.9 && pixel.y > 0.7 && pixel.z < 0.4;
    }
    static long changed(const fields::Picture& a, const fields::Picture& b) {
        long count = 0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i)
            count += a.pixels[i] != b.pixels[i] ? 1 : 0;
        return count;
    }

    Grid grid_;
};

TEST_F(CrosshairPictures, LinesAreWholeWhereNothingHidesThemWithEveryTechnique) {
    const glm::dvec3 at(0.3, 0.55, 0.7);
    for (const auto technique :
         {Technique::Slices, Technique::Raycast, Technique::Mip, Technique::Isosurface})
        for (const auto projection : {Projection::Perspective, Projection::Orthographic}) {
            auto tile = tileOf(technique, projection);
            tile.crosshairWorld = inBox(at);
            // A cut through the volume is none through its lines.
            tile.clip.planes = {planeThrough(grid_, glm::dvec3(0.5), {1.0, 0.2, 0.1})};
            const auto picture = painter.draw(tile);
            int missed = 0;
            alongLines(tile, at, [&](const glm::dvec3&, const glm::ivec2& pixel) {
                missed += isYellow(picture.at(pixel.x, pixel.y)) ? 0 : 1;
            });
            // Where the lines cross, the dark edge of one may lie before another: of 177 places, few.
            EXPECT_LE(missed, 3) << fields::nameOf(technique);
            const auto lit = std::count_if(picture.pixels.begin(), picture.pixels.end(),
                                           [](const glm::dvec4& pixel) { return pixel.w > 0.0; });
            EXPECT_LT(lit, kPixels * kPixels / 12) << "they are thin: " << fields::nameOf(technique);
        }
    auto plane = tileOf(Technique::Plane, Projection::Orthographic);
    const auto cut = planeThrough(grid_, at, {0.0, 0.0, 1.0});
    plane.plane = {cut.normal, cut.offset, PlaneInterpolation::Linear};
    const auto bare = painter.draw(plane);
    plane.crosshairWorld = inBox(at);
    EXPECT_EQ(changed(painter.draw(plane), bare), 0) << "planes have theirs drawn over them";
}

/// An opaque ball hides what lies within it and behind it, and nothing else.
TEST_F(CrosshairPictures, WhatIsOpaqueHidesWhatLiesBehindIt) {
    const auto centre = inBox(glm::dvec3(0.5));
    const double radius = kBallRadius * 0.5 * glm::distance(inBox({0, 0, 0}), inBox({1, 0, 0}));
    for (const auto technique : {Technique::Isosurface, Technique::Raycast, Technique::Slices})
        for (const glm::dvec3 at : {glm::dvec3(0.5, 0.45, 0.55), glm::dvec3(0.15, 0.2, 0.9)}) {
            auto tile = tileOf(technique);
            tile.isosurface.surfaces = {{0.0, glm::vec4(0.0F, 0.0F, 1.0F, 1.0F)}};
            tile.transfer = tableOf(1.0, 0.0);
            tile.crosshairWorld = inBox(at);
            const auto picture = painter.draw(tile);
            const glm::dvec3 eye(glm::inverse(tile.camera.viewFromWorld)[3]);
            int hidden = 0;
            int seen = 0;
            int crossed = 0;
            alongLines(tile, at, [&](const glm::dvec3& world, const glm::ivec2& pixel) {
                const auto ray = glm::normalize(world - eye);
                const double next = std::clamp(glm::dot(centre - eye, ray), 0.0, glm::distance(world, eye));
                const double apart = glm::distance(eye + next * ray, centre);
                // Within two voxels of the outline, pixels and samples decide.
                if (std::abs(apart - radius) < 2.0) return;
                const auto colour = picture.at(pixel.x, pixel.y);
                if (apart > radius) {
                    ++seen;
                    EXPECT_TRUE(isYellow(colour))
                        << fields::nameOf(technique) << ' ' << pixel.x << ", " << pixel.y;
                } else if (!isYellow(colour)) { // but where another line crosses the pixel before the ball
                    ++hidden;
                    EXPECT_LT(colour.x, 0.1)
                        << fields::nameOf(technique) << ' ' << pixel.x << ", " << pixel.y;
                } else {
                    ++crossed;
                }
            });
            EXPECT_GT(seen, 30) << fields::nameOf(technique);
            EXPECT_GT(hidden, 20) << fields::nameOf(technique);
            EXPECT_LT(crossed, 8) << fields::nameOf(technique);
        }
}

/// In even fog, as much of its light arrives as the fog before it lets through.
TEST_F(CrosshairPictures, FogDimsItByItsDepth) {
    for (const double z : {0.25, 0.5, 0.9}) {
        auto tile = tileOf(Technique::Raycast, Projection::Orthographic);
        const auto centre = centreWorld(grid_);
        tile.camera.viewFromWorld =
            glm::lookAt(centre + glm::dvec3(0.0, 0.0, 500.0), centre, glm::dvec3(0.0, 1.0, 0.0));
        tile.camera.heightWorld = 60.0;
        tile.transfer = tableOf(0.02, 0.02);
        tile.unitLengthWorld = 1.0;
        tile.crosshairWorld = inBox({0.5, 0.5, z});
        const auto picture = painter.draw(tile);
        // Its line along x, which is as thick as three pixels; the one along z is seen from its end.
        const double pixelWorld = tile.camera.heightWorld / kPixels;
        const double depth = inBox({0, 0, 1}).z - inBox({0, 0, z}).z;
        for (const int x : {50, 60, 110}) {
            const auto colour = picture.at(x, kPixels / 2);
            const double least = std::pow(0.98, depth);
            const double most = std::pow(0.98, depth - 2.0 * 0.75 * pixelWorld);
            EXPECT_GE(colour.x, least - 1e-3) << z;
            EXPECT_LE(colour.x, most + 1e-3) << z;
            EXPECT_NEAR(colour.w, 1.0, 1e-5);
        }
    }
}

} // namespace
} // namespace voxsheet::image
