#include "base/errors.h"
#include "volume/nearest_seed.h"
#include "volume/signed_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace voxsheet {
namespace {

using Field = std::function<double(const glm::dvec3& world)>;

glm::dvec3 worldOf(const Grid& grid, const glm::dvec3& index) {
    return glm::dvec3(grid.worldFromIndex * glm::dvec4(index, 1.0));
}

template <typename Body>
void eachSample(const Grid& grid, const Body& body) {
    std::size_t at = 0;
    for (int z = 0; z < grid.dims.z; ++z)
        for (int y = 0; y < grid.dims.y; ++y)
            for (int x = 0; x < grid.dims.x; ++x)
                body(at++, glm::dvec3(x, y, z));
}

std::vector<float> sampled(const Grid& grid, const Field& field) {
    std::vector<float> values(static_cast<std::size_t>(sampleCount(grid.dims)));
    eachSample(grid, [&](std::size_t at, const glm::dvec3& index) {
        values[at] = static_cast<float>(field(worldOf(grid, index)));
    });
    return values;
}

Grid cubeGrid(int samples) {
    Grid grid;
    grid.dims = glm::ivec3(samples);
    return grid;
}

/// Trilinear, clamped to the edge.
double interpolated(const DistanceVolume& volume, const glm::dvec3& world) {
    const auto& dims = volume.grid.dims;
    const glm::dvec3 index(glm::inverse(volume.grid.worldFromIndex) * glm::dvec4(world, 1.0));
    const auto p = glm::clamp(index, glm::dvec3(0.0), glm::dvec3(dims - 1));
    const auto low = glm::min(glm::ivec3(p), dims - 2);
    const auto f = p - glm::dvec3(low);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 c(corner & 1, (corner >> 1) & 1, corner >> 2);
        const auto w = glm::mix(1.0 - f, f, glm::dvec3(c));
        const auto s = low + c;
        sum += w.x * w.y * w.z *
               double(volume.distances[static_cast<std::size_t>((s.z * dims.y + s.y) * dims.x + s.x)]);
    }
    return sum;
}

struct Accuracy {
    double largestError = 0.0; ///< in output voxels
    double largestStep = 0.0;  ///< between neighbours, in output voxels
};

Accuracy accuracyOf(const DistanceVolume& volume, const Field& truth) {
    Accuracy result;
    const double voxel = volume.grid.worldFromIndex[0][0];
    const std::size_t strides[] = {1, static_cast<std::size_t>(volume.grid.dims.x),
                                   static_cast<std::size_t>(volume.grid.dims.x * volume.grid.dims.y)};
    eachSample(volume.grid, [&](std::size_t at, const glm::dvec3& index) {
        const double distance = volume.distances[at];
        result.largestError =
            std::max(result.largestError, std::abs(distance - truth(worldOf(volume.grid, index))) / voxel);
        for (int axis = 0; axis < 3; ++axis)
            if (index[axis] > 0)
                result.largestStep =
                    std::max(result.largestStep,
                             std::abs(distance - double(volume.distances[at - strides[axis]])) / voxel);
    });
    return result;
}

