#include "volume/convex_polytope.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace voxsheet {
namespace {

/// A box of edge 10 along x, y and z, its corner at the origin.
Grid cube() {
    Grid grid;
    grid.dims = glm::ivec3(11);
    return grid;
}

Grid sheared() {
    Grid grid = cube();
    grid.worldFromIndex[0] = {1.0, 0.2, 0.0, 0.0};
    grid.worldFromIndex[1] = {0.4, 0.9, 0.1, 0.0};
    grid.worldFromIndex[2] = {-0.3, 0.2, 1.3, 0.0};
    grid.worldFromIndex[3] = {7.0, -2.0, 3.0, 1.0};
    return grid;
}

double boxVolume(const Grid& grid) {
    return 1000.0 * std::abs(glm::determinant(glm::dmat3(grid.worldFromIndex)));
}

ClipPlane plane(const glm::dvec3& normal, double offset) {
    const double length = glm::length(normal);
    return {normal / length, offset / length};
}

/// Every edge belongs to exactly two faces, once in each direction: closed and consistently oriented.
void expectClosed(const ConvexPolytope& polytope) {
    const auto name = [](const glm::dvec3& p) {
        const auto rounded = [](double v) { return static_cast<long>(std::llround(v * 1e7)); };
        return std::array<long, 3>{rounded(p.x), rounded(p.y), rounded(p.z)};
    };
    std::map<std::pair<std::array<long, 3>, std::array<long, 3>>, int> edges;
    for (const auto& face : polytope.faces) {
        ASSERT_GE(face.polygon.size(), 3U);
        for (std::size_t i = 0; i < face.polygon.size(); ++i)
            ++edges[{name(face.polygon[i]), name(face.polygon[(i + 1) % face.polygon.size()])}];
    }
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(edges.count({edge.second, edge.first}), 1U) << "an edge with one face only";
    }
}

void expectFlatAndOutward(const ConvexPolytope& polytope) {
    glm::dvec3 centre(0.0);
    double points = 0.0;
    for (const auto& face : polytope.faces)
        for (const auto& point : face.polygon) {
            centre += point;
            points += 1.0;
        }
    centre /= points;
    for (const auto& face : polytope.faces) {
        EXPECT_NEAR(glm::length(face.outwardNormal), 1.0, 1e-12);
        EXPECT_GT(glm::dot(face.outwardNormal, face.polygon[0] - centre), 0.0);
        for (const auto& point : face.polygon)
            EXPECT_NEAR(glm::dot(face.outwardNormal, point - face.polygon[0]), 0.0, 1e-9);
        const auto turn = glm::cross(face.polygon[1] - face.polygon[0], face.polygon[2] - face.polygon[0]);
        EXPECT_GT(glm::dot(turn, face.outwardNormal), 0.0) << "counter-clockwise from outside";
    }
}

double volumeOf(const Grid& grid, const std::vector<ClipPlane>& planes) {
    const auto polytope = clippedBox(grid, planes);
    if (!polytope.empty()) {
        expectClosed(polytope);
        expectFlatAndOutward(polytope);
    }
    return polytope.volume();
}

TEST(ConvexPolytope, TheWholeBox) {
    for (const auto& grid : {cube(), sheared()}) {
        EXPECT_NEAR(volumeOf(grid, {}), boxVolume(grid), 1e-9);
        EXPECT_EQ(clippedBox(grid, {}).faces.size(), 6U);
    }
}

TEST(ConvexPolytope, CutsOfTheCubeHaveTheKnownVolumes) {
    EXPECT_NEAR(volumeOf(cube(), {plane({1, 0, 0}, 4.0)}), 600.0, 1e-9);
    EXPECT_NEAR(volumeOf(cube(), {plane({-1, 0, 0}, -4.0)}), 400.0, 1e-9);
    EXPECT_NEAR(volumeOf(cube(), {plane({-1, -1, -1}, -6.0)}), 36.0, 1e-9) << "a corner: 6^3 / 6";
    EXPECT_NEAR(volumeOf(cube(), {plane({1, 1, 1}, 15.0)}), 500.0, 1e-9) << "half, by a hexagon";
    EXPECT_NEAR(volumeOf(cube(), {plane({1, 1, 0}, 10.0)}), 500.0, 1e-9) << "through four corners";
    EXPECT_NEAR(volumeOf(cube(), {plane({1, 1, 1}, 10.0)}), 1000.0 - 1000.0 / 6.0, 1e-9)
        << "through three corners";
}

