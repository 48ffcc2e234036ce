// VTK's flying edges as a second opinion on where isosurfaces are and which way they face.
//
// Its vertices lie on edges between samples, where linear interpolation and the trilinear interpolant are the
// same. Seen along an axis by pixels that sit on the samples, our rays run along those edges and must meet
// the surface in the vertices. Its normals there are interpolated from central differences at the samples, as
// our gradient texture's are.
#include "fields/scenes.h"
#include "image/measured_hits.h"
#include "image/vtk_flying_edges.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace voxsheet::image {
namespace {

constexpr int kSamples = 40;

struct Case {
    fields::AnalyticField field;
    double isovalue;
    double chord; ///< voxels that a triangle may lie off the surface: curvature times the square of its edge
    std::size_t
        percent; ///< of the rays that this holds for: triangles cut off ridges, and what lies behind shows
};

class VtkSurface : public testing::TestWithParam<ScalarType> {
protected:
    /// Along -`axis`, one pixel per sample.
    static TileSpec alongAxis(const std::string& key, const Grid& grid, double isovalue, int axis) {
        auto tile = fields::tileOf(key, grid, Technique::Isosurface, kSamples);
        tile.transfer = fields::filledTable(-1.0, 1.0);
        tile.isosurface.surfaces = {{isovalue, glm::vec4(1.0F)}};
        glm::dvec3 from(0.0);
        glm::dvec3 up(0.0);
        from[axis] = 1.0;
        up[(axis + 2) % 3] = 1.0;
        const auto spacing = spacingWorld(grid);
        const auto centre = centreWorld(grid);
        tile.camera.projection = Projection::Orthographic;
        tile.camera.viewFromWorld = glm::lookAt(centre + boundingRadiusWorld(grid) * 2.0 * from, centre, up);
        // Right is the axis that follows, up the one after it; the picture's aspect must be that of a voxel.
        const int right = (axis + 1) % 3;
        tile.camera.heightWorld = kSamples * spacing[(axis + 2) % 3];
        EXPECT_EQ(spacing[right], spacing[(axis + 2) % 3]) << "pixels are square";
        return tile;
    }

    /// The vertex that a ray along -axis meets first, for each pair of the other two indices.
    static std::map<std::pair<int, int>, VtkFlyingEdges::Vertex> firstVertices(const VtkFlyingEdges& mesh,
                                                                               int axis) {
        std::map<std::pair<int, int>, VtkFlyingEdges::Vertex> first;
        for (const auto& vertex : mesh.vertices()) {
            const double x = vertex.position[(axis + 1) % 3];
            const double y = vertex.position[(axis + 2) % 3];
            if (std::abs(x - std::round(x)) > 1e-5 || std::abs(y - std::round(y)) > 1e-5)
                continue; // another edge
            const std::pair key(static_cast<int>(std::round(x)), static_cast<int>(std::round(y)));
            const auto found = first.find(key);
            if (found == first.end() || found->second.position[axis] < vertex.position[axis])
                first[key] = vertex;
        }
        return first;
    }

