#include "base/errors.h"
#include "volume/clip_shape_provider.h"
#include "volume/clip_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <thread>

#include <glm/gtc/constants.hpp>

namespace voxsheet {
namespace {

constexpr ClipShape allShapes[] = {ClipShape::Sphere, ClipShape::Ellipsoid, ClipShape::Box,
                                   ClipShape::Cylinder, ClipShape::Torus};

/// Nearest distance to points of a finely parametrised ellipsoid, refined by shrinking the parameter window.
double ellipsoidDistanceBySearch(const glm::dvec3& e, const glm::dvec3& p) {
    constexpr int n = 60;
    double best = 1e300;
    glm::dvec2 centre(0.0);
    glm::dvec2 half(glm::pi<double>(), glm::half_pi<double>()); // azimuth, elevation
    for (int round = 0; round < 40; ++round) {
        const auto about = centre;
        for (int i = -n; i <= n; ++i)
            for (int j = -n; j <= n; ++j) {
                const double a = about.x + half.x * i / n;
                const double b = about.y + half.y * j / n;
                const auto q =
                    e * glm::dvec3(std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b));
                if (glm::distance(p, q) < best) {
                    best = glm::distance(p, q);
                    centre = {a, b};
                }
            }
        half *= 0.4;
    }
    return best;
}

TEST(ClipShapes, EllipsoidDistanceAgreesWithASearchOfTheSurface) {
    const glm::dvec3 e(1.0, 0.75, 0.5);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> coordinate(-1.25, 1.25);
    std::vector<glm::dvec3> points{{0, 0, 0}, {0.3, 0, 0},  {0, 0.2, 0}, {0, 0, 0.1},       {0.7, 0.1, 0},
                                   {1, 0, 0}, {0, 0.75, 0}, {0, 0, 0.5}, {1.25, 1.25, 1.25}};
    while (points.size() < 30)
        points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    for (const auto& p : points) {
        const double distance = ellipsoidDistanceBySearch(e, p);
        const bool inside = glm::dot(p / e, p / e) < 1.0;
        EXPECT_NEAR(ellipsoidDistance(e, p), inside ? -distance : distance, 1e-9)
            << p.x << " " << p.y << " " << p.z;
    }
}

TEST(ClipShapes, EllipsoidDistanceKeepsToKnownCases) {
    const glm::dvec3 e(1.0, 0.75, 0.5);
    EXPECT_NEAR(ellipsoidDistance(e, {0, 0, 0}), -0.5, 1e-11);
    EXPECT_NEAR(ellipsoidDistance(e, {1.25, 0, 0}), 0.25, 1e-11);
    EXPECT_NEAR(ellipsoidDistance(e, {0, -1.25, 0}), 0.5, 1e-11);
    // Any order of the axes, equal axes, and tiny or huge coordinates.
    EXPECT_NEAR(ellipsoidDistance({0.5, 1.0, 0.75}, {0.2, 0.3, -0.4}), ellipsoidDistance(e, {0.3, -0.4, 0.2}),
                1e-14);
    EXPECT_NEAR(ellipsoidDistance({2, 2, 2}, {1, 1, 1}), std::sqrt(3.0) - 2.0, 1e-12);
    EXPECT_NEAR(ellipsoidDistance(e, {1e6, 0, 0}), 1e6 - 1.0, 1e-9);
    for (double small = 1e-3; small > 1e-300; small *= 1e-9)
        EXPECT_NEAR(ellipsoidDistance(e, {small, small, small}), -0.5, 2.0 * small + 1e-11);
}

TEST(ClipShapes, DistancesFollowTheirFormulas) {
    const auto d = clipShapeDistance;
    EXPECT_DOUBLE_EQ(d(ClipShape::Sphere, {0, 0, 0}), -1.0);
    EXPECT_DOUBLE_EQ(d(ClipShape::Sphere, {0, -1.25, 0}), 0.25);
    EXPECT_DOUBLE_EQ(d(ClipShape::Box, {0.5, -0.25, 0}), -0.5);
    EXPECT_DOUBLE_EQ(d(ClipShape::Box, {1.25, 0, 0.5}), 0.25);
    EXPECT_DOUBLE_EQ(d(ClipShape::Box, {1.25, -1.25, 1.25}), 0.25 * std::sqrt(3.0));
    EXPECT_DOUBLE_EQ(d(ClipShape::Cylinder, {0, 0, 0.75}), -0.25);
    EXPECT_DOUBLE_EQ(d(ClipShape::Cylinder, {0.6, 0.8, 1.25}), 0.25);
    EXPECT_DOUBLE_EQ(d(ClipShape::Cylinder, {1.25, 0, -1.25}), 0.25 * std::sqrt(2.0));
    EXPECT_DOUBLE_EQ(d(ClipShape::Torus, {0, 0, 0}), 0.4);
    EXPECT_NEAR(d(ClipShape::Torus, {0, 0.7, 0}), -0.3, 1e-15);
    EXPECT_DOUBLE_EQ(d(ClipShape::Torus, {0.42, 0.56, 0.5}), 0.2);
}

TEST(ClipShapes, DistancesHaveUnitGradientsAlmostEverywhere) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> coordinate(-1.2, 1.2);
    for (const auto shape : allShapes) {
        int off = 0;
        for (int n = 0; n < 2000; ++n) {
            const glm::dvec3 p(coordinate(random), coordinate(random), coordinate(random));
            glm::dvec3 gradient;
            constexpr double h = 1e-4;
            for (int a = 0; a < 3; ++a) {
                glm::dvec3 step(0.0);
                step[a] = h;
                gradient[a] =
                    (clipShapeDistance(shape, p + step) - clipShapeDistance(shape, p - step)) / (2 * h);
            }
            if (std::abs(glm::length(gradient) - 1.0) > 1e-3) ++off;
        }
        EXPECT_LE(off, 10) << clipShapeName(shape); // taps on two sides of the medial surface
    }
}

