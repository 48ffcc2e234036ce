#include "engine/sheet_layout.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace voxsheet::engine {

namespace {

/// Heights and widths of the parts that are not pictures, all from the size of the letters.
struct Bands {
    int title = 0;
    int columnHeader = 0;
    int rowHeader = 0;
    int cellTitle = 0;
    int gap = 0;
};

int fontFor(glm::ivec2 cell) {
    return static_cast<int>(std::lround(std::clamp(std::min(cell.x / 24.0, cell.y / 16.0), 9.0, 26.0)));
}

Bands bandsFor(const SheetLayoutRequest& request, int font) {
    Bands bands;
    bands.gap = std::max(2, font / 4);
    if (request.title) bands.title = font * 5 / 2;
    if (request.headers) {
        bands.columnHeader = font * 7 / 4;
        bands.rowHeader = std::max(font * 2, font * std::min(request.rowHeaderLetters, 14) * 5 / 8 + font);
    }
    if (request.cellTitles) bands.cellTitle = font * 7 / 4;
    return bands;
}

glm::ivec2 pictureSize(const SheetLayoutRequest& request, const Bands& bands) {
    const int width = request.sizePixels.x - bands.rowHeader - bands.gap * (request.columns + 1);
    const int height = request.sizePixels.y - bands.title - bands.columnHeader -
                       bands.gap * (request.rows + 1) - bands.cellTitle * request.rows;
    return {width / request.columns, height / request.rows};
}

} // namespace

SheetLayout layoutSheet(const SheetLayoutRequest& request) {
    SheetLayout layout;
    glm::ivec2 cell = kDefaultCellPixels;
    if (request.sizePixels.x > 0) cell = request.sizePixels / glm::ivec2(request.columns, request.rows);
    layout.fontPixels = fontFor(cell);
    const Bands bands = bandsFor(request, layout.fontPixels);
    layout.sizePixels = request.sizePixels;
    glm::ivec2 picture = kDefaultCellPixels;
    if (request.sizePixels.x > 0) {
        picture = pictureSize(request, bands);
    } else {
        layout.sizePixels = {bands.rowHeader + bands.gap + request.columns * (picture.x + bands.gap),
                             bands.title + bands.columnHeader + bands.gap +
                                 request.rows * (bands.cellTitle + picture.y + bands.gap)};
    }
    if (picture.x < 16 || picture.y < 16) {
        throw InvalidInput("picture of the sheet",
                           "its cells would be smaller than 16x16 pixels at " +
                               std::to_string(request.sizePixels.x) + "x" +
                               std::to_string(request.sizePixels.y),
                           "ask for a larger picture or a smaller range")
            .withField("width");
    }
    if (static_cast<long>(layout.sizePixels.x) * layout.sizePixels.y > kMaxSheetPixels) {
        throw LimitExceeded("picture of the sheet", "it would have more than 50 million pixels",
                            "ask for a smaller picture or a smaller range")
            .withField("width");
    }
    const glm::ivec2 cells(bands.rowHeader + bands.gap, bands.title + bands.columnHeader + bands.gap);
    const glm::ivec2 step(picture.x + bands.gap, bands.cellTitle + picture.y + bands.gap);
    if (request.title) layout.title = {{0, 0}, {layout.sizePixels.x, bands.title}};
    for (int column = 0; column < request.columns && request.headers; ++column) {
        const int x = cells.x + column * step.x;
        layout.columnHeaders.push_back({{x, bands.title}, {x + picture.x, bands.title + bands.columnHeader}});
    }
    for (int row = 0; row < request.rows; ++row) {
        const int y = cells.y + row * step.y;
        if (request.headers) {
            layout.rowHeaders.push_back({{0, y}, {bands.rowHeader, y + bands.cellTitle + picture.y}});
        }
        for (int column = 0; column < request.columns; ++column) {
            const glm::ivec2 low(cells.x + column * step.x, y);
            const glm::ivec2 below = low + glm::ivec2(0, bands.cellTitle);
            if (request.cellTitles) layout.cellTitles.push_back({low, {low.x + picture.x, below.y}});
            layout.pictures.push_back({below, below + picture});
        }
    }
    return layout;
}

} // namespace voxsheet::engine
