// Whether a cell has something to show.
#pragma once

namespace voxsheet::engine {

enum class CellState {
    Empty,
    Pending, ///< its source is being imported or computed
    Ready,
    Error, ///< a value with a code and a sentence
};

} // namespace voxsheet::engine
