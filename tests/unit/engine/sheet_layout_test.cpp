#include "base/errors.h"
#include "engine/sheet_layout.h"

#include <gtest/gtest.h>

namespace voxsheet::engine {
namespace {

bool overlap(const PixelRect& a, const PixelRect& b) {
    return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y;
}

std::vector<PixelRect> all(const SheetLayout& layout) {
    std::vector<PixelRect> rects;
    if (layout.title.size().x > 0) rects.push_back(layout.title);
    for (const auto* list :
         {&layout.columnHeaders, &layout.rowHeaders, &layout.cellTitles, &layout.pictures}) {
        rects.insert(rects.end(), list->begin(), list->end());
    }
    return rects;
}

TEST(SheetLayout, NothingOverlapsAndAllIsInside) {
    for (const bool title : {false, true}) {
        for (const bool headers : {false, true}) {
            for (const glm::ivec2 size : {glm::ivec2(0), glm::ivec2(1280, 800), glm::ivec2(700, 1500)}) {
                SheetLayoutRequest request;
                request.sizePixels = size;
                request.columns = 4;
                request.rows = 3;
                request.title = title;
                request.headers = headers;
                request.cellTitles = headers;
                request.rowHeaderLetters = 6;
                const SheetLayout layout = layoutSheet(request);
                if (size.x > 0) {
                    EXPECT_EQ(layout.sizePixels, size);
                }
                ASSERT_EQ(layout.pictures.size(), 12U);
                const auto rects = all(layout);
                for (std::size_t i = 0; i < rects.size(); ++i) {
                    EXPECT_TRUE(rects[i].low.x >= 0 && rects[i].low.y >= 0);
                    EXPECT_TRUE(rects[i].high.x <= layout.sizePixels.x &&
                                rects[i].high.y <= layout.sizePixels.y);
                    for (std::size_t j = 0; j < i; ++j)
                        EXPECT_FALSE(overlap(rects[i], rects[j])) << i << " " << j;
                }
                for (const PixelRect& picture : layout.pictures) {
                    EXPECT_EQ(picture.size(), layout.pictures.front().size()) << "tiles of one size compare";
                }
            }
        }
    }
}

TEST(SheetLayout, WithoutASizeEachCellHasTheDefault) {
    SheetLayoutRequest request;
    request.columns = 2;
    request.rows = 2;
    EXPECT_EQ(layoutSheet(request).pictures[3].size(), kDefaultCellPixels);
}

TEST(SheetLayout, ABareCellFillsNearlyAll) {
    SheetLayoutRequest request;
    request.sizePixels = {512, 512};
    EXPECT_GT(layoutSheet(request).pictures[0].size().x, 480);
}

TEST(SheetLayout, TooSmallAndTooLargeAreErrorsThatNameTheField) {
    SheetLayoutRequest request;
    request.columns = 100;
    request.rows = 100;
    request.sizePixels = {800, 800};
    EXPECT_THROW(static_cast<void>(layoutSheet(request)), InvalidInput);
    request.sizePixels = {0, 0};
    EXPECT_THROW(static_cast<void>(layoutSheet(request)), LimitExceeded);
}

} // namespace
} // namespace voxsheet::engine
