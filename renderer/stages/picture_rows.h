// A part of a picture: whole rows.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <limits>

namespace voxsheet {

/// Rows [first, end) of a picture, counted from the bottom; `first` a multiple of 8. All of them by default.
struct PictureRows {
    int first = 0;
    int end = std::numeric_limits<int>::max();

    [[nodiscard]] PictureRows within(glm::ivec2 sizePixels) const {
        return {std::max(first, 0), std::min(end, sizePixels.y)};
    }
};

} // namespace voxsheet