TEST(ConvexPolytope, ManyPlanes) {
    std::vector<ClipPlane> planes;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 inward((corner & 1) != 0 ? -1 : 1, (corner & 2) != 0 ? -1 : 1,
                                (corner & 4) != 0 ? -1 : 1);
        planes.push_back(plane(inward, glm::dot(inward, glm::dvec3(5.0)) - 12.0));
    }
    EXPECT_NEAR(volumeOf(cube(), planes), 1000.0 - 8.0 * 27.0 / 6.0, 1e-9)
        << "all eight corners off by 3^3 / 6";
    const auto polytope = clippedBox(cube(), planes);
    EXPECT_EQ(polytope.faces.size(), 14U);
    std::set<int> origins;
    for (const auto& face : polytope.faces)
        origins.insert(face.origin);
    EXPECT_EQ(origins.size(), 14U);
    EXPECT_EQ(*origins.rbegin(), ConvexPolytope::boxFaces + 7) << "faces name the plane that cut them";
}

TEST(ConvexPolytope, PlanesThatTouchTakeNothingAndPlanesBeyondTakeAll) {
    EXPECT_NEAR(volumeOf(cube(), {plane({1, 0, 0}, 0.0)}), 1000.0, 1e-9) << "in a face";
    EXPECT_NEAR(volumeOf(cube(), {plane({1, 1, 0}, 0.0)}), 1000.0, 1e-9) << "through an edge";
    EXPECT_NEAR(volumeOf(cube(), {plane({1, 1, 1}, 0.0)}), 1000.0, 1e-9) << "through a corner";
    EXPECT_NEAR(volumeOf(cube(), {plane({1, 0, 0}, -3.0)}), 1000.0, 1e-9) << "before the box";
    EXPECT_TRUE(clippedBox(cube(), std::vector{plane({1, 0, 0}, 11.0)}).empty());
    EXPECT_TRUE(clippedBox(cube(), std::vector{plane({1, 0, 0}, 10.0)}).empty()) << "only a face is left";
    EXPECT_TRUE(clippedBox(cube(), std::vector{plane({1, 0, 0}, 6.0), plane({-1, 0, 0}, -4.0)}).empty());
}

TEST(ConvexPolytope, TheSamePlaneTwiceCutsOnce) {
    EXPECT_NEAR(volumeOf(cube(), {plane({1, 2, 3}, 30.0), plane({1, 2, 3}, 30.0)}),
                volumeOf(cube(), {plane({1, 2, 3}, 30.0)}), 1e-9);
}

TEST(ConvexPolytope, ShearedBoxesAreHalvedThroughTheirCentre) {
    const auto grid = sheared();
    for (const auto& normal : {glm::dvec3(1, 0, 0), glm::dvec3(0.3, -1, 0.2), glm::dvec3(-1, 1, 1)})
        EXPECT_NEAR(volumeOf(grid, {plane(normal, glm::dot(normal, centreWorld(grid)))}),
                    0.5 * boxVolume(grid), 1e-9);
}

TEST(ConvexPolytope, SmallWorldsAreCutAsWell) {
    Grid grid = cube();
    grid.worldFromIndex = glm::dmat4(1e-10); // metres
    grid.worldFromIndex[3] = {3e-9, 0.0, 0.0, 1.0};
    const auto half = clippedBox(grid, std::vector{plane({0, 1, 1}, 1e-9)});
    EXPECT_NEAR(half.volume() / 1e-27, 0.5, 1e-9);
}

} // namespace
} // namespace voxsheet
