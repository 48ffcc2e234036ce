// The box of a volume as pages and scripts get it.
#include "engine/dataset_json.h"

#include <gtest/gtest.h>

namespace voxsheet {
namespace {

using nlohmann::json;

/// A sheared grid of steps (2, 0, 0), (1, 3, 0), (0, 0, 0.5), whose first sample sits at (10, 20, 30).
Grid shearedGrid() {
    Grid grid;
    grid.dims = {5, 4, 9};
    grid.worldFromIndex = glm::dmat4(glm::dvec4(2, 0, 0, 0), glm::dvec4(1, 3, 0, 0), glm::dvec4(0, 0, 0.5, 0),
                                     glm::dvec4(10, 20, 30, 1));
    return grid;
}

TEST(DatasetJson, BoxOfPointsRunsFromFirstToLastSample) {
    EXPECT_EQ(engine::describeBox(shearedGrid()),
              (json{{"origin", {10.0, 20.0, 30.0}},
                    {"edges", {{8.0, 0.0, 0.0}, {3.0, 9.0, 0.0}, {0.0, 0.0, 4.0}}},
                    {"voxels", {4.0, 3.0, 8.0}},
                    {"firstSample", {0.0, 0.0, 0.0}}}));
}

TEST(DatasetJson, BoxOfCellsReachesHalfAVoxelFurther) {
    Grid grid = shearedGrid();
    grid.centring = Centring::Cell;
    // Half a step back along every axis: (2 + 1, 3, 0.5) / 2.
    EXPECT_EQ(engine::describeBox(grid),
              (json{{"origin", {8.5, 18.5, 29.75}},
                    {"edges", {{10.0, 0.0, 0.0}, {4.0, 12.0, 0.0}, {0.0, 0.0, 4.5}}},
                    {"voxels", {5.0, 4.0, 9.0}},
                    {"firstSample", {0.5, 0.5, 0.5}}}));
}

TEST(DatasetJson, BoxOfAPeriodicAxisIncludesTheClosingSlab) {
    Grid grid = shearedGrid();
    grid.periodic = {false, true, false};
    EXPECT_EQ(engine::describeBox(grid).at("edges").at(1), (json{4.0, 12.0, 0.0}));
}

TEST(DatasetJson, DatasetsCarryTheirBox) {
    DatasetMeta meta;
    meta.grid = shearedGrid();
    meta.fields.emplace_back();
    EXPECT_EQ(engine::describeDataset(meta).at("box"), engine::describeBox(meta.grid));
}

} // namespace
} // namespace voxsheet