double boxDistance(const glm::dvec3& p, const glm::dvec3& low, const glm::dvec3& high) {
    const auto q = glm::max(low - p, p - high);
    return glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

Field ball(const glm::dvec3& centre, double radius) {
    return [=](const glm::dvec3& p) { return radius - glm::distance(p, centre); };
}

Field torus(const glm::dvec3& centre, double major, double minor) {
    return [=](const glm::dvec3& world) {
        const auto p = world - centre;
        return minor - glm::length(glm::dvec2(glm::length(glm::dvec2(p)) - major, p.z));
    };
}

Field negated(const Field& field) {
    return [=](const glm::dvec3& p) { return -field(p); };
}

constexpr double kStep = 1.0 + 1e-5; // float rounding of distances of some hundred voxels

TEST(SignedDistance, BallsAndToriAreWithinTheStatedErrorOfTheirFormulas) {
    struct Case {
        Field field;
        double smallestRadius;
        int samples;
    };
    const Case cases[] = {
        {ball({15.63, 15.39, 15.87}, 11.5), 11.5, 32},
        {ball({31.6, 31.4, 31.9}, 25.0), 25.0, 64},
        {torus({31.6, 31.4, 31.9}, 19.0, 8.0), 8.0, 64},
        {torus({31.6, 31.4, 31.9}, 20.0, 4.0), 4.0, 64},
    };
    for (const auto& [field, radius, samples] : cases) {
        const auto grid = cubeGrid(samples);
        const auto volume = signedDistance(grid, sampled(grid, field), {Comparison::Greater, 0.0});
        const auto accuracy = accuracyOf(volume, negated(field));
        EXPECT_LT(accuracy.largestError, 0.7 / radius) << radius;
        EXPECT_LE(accuracy.largestStep, kStep);
    }
}

TEST(SignedDistance, ZeroLevelIsThatOfTheFieldsOwnInterpolant) {
    // Crossings are looked up on the edges between samples, where the interpolant is linear. Radii of
    // curvature go down to 4 voxels.
    const auto grid = cubeGrid(40);
    const auto values = sampled(grid, [](const glm::dvec3& p) {
        return std::sin(p.x * 0.25) + std::sin(p.y * 0.2 + 1.0) * std::cos(p.z * 0.3);
    });
    const auto volume = signedDistance(grid, values, {Comparison::LessOrEqual, 0.25});
    double largest = 0.0;
    double sum = 0.0;
    int count = 0;
    eachSample(grid, [&](std::size_t at, const glm::dvec3& index) {
        const double here = double(values[at]) - 0.25;
        const double next = index.x < 39 ? double(values[at + 1]) - 0.25 : here;
        if ((here > 0.0) == (next > 0.0) || boxDistance(index, glm::dvec3(1), glm::dvec3(38)) > 0.0) return;
        const auto crossing = worldOf(grid, index + glm::dvec3(here / (here - next), 0, 0));
        const double distance = std::abs(interpolated(volume, crossing));
        largest = std::max(largest, distance);
        sum += distance;
        ++count;
    });
    ASSERT_GT(count, 500);
    EXPECT_LT(largest, 0.25);
    EXPECT_LT(sum / count, 0.03);
    EXPECT_LE(accuracyOf(volume, [](const glm::dvec3&) { return 0.0; }).largestStep, kStep);
}

TEST(SignedDistance, AFullBoxIsClosedAtItsFaces) {
    auto grid = cubeGrid(20);
    grid.dims = {20, 12, 9};
    const std::vector<float> values(20UL * 12 * 9, 5.0F);
    const auto volume = signedDistance(grid, values, {Comparison::GreaterOrEqual, 5.0});
    const auto truth = [&](const glm::dvec3& p) {
        return boxDistance(p, glm::dvec3(0), glm::dvec3(grid.dims - 1));
    };
    EXPECT_LT(accuracyOf(volume, truth).largestError, 0.002); // faces fall on samples; bisection to 1/1000
    EXPECT_EQ(volume.grid.dims, grid.dims + 2 * kDistanceMarginSamples);

    grid.centring = Centring::Cell; // half a voxel more on each side
    const auto cells = signedDistance(grid, values, {Comparison::GreaterOrEqual, 5.0});
    const auto cellTruth = [&](const glm::dvec3& p) {
        return boxDistance(p, glm::dvec3(-0.5), glm::dvec3(grid.dims) - 0.5);
    };
    EXPECT_LT(accuracyOf(cells, cellTruth).largestError, 0.002);
}

TEST(SignedDistance, NothingInsideGivesTheDiagonal) {
    const auto grid = cubeGrid(10);
    const std::vector<float> values(1000, 5.0F);
    const auto volume = signedDistance(grid, values, {Comparison::Greater, 5.0});
    const double diagonal = glm::length(glm::dvec3(volume.grid.dims - 1));
    for (const float distance : volume.distances)
        ASSERT_FLOAT_EQ(distance, static_cast<float>(diagonal));
    const std::vector<float> absent(1000, std::numeric_limits<float>::quiet_NaN());
    for (const auto comparison :
         {Comparison::Greater, Comparison::GreaterOrEqual, Comparison::Less, Comparison::LessOrEqual})
        EXPECT_EQ(signedDistance(grid, absent, {comparison, 0.0}).distances, volume.distances);
}

TEST(SignedDistance, EachComparisonKeepsItsSide) {
    const auto grid = cubeGrid(12);
    const auto ramp = sampled(grid, [](const glm::dvec3& p) { return std::clamp(p.x, 3.0, 6.0); });
    const auto at = [&](Comparison comparison, double value, double x) {
        return interpolated(signedDistance(grid, ramp, {comparison, value}), {x, 5.0, 5.0});
    };
    EXPECT_NEAR(at(Comparison::Greater, 4.5, 6.0), -1.5, 0.01);
    EXPECT_NEAR(at(Comparison::Less, 4.5, 6.0), 1.5, 0.01);
    // Plateaus at the threshold itself.
    EXPECT_NEAR(at(Comparison::Greater, 3.0, 1.0), 2.0, 0.01);
    EXPECT_NEAR(at(Comparison::GreaterOrEqual, 3.0, 1.0), -1.0, 0.01); // to the face of the box
    EXPECT_NEAR(at(Comparison::Less, 6.0, 8.0), 2.0, 0.01);
    EXPECT_NEAR(at(Comparison::LessOrEqual, 6.0, 8.0), -3.0, 0.01);
}

TEST(SignedDistance, ShearedCellCentredFieldsGiveTheSameBall) {
    Grid grid;
    grid.dims = {40, 36, 30};
    grid.centring = Centring::Cell;
    grid.worldFromIndex = glm::dmat4(1.0);
    grid.worldFromIndex[0] = {0.8, 0.1, 0.0, 0.0};
    grid.worldFromIndex[1] = {0.3, 0.9, 0.0, 0.0};
    grid.worldFromIndex[2] = {-0.2, 0.1, 1.1, 0.0};
    grid.worldFromIndex[3] = {5.0, -3.0, 100.0, 1.0};
    const auto centre = centreWorld(grid);
    const auto volume = signedDistance(grid, sampled(grid, ball(centre, 9.0)), {Comparison::Greater, 0.0});
    const double voxel = glm::length(glm::dvec3(grid.worldFromIndex[0]));
    EXPECT_NEAR(volume.grid.worldFromIndex[0][0], voxel, 1e-12);
    const auto accuracy = accuracyOf(volume, negated(ball(centre, 9.0)));
    // The field itself is an interpolant, with voxels of up to 1.1: about h^2 / (8 R) more.
    EXPECT_LT(accuracy.largestError * voxel, 0.7 * voxel * voxel / 9.0 + 0.04);
    EXPECT_LE(accuracy.largestStep, kStep);
}

TEST(SignedDistance, PeriodicAxesWrapIntoTheClosingSlab) {
    auto grid = cubeGrid(24);
    grid.periodic = glm::bvec3(true);
    // A ball about the corner of the cell: an eighth of it at each of the eight corners of the box.
    const auto nearestCorner = [](const glm::dvec3& p) {
        const auto wrapped = p - 24.0 * glm::round(p / 24.0);
        return 8.0 - glm::length(wrapped);
    };
    const auto volume = signedDistance(grid, sampled(grid, nearestCorner), {Comparison::Greater, 0.0});
    for (const glm::dvec3 corner : {glm::dvec3(0, 0, 0), glm::dvec3(24, 0, 0), glm::dvec3(24, 24, 24)}) {
        const auto inward = glm::dvec3(12.0) - corner;
        EXPECT_NEAR(interpolated(volume, corner + inward / 12.0 * 2.0), -2.0, 0.1); // to the faces
        EXPECT_NEAR(interpolated(volume, corner + inward), std::sqrt(3.0) * 12.0 - 8.0, 0.1);
    }
}

TEST(SignedDistance, WhatTouchesNoValueIsOutside) {
    const auto grid = cubeGrid(20);
    auto values = std::vector<float>(8000, 1.0F);
    for (std::size_t at = 0; at < values.size(); ++at)
        if (at % 20 >= 12) values[at] = std::numeric_limits<float>::quiet_NaN();
    const auto volume = signedDistance(grid, values, {Comparison::Greater, 0.0});
    const auto truth = [](const glm::dvec3& p) { return boxDistance(p, {0, 0, 0}, {11, 19, 19}); };
    EXPECT_LT(accuracyOf(volume, truth).largestError, 0.002);
}

TEST(SignedDistance, StepsAreLimitedForNoiseAndIsolatedSamples) {
    const auto grid = cubeGrid(30);
    std::mt19937 random(9);
    std::vector<float> values(27000);
    for (const unsigned oneIn : {2U, 30U, 3000U}) {
        for (auto& value : values)
            value = random() % oneIn == 0 ? 1.0F : -1.0F;
        const auto volume = signedDistance(grid, values, {Comparison::Greater, 0.0});
        EXPECT_LE(accuracyOf(volume, [](const glm::dvec3&) { return 0.0; }).largestStep, kStep);
        eachSample(grid, [&](std::size_t at, const glm::dvec3& index) {
            const double distance = interpolated(volume, index);
            if (values[at] > 0.0F)
                EXPECT_LT(distance, 0.0);
            else
                EXPECT_GT(distance, 0.0);
        });
    }
}

TEST(SignedDistance, GridsKeepToTheLimitAndHoldTheBox) {
    Grid grid;
    grid.dims = {300, 5, 80};
    grid.worldFromIndex = glm::scale(glm::dmat4(1.0), glm::dvec3(0.5, 40.0, 2.0));
    for (const long limit : {1000L, 50'000L, kMaxDistanceSamples}) {
        const auto distances = distanceGrid(grid, limit);
        EXPECT_LE(sampleCount(distances.dims), limit);
        const double spacing = distances.worldFromIndex[0][0];
        const auto low = worldOf(distances, glm::dvec3(kDistanceMarginSamples));
        const auto high = worldOf(distances, glm::dvec3(distances.dims - 1 - kDistanceMarginSamples));
        EXPECT_NEAR(glm::length(low), 0.0, 1e-9);
        for (int axis = 0; axis < 3; ++axis) {
            const double end = worldOf(grid, boxIndex(grid).high)[axis];
            EXPECT_GE(high[axis], end - 1e-5 * spacing);
            EXPECT_LT(high[axis], end + spacing);
        }
    }
    EXPECT_GT(sampleCount(distanceGrid(grid, 50'000).dims), 40'000); // and make use of it
}

TEST(SignedDistance, RefusesWhatItCannotUse) {
    const auto grid = cubeGrid(4);
    const std::vector<float> values(64);
    EXPECT_THROW((void)signedDistance(grid, values, {Comparison::Less, std::nan("")}), InvalidInput);
    EXPECT_THROW((void)signedDistance(grid, std::span(values).first(63), {}), InvalidInput);
    EXPECT_THROW((void)signedDistance(grid, values, {}, 10), InvalidInput);
    Grid flat = grid;
    flat.worldFromIndex[2] = {};
    EXPECT_THROW((void)signedDistance(flat, values, {}), InvalidInput);
}

TEST(NearestSeed, AgreesWithAllPairs) {
    const glm::ivec3 dims(13, 9, 17);
    std::mt19937 random(1);
    for (const unsigned oneIn : {5U, 100U, 600U}) {
        const auto count = static_cast<std::uint32_t>(sampleCount(dims));
        std::vector<std::uint32_t> seeds(count, kNoSeed);
        std::vector<std::uint32_t> all;
        for (std::uint32_t s = 0; s < count; ++s)
            if (random() % oneIn == 0) all.push_back(seeds[s] = s);
        ASSERT_FALSE(all.empty());
        findNearestSeeds(dims, seeds);
        const auto position = [&](std::uint32_t s) {
            return glm::ivec3(int(s) % 13, int(s) / 13 % 9, int(s) / 13 / 9);
        };
        const auto squared = [&](std::uint32_t a, std::uint32_t b) {
            const auto d = position(a) - position(b);
            return d.x * d.x + d.y * d.y + d.z * d.z;
        };
        for (std::uint32_t s = 0; s < count; ++s) {
            int nearest = std::numeric_limits<int>::max();
            for (const auto seed : all)
                nearest = std::min(nearest, squared(s, seed));
            ASSERT_EQ(squared(s, seeds[s]), nearest);
        }
    }
    std::vector<std::uint32_t> none(static_cast<std::size_t>(sampleCount(dims)), kNoSeed);
    findNearestSeeds(dims, none);
    EXPECT_TRUE(std::all_of(none.begin(), none.end(), [](auto s) { return s == kNoSeed; }));
}

} // namespace
} // namespace voxsheet