TEST(ClipShapes, SamplesStandWhereTheGridSays) {
    for (const auto shape : allShapes) {
        const auto meta = clipShapeMeta(shape);
        const auto samples = clipShapeSamples(shape);
        ASSERT_EQ(samples.size(), static_cast<std::size_t>(sampleCount(meta.grid.dims)));
        const auto box = boxIndex(meta.grid);
        EXPECT_EQ(glm::dvec3(meta.grid.worldFromIndex * glm::dvec4(box.low, 1.0)), glm::dvec3(-1.25));
        EXPECT_EQ(glm::dvec3(meta.grid.worldFromIndex * glm::dvec4(box.high, 1.0)), glm::dvec3(1.25));
        const glm::ivec3 indices[] = {{0, 0, 0}, {80, 3, 17}, {8, 40, 40}, {33, 50, 71}};
        for (const auto& i : indices) {
            const glm::dvec3 world(meta.grid.worldFromIndex * glm::dvec4(i, 1.0));
            const auto at = static_cast<std::size_t>((i.z * 81 + i.y) * 81 + i.x);
            EXPECT_NEAR(samples[at], clipShapeDistance(shape, world), 1e-6);
        }
    }
    const auto sphere = clipShapeSamples(ClipShape::Sphere);
    EXPECT_EQ(sphere[(40 * 81 + 40) * 81 + 8], 0.0F); // the faces fall on samples
    EXPECT_EQ(sphere[(40 * 81 + 40) * 81 + 72], 0.0F);
}

TEST(ClipShapes, KeysAndNamesFitTogether) {
    ASSERT_EQ(clipShapeNames().size(), std::size(allShapes));
    for (const auto shape : allShapes) {
        EXPECT_EQ(clipShapeFromName(clipShapeName(shape)), shape);
        EXPECT_EQ(clipShapeFromKey(clipShapeKey(clipShapeName(shape))), shape);
    }
    EXPECT_EQ(clipShapeKey("sphere"), "clip-shape:sphere");
    EXPECT_THROW((void)clipShapeKey("cone"), InvalidInput);
    EXPECT_FALSE(clipShapeFromKey("sphere"));
    EXPECT_FALSE(clipShapeFromKey("clip-shape:cone"));
}

DatasetMeta smallMeta() {
    DatasetMeta meta;
    meta.key = "small";
    meta.grid.dims = {2, 1, 1};
    meta.fields.emplace_back().storedType = ScalarType::U8;
    return meta;
}

TEST(ClipShapeProvider, AnswersItsShapesAndHandsTheRestOn) {
    const auto others = std::make_shared<MemoryVolumeProvider>();
    others->add(smallMeta(), {std::vector<std::byte>(2)});
    const ClipShapeProvider provider(others);

    EXPECT_EQ(provider.describe("small"), others->describe("small"));
    EXPECT_THROW((void)provider.describe("none"), NotFound);
    EXPECT_THROW((void)provider.describe("clip-shape:cone"), NotFound);

    const auto key = clipShapeKey("torus");
    const auto meta = provider.describe(key);
    EXPECT_EQ(meta->key, key);
    ASSERT_EQ(meta->fields.size(), 1U);
    EXPECT_EQ(meta->fields[0].quantity, "signed distance");
    EXPECT_NEAR(meta->fields[0].steps.at(0).statistics.min, -0.3, 0.02);
    EXPECT_EQ(meta, provider.describe(key)); // kept

    const auto expected = clipShapeSamples(ClipShape::Torus);
    std::vector<float> slices(81UL * 81 * 2);
    provider.readSlices({key, 0, 0, 0}, 40, 2, std::as_writable_bytes(std::span(slices)));
    EXPECT_EQ(std::memcmp(slices.data(), &expected[40UL * 81 * 81], slices.size() * sizeof(float)), 0);
    EXPECT_EQ(provider.readMinMax({key, 0, 0, 0}).bricks, glm::ivec3(41));
    EXPECT_THROW((void)provider.readMinMax({key, 1, 0, 0}), NotFound);
}

TEST(ClipShapeProvider, ManyThreadsGetOneDataset) {
    const ClipShapeProvider provider(std::make_shared<MemoryVolumeProvider>());
    std::vector<std::shared_ptr<const DatasetMeta>> answers(8);
    {
        std::vector<std::jthread> threads;
        for (auto& answer : answers)
            threads.emplace_back([&] { answer = provider.describe("clip-shape:ellipsoid"); });
    }
    for (const auto& answer : answers)
        EXPECT_EQ(answer, answers[0]);
}

} // namespace
} // namespace voxsheet
