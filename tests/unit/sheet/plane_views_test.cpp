// Three planes beside a volume: where they go, and what they take along.
#include "sheet/plane_views.h"

#include "sheet_fixture.h"

namespace voxsheet::sheet {
namespace {

Workbook withPlanes(Workbook workbook, const std::vector<Address>& cells) {
    for (const Command& command : planesBeside(workbook, testKeys(), "Sheet1", cells))
        workbook = apply(workbook, command, testKeys());
    return workbook;
}

TypedStyle styleAt(const Workbook& workbook, const Address& cell) {
    return resolveStyle(testKeys(), workbook.sheets.front(), cell).style;
}

std::string sourceAt(const Workbook& workbook, const Address& cell) {
    const Cell* found = workbook.sheets.front().find(cell);
    return found != nullptr ? found->source : "";
}

TEST(PlaneViews, OneCellGetsItsPlanesToTheRight) {
    const Workbook made = withPlanes(filledWorkbook(1, 1), {{0, 0}});
    EXPECT_EQ(made.sheets.front().columns, 4);
    EXPECT_EQ(styleAt(made, {0, 0}).technique, Technique::Raycast);
    const std::vector<PlaneAxis> axes{PlaneAxis::Axial, PlaneAxis::Coronal, PlaneAxis::Sagittal};
    for (int i = 0; i < 3; ++i) {
        const Address cell{i + 1, 0};
        EXPECT_EQ(sourceAt(made, cell), "d1");
        EXPECT_EQ(styleAt(made, cell).technique, Technique::Plane);
        EXPECT_EQ(styleAt(made, cell).plane.axis, axes.at(static_cast<std::size_t>(i)));
        EXPECT_EQ(styleAt(made, cell).plane.crosshair, glm::dvec3(0.5));
    }
    EXPECT_EQ(cellTitle(*made.sheets.front().find({3, 0})), "d1, sagittal");
    EXPECT_EQ(ownStyle(made.sheets.front(), Layer::sheet()).count("plane.crosshair"), 1U)
        << "linked over the sheet";
}

TEST(PlaneViews, AColumnOfCellsGetsThemToTheRightARowBelow) {
    const Workbook column = withPlanes(filledWorkbook(1, 3), {{0, 0}, {0, 1}, {0, 2}});
    EXPECT_EQ(column.sheets.front().columns, 4);
    EXPECT_EQ(column.sheets.front().rows, 3);
    EXPECT_EQ(sourceAt(column, {3, 2}), "d3");
    const Workbook row = withPlanes(filledWorkbook(3, 1), {{0, 0}, {1, 0}, {2, 0}});
    EXPECT_EQ(row.sheets.front().columns, 3);
    EXPECT_EQ(row.sheets.front().rows, 4);
    EXPECT_EQ(sourceAt(row, {2, 1}), "d3");
    EXPECT_EQ(styleAt(row, {2, 3}).plane.axis, PlaneAxis::Sagittal);
}

TEST(PlaneViews, WhereNothingIsFreeRowsAreInsertedAndFormulasFollow) {
    Workbook workbook = filledWorkbook(2, 2);
    workbook = apply(workbook, SetSource{"Sheet1", {1, 1}, "=A2"}, testKeys());
    const Workbook made = withPlanes(workbook, {{0, 0}, {1, 0}, {0, 1}});
    EXPECT_EQ(made.sheets.front().rows, 8);
    EXPECT_EQ(sourceAt(made, {1, 3}), "d2");
    EXPECT_EQ(sourceAt(made, {0, 4}), "d3");
    EXPECT_EQ(sourceAt(made, {1, 4}), "=A5");
    EXPECT_EQ(sourceAt(made, {0, 7}), "d3");
    EXPECT_EQ(sourceAt(made, {1, 7}), "");
}

TEST(PlaneViews, PlanesLookAsTheCellDoesAndAPlaneBecomesAVolume) {
    Workbook workbook = filledWorkbook(1, 1);
    const auto set = [&](const char* key, const StyleValue& value) {
        workbook = apply(workbook, SetStyle{"Sheet1", Layer::ofCell({0, 0}), {{key, value}}}, testKeys());
    };
    set("transfer.map", std::string("grey"));
    set("technique", std::string("plane"));
    set("plane.position", 0.2);
    set("plane.crosshair", glm::dvec3(0.1, 0.2, 0.3));
    const Workbook made = withPlanes(workbook, {{0, 0}});
    EXPECT_EQ(styleAt(made, {2, 0}).transfer.map, "grey");
    EXPECT_EQ(styleAt(made, {2, 0}).plane.crosshair, glm::dvec3(0.1, 0.2, 0.3)) << "there is one already";
    EXPECT_EQ(styleAt(made, {2, 0}).plane.position, 0.5);
    EXPECT_EQ(styleAt(made, {0, 0}).technique, Technique::Raycast);
    EXPECT_EQ(ownStyle(made.sheets.front(), Layer::sheet()).count("plane.crosshair"), 0U);
}

TEST(PlaneViews, CellsWithoutAVolumeAreRefused) {
    const Workbook workbook = filledWorkbook(2, 1);
    const auto planes = [&](const std::vector<Address>& cells) {
        static_cast<void>(planesBeside(workbook, testKeys(), "Sheet1", cells));
    };
    EXPECT_EQ(caught<InvalidInput>([&] { planes({}); }).field(), "cells");
    caught<NotFound>([&] { planes({{5, 5}}); });
    Workbook blank;
    EXPECT_THROW(static_cast<void>(planesBeside(blank, testKeys(), "Sheet1", {{0, 0}})), InvalidInput);
}

} // namespace
} // namespace voxsheet::sheet
