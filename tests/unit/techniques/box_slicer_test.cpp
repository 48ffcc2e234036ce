#include "techniques/slicing/box_slicer.h"

#include "base/errors.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace voxsheet {
namespace {

BoxCorners cornersOf(const glm::dmat4& viewFromUnit) {
    BoxCorners corners{};
    for (int corner = 0; corner < 8; ++corner)
        corners[static_cast<std::size_t>(corner)] =
            glm::dvec3(viewFromUnit * glm::dvec4(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1, 1.0));
    return corners;
}

double signedArea(const Slice& slice) {
    double sum = 0.0;
    for (int i = 0; i < slice.points; ++i) {
        const auto& a = slice.ring[static_cast<std::size_t>(i)];
        const auto& b = slice.ring[static_cast<std::size_t>((i + 1) % slice.points)];
        sum += a.x * b.y - b.x * a.y;
    }
    return 0.5 * sum;
}

double volumeOf(const glm::dmat4& viewFromUnit) {
    return std::abs(glm::determinant(glm::dmat3(viewFromUnit)));
}

glm::dmat4 randomBox(std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    glm::dmat4 matrix(1.0);
    do {
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 3; ++row)
                matrix[column][row] = uniform(random);
    } while (volumeOf(matrix) < 0.05);
    return matrix;
}

TEST(BoxSlicer, SlicesOfACubeSeenFromTheFrontAreItsFace) {
    const auto slices = sliceBox(cornersOf(glm::dmat4(1.0)), {0.0, 0.25, -10.0});
    ASSERT_EQ(slices.size(), 4U);
    for (std::size_t i = 0; i < slices.size(); ++i) {
        EXPECT_NEAR(slices[i].depth, 0.875 - 0.25 * double(i), 1e-12);
        EXPECT_EQ(slices[i].points, 4);
        EXPECT_NEAR(std::abs(signedArea(slices[i])), 1.0, 1e-12);
    }
}

TEST(BoxSlicer, ADiagonalViewMakesTrianglesAndHexagons) {
    auto view = glm::rotate(glm::dmat4(1.0), std::acos(1.0 / std::sqrt(3.0)),
                            glm::normalize(glm::dvec3(1.0, -1.0, 0.0)));
    const auto slices = sliceBox(cornersOf(view), {0.0, 0.01, -10.0});
    const auto has = [&](int points) {
        return std::any_of(slices.begin(), slices.end(),
                           [&](const Slice& slice) { return slice.points == points; });
    };
    EXPECT_TRUE(has(3));
    EXPECT_TRUE(has(6));
    EXPECT_NEAR(double(slices.size()) * 0.01, std::sqrt(3.0), 0.02);
}

TEST(BoxSlicer, AreasTimesSpacingAreTheVolumeOfAnyBox) {
    std::mt19937 random(3);
    for (int trial = 0; trial < 200; ++trial) {
        const auto box = randomBox(random);
        constexpr double spacing = 1e-3;
        double volume = 0.0;
        double previous = 1e9;
        for (const auto& slice : sliceBox(cornersOf(box), {0.3, spacing, -10.0})) {
            EXPECT_LT(slice.depth, previous) << "not from far to near";
            previous = slice.depth;
            volume += spacing * std::abs(signedArea(slice));
        }
        EXPECT_NEAR(volume, volumeOf(box), 2e-3) << trial;
    }
}

TEST(BoxSlicer, RingsAreConvexInOrderAndOnTheBox) {
    std::mt19937 random(4);
    for (int trial = 0; trial < 100; ++trial) {
        const auto box = randomBox(random);
        const auto unitFromView = glm::inverse(box);
        for (const auto& slice : sliceBox(cornersOf(box), {0.0, 0.0137, -10.0})) {
            ASSERT_GE(slice.points, 3);
            const double orientation = signedArea(slice) < 0.0 ? -1.0 : 1.0;
            for (int i = 0; i < slice.points; ++i) {
                const auto point = [&](int k) {
                    return slice.ring[static_cast<std::size_t>((i + k) % slice.points)];
                };
                const auto ab = point(1) - point(0);
                const auto bc = point(2) - point(1);
                EXPECT_GE(orientation * (ab.x * bc.y - ab.y * bc.x), -1e-9);
                const auto unit = glm::dvec3(unitFromView * glm::dvec4(point(0), slice.depth, 1.0));
                int onFaces = 0;
                for (int axis = 0; axis < 3; ++axis) {
                    EXPECT_GT(unit[axis], -1e-9);
                    EXPECT_LT(unit[axis], 1.0 + 1e-9);
                    if (std::abs(unit[axis]) < 1e-7 || std::abs(unit[axis] - 1.0) < 1e-7) ++onFaces;
                }
                EXPECT_GE(onFaces, 2) << "a corner of a slice lies on an edge of the box";
            }
        }
    }
}

TEST(BoxSlicer, OnlyPlanesBeyondTheNearestDepthAreCut) {
    const auto slices = sliceBox(cornersOf(glm::dmat4(1.0)), {0.0, 0.25, 0.5});
    ASSERT_EQ(slices.size(), 2U);
    EXPECT_GT(slices.back().depth, 0.5);
    EXPECT_TRUE(sliceBox(cornersOf(glm::dmat4(1.0)), {0.0, 0.25, 2.0}).empty());
}

TEST(BoxSlicer, RefusesMillionsOfSlices) {
    EXPECT_THROW((void)sliceBox(cornersOf(glm::dmat4(1.0)), {0.0, 1e-8, -1.0}), InvalidInput);
}

} // namespace
} // namespace voxsheet
