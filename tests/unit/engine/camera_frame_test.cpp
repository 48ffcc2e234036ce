// Cells of different origin and size under one camera.
#include "engine/camera_frame.h"
#include "engine/cell_resolver.h"
#include "engine/crosshair.h"
#include "engine/plane_resolver.h"

#include <gtest/gtest.h>

namespace voxsheet::engine {
namespace {

/// `edge` + 1 samples a side, one apart, the first at `origin`.
Grid cube(int edge, const glm::dvec3& origin) {
    Grid grid;
    grid.dims = glm::ivec3(edge + 1);
    grid.worldFromIndex[3] = glm::dvec4(origin, 1.0);
    return grid;
}

const Grid kSmall = cube(10, {0, 0, 0});
const Grid kLarge = cube(40, {100, 0, 0});
const FrameBounds kBounds = boundsOf({kSmall, kLarge});

sheet::TypedStyle styleOf(const sheet::StyleMap& values) {
    static const sheet::KeyTable keys = sheet::makeKeyTable(ColourMapTable::embedded().names());
    sheet::Sheet sheet;
    sheet.style = values;
    return sheet::resolveStyle(keys, sheet, {0, 0}).style;
}

constexpr glm::ivec2 kSize{200, 200};

glm::dvec2 seenAt(const sheet::TypedStyle& style, const CameraFrame& frame, const glm::dvec3& point) {
    return pixelAt(resolveCamera(style.camera, frame, kSize), point, kSize).value();
}

TEST(CameraFrame, FitShowsEachVolumeEquallyLarge) {
    const auto style = styleOf({{"camera.projection", std::string("orthographic")}});
    for (const Grid& grid : {kSmall, kLarge}) {
        const CameraFrame frame = linkedFrame(sheet::FrameMode::Fit, grid, kBounds);
        EXPECT_FALSE(frame.sizeWorld);
        const glm::dvec3 top = centreWorld(grid) + glm::dvec3(0, 0, boundingRadiusWorld(grid));
        EXPECT_NEAR(seenAt(style, frame, top).y,
                    seenAt(style, ownFrame(kSmall), glm::dvec3(5, 5, 5 + boundingRadiusWorld(kSmall))).y,
                    1e-9);
    }
}

TEST(CameraFrame, CentreShowsEachVolumeInTheMiddleInOneScale) {
    const auto style = styleOf({{"camera.projection", std::string("orthographic")}});
    double pixelsPerUnit = 0.0;
    for (const Grid& grid : {kSmall, kLarge}) {
        const CameraFrame frame = linkedFrame(sheet::FrameMode::Centre, grid, kBounds);
        const glm::dvec3 centre = centreWorld(grid);
        EXPECT_NEAR(glm::distance(seenAt(style, frame, centre), glm::dvec2(100, 100)), 0.0, 1e-9);
        const double unit =
            glm::distance(seenAt(style, frame, centre + glm::dvec3(0, 0, 1)), glm::dvec2(100));
        if (pixelsPerUnit > 0.0) {
            EXPECT_NEAR(unit, pixelsPerUnit, 1e-9);
        }
        pixelsPerUnit = unit;
    }
}

TEST(CameraFrame, WorldShowsOnePlaceInEveryCellAndAllOfEveryVolume) {
    const auto style = styleOf({});
    const CameraFrame small = linkedFrame(sheet::FrameMode::World, kSmall, kBounds);
    const CameraFrame large = linkedFrame(sheet::FrameMode::World, kLarge, kBounds);
    for (const glm::dvec3 point : {glm::dvec3(3, 4, 5), glm::dvec3(130, 20, 20)})
        EXPECT_NEAR(glm::distance(seenAt(style, small, point), seenAt(style, large, point)), 0.0, 1e-9);
    for (const glm::dvec3 corner :
         {glm::dvec3(0), glm::dvec3(10), glm::dvec3(100, 0, 0), glm::dvec3(140, 40, 40)}) {
        const glm::dvec2 at = seenAt(style, small, corner);
        EXPECT_TRUE(at.x >= 0 && at.x <= 200 && at.y >= 0 && at.y <= 200) << at.x << " " << at.y;
    }
}

TEST(CameraFrame, PlanesOfLinkedCellsHaveOneScaleOnEveryAxis) {
    const auto height = [](sheet::FrameMode mode, const Grid& grid, sheet::PlaneAxis axis) {
        sheet::PlaneStyle plane;
        plane.axis = axis;
        sheet::CameraStyle camera = styleOf({}).camera;
        return resolvePlaneCamera(plane, camera, grid, false, kSize, linkedFrame(mode, grid, kBounds))
            .heightWorld;
    };
    EXPECT_NEAR(height(sheet::FrameMode::Fit, kSmall, sheet::PlaneAxis::Axial), 10.4, 1e-9);
    for (const auto axis : {sheet::PlaneAxis::Axial, sheet::PlaneAxis::Coronal, sheet::PlaneAxis::Sagittal}) {
        EXPECT_NEAR(height(sheet::FrameMode::Centre, kSmall, axis), 41.6, 1e-9);
        EXPECT_NEAR(height(sheet::FrameMode::Centre, kLarge, axis), 41.6, 1e-9);
        EXPECT_NEAR(height(sheet::FrameMode::World, kSmall, axis), 1.04 * 140.0, 1e-9);
    }
}

} // namespace
} // namespace voxsheet::engine