    TilePainter painter;
};

std::vector<Case> cases() {
    return {{fields::torusDistance(), 0.013, 0.1, 99},
            {fields::sphereDistance(0.7), 0.0, 0.1, 99},
            {fields::gaussianSum(), 0.4, 0.1, 99},
            {fields::marschnerLobb(), 0.5, 0.15, 80}};
}

TEST_P(VtkSurface, VerticesAndNormalsAreWhatRaysAlongEdgesMeet) {
    const auto grid = fields::gridOf(fields::Geometry::Isotropic, kSamples);
    for (const auto& [field, isovalue, chord, percent] : cases()) {
        const auto sampled = fields::sampleField(field, grid, GetParam(), field.name);
        painter.volumes().add(sampled.meta, sampled.arrays);
        const VtkFlyingEdges mesh(sampled, isovalue);
        double farthest = 0.0;
        double steepest = 1.0;
        std::size_t compared = 0;
        for (int axis = 0; axis < 3; ++axis) {
            // One dataset each: positions are measured by volumes named after it.
            const auto key = field.name + " axis " + std::to_string(axis);
            auto copy = sampled;
            copy.meta.key = key;
            painter.volumes().add(copy.meta, copy.arrays);
            auto tile = alongAxis(key, grid, isovalue, axis);
            tile.shading.gradient = GradientSource::Texture;
            const auto positions = measuredPositions(painter, tile);
            const auto normals = measuredNormals(painter, tile);
            for (const auto& [place, vertex] : firstVertices(mesh, axis)) {
                const auto [x, y] = place;
                if (x == 0 || y == 0 || x == kSamples - 1 || y == kSamples - 1)
                    continue; // rays in the box's faces
                const auto pixel = static_cast<std::size_t>(y * kSamples + x);
                ASSERT_EQ(positions[pixel].surface, 0) << "a hole";
                farthest = std::max(farthest, glm::distance(positions[pixel].position, vertex.position));
                steepest = std::min(steepest, std::abs(glm::dot(normals[pixel].normal, vertex.normal)));
                ++compared;
            }
        }
        const double degrees = glm::degrees(std::acos(std::min(steepest, 1.0)));
        std::printf("%s %s: %zu vertices, farthest %.4f voxel, normals off by %.3f degrees\n",
                    field.name.c_str(), scalarName(GetParam()), compared, farthest, degrees);
        EXPECT_GT(compared, 300U);
        // What refinement promises, and VTK's 32-bit floats.
        EXPECT_LE(farthest, 0.01 + measuredPositionError(grid)) << field.name;
        // 16-bit floats of the gradient texture; weights of GPUs' filters in steps of 1/256 voxel.
        EXPECT_LE(degrees, painter.filtersExactly() ? 0.2 : 0.6) << field.name;
    }
}

TEST_P(VtkSurface, TrianglesLieWithinTheirChordsOfTheSurface) {
    const auto grid = fields::gridOf(fields::Geometry::Anisotropic, kSamples);
    for (const auto& [field, isovalue, chord, percent] : cases()) {
        const auto sampled = fields::sampleField(field, grid, GetParam(), field.name);
        painter.volumes().add(sampled.meta, sampled.arrays);
        const VtkFlyingEdges mesh(sampled, isovalue);
        auto tile = fields::tileOf(field.name, grid, Technique::Isosurface, 96);
        tile.transfer = fields::filledTable(-1.0, 1.0);
        tile.isosurface.surfaces = {{isovalue, glm::vec4(1.0F)}};
        const auto hits = fields::isosurfaceHits(tile, fields::sourcesOf(painter.provider(), tile));
        const auto silhouette = fields::silhouettes(hits, tile.sizePixels, 3.0 * meanVoxelEdgeWorld(grid));
        const auto positions = measuredPositions(painter, tile);
        std::vector<double> apart;
        std::size_t holes = 0;
        for (std::size_t i = 0; i < hits.size(); ++i) {
            if (silhouette[i]) continue;
            const auto ray = fields::worldRay(tile, double(i % 96) + 0.5, double(i / 96) + 0.5);
            const double depth = 4.0 * glm::length(glm::dvec3(grid.dims)) * glm::length(spacingWorld(grid));
            const auto met = mesh.firstMeeting(ray.origin, ray.at(depth));
            holes += met.has_value() != (positions[i].surface >= 0) ? 1U : 0U;
            if (met && positions[i].surface >= 0)
                apart.push_back(glm::distance(*met, positions[i].position) / meanVoxelEdgeWorld(grid));
        }
        std::sort(apart.begin(), apart.end());
        ASSERT_GT(apart.size(), 200U);
        const double most = apart[apart.size() * percent / 100];
        std::printf(
            "%s %s: along %zu rays median %.4f, %zu %% %.4f, farthest %.4f voxel; %zu met by one only\n",
            field.name.c_str(), scalarName(GetParam()), apart.size(), apart[apart.size() / 2], percent, most,
            apart.back(), holes);
        EXPECT_LE(most, chord) << field.name;
        EXPECT_LE(holes, apart.size() / 100) << field.name;
    }
}

INSTANTIATE_TEST_SUITE_P(All, VtkSurface, testing::Values(ScalarType::U8, ScalarType::U16, ScalarType::F32),
                         [](const testing::TestParamInfo<ScalarType>& type) {
                             return scalarName(type.param);
                         });

} // namespace
} // namespace voxsheet::image
