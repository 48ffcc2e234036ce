// Where everything stands in the picture of a whole sheet. Pure arithmetic, in pixels from the top left
// corner.
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace voxsheet::engine {

struct PixelRect {
    glm::ivec2 low{0};  ///< included
    glm::ivec2 high{0}; ///< not included

    bool operator==(const PixelRect&) const = default;
    [[nodiscard]] glm::ivec2 size() const { return high - low; }
};

/// What a sheet's picture is made of.
struct SheetLayoutRequest {
    glm::ivec2 sizePixels{0}; ///< of the whole picture; 0 = kDefaultCellPixels per cell's picture
    int columns = 1;
    int rows = 1;
    bool title = false;       ///< a band above everything
    bool headers = false;     ///< column names above, row names on the left
    int rowHeaderLetters = 1; ///< of the longest row header
    bool cellTitles = false;  ///< a strip above each cell's picture
};

inline constexpr glm::ivec2 kDefaultCellPixels{320, 240};
inline constexpr int kMaxSheetPixels = 50'000'000;

struct SheetLayout {
    glm::ivec2 sizePixels{0};
    int fontPixels = 12;
    PixelRect title;                      ///< empty without one
    std::vector<PixelRect> columnHeaders; ///< one per column; empty without headers
    std::vector<PixelRect> rowHeaders;    ///< one per row; empty without headers
    std::vector<PixelRect> cellTitles;    ///< row by row; empty without titles
    std::vector<PixelRect> pictures;      ///< row by row; all of one size, so that they compare
};

/// Throws InvalidInput (field "width") if a cell would be smaller than 16x16 pixels, LimitExceeded beyond
/// kMaxSheetPixels.
[[nodiscard]] SheetLayout layoutSheet(const SheetLayoutRequest& request);

} // namespace voxsheet::engine
