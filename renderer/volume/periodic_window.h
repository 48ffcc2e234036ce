// Which stretch of an endlessly repeating volume is drawn. Only geometry: the same samples and textures serve
// every window, because periodic axes wrap wherever they are read.
#pragma once

#include "volume/grid.h"

#include <glm/glm.hpp>

namespace voxsheet {

struct PeriodicWindow {
    /// Moves the data inside the box, which stays where it is: what lay at fraction f of the cell lies at
    /// f + shift; any finite number, wrapped. 0 on axes that are not periodic.
    glm::dvec3 shift{0.0};
    /// Periods drawn per axis, [1, kMaxReplicate]; the box grows from its low corner. 1 on axes that are not
    /// periodic.
    glm::ivec3 replicate{1};

    bool operator==(const PeriodicWindow&) const = default;
};

inline constexpr int kMaxReplicate = 8;

/// Throws InvalidInput (field periodic.shift or periodic.replicate) if the window does not fit the grid.
void validatePeriodicWindow(const PeriodicWindow& window, const Grid& grid);

/// The grid whose box (boxIndex, centreWorld, boundingRadiusWorld) is drawn: that of the data written out
/// `replicate` times (periodic axes only). Its texture frame is not that of the stored samples: see
/// placedGrid.
[[nodiscard]] Grid drawnGrid(const Grid& grid, const PeriodicWindow& window);

/// The shift reduced to [0, 1): what decides the picture.
[[nodiscard]] glm::dvec3 wrappedShift(const PeriodicWindow& window);

/// The stored grid where the wrapped shift puts it in the world: its index and texture frames,
/// wrapped on periodic axes, lead to the samples. Its own box is not the drawn one: see drawnGrid.
[[nodiscard]] Grid placedGrid(const Grid& grid, const PeriodicWindow& window);

} // namespace voxsheet
