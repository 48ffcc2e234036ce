#include "volume/periodic_window.h"

#include "base/errors.h"

#include <cmath>
#include <string>

#include <glm/gtc/matrix_transform.hpp>

namespace voxsheet {
namespace {

constexpr const char* kShift = "periodic.shift";
constexpr const char* kReplicate = "periodic.replicate";

[[noreturn]] void refuseAxis(const char* key, int axis, const Grid& grid) {
    const bool some = grid.periodic.x || grid.periodic.y || grid.periodic.z;
    const std::string why = some ? std::string("axis ") + "xyz"[axis] + " of the volume is not periodic"
                                 : "the volume is not periodic";
    const char* fix = std::string(key) == kShift ? "set its shift to 0" : "set its number of periods to 1";
    throw InvalidInput(key, why, std::string(fix) + ", or import the data as periodic").withField(key);
}

} // namespace

void validatePeriodicWindow(const PeriodicWindow& window, const Grid& grid) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(window.shift[axis]))
            throw InvalidInput(kShift, "it is not a finite number", "give fractions of the cell")
                .withField(kShift);
        if (window.replicate[axis] < 1 || window.replicate[axis] > kMaxReplicate)
            throw InvalidInput(kReplicate, std::to_string(window.replicate[axis]) + " periods are not drawn",
                               "give whole numbers from 1 to " + std::to_string(kMaxReplicate))
                .withField(kReplicate);
        if (grid.periodic[axis]) continue;
        if (window.shift[axis] != 0.0) refuseAxis(kShift, axis, grid);
        if (window.replicate[axis] != 1) refuseAxis(kReplicate, axis, grid);
    }
}

Grid drawnGrid(const Grid& grid, const PeriodicWindow& window) {
    Grid drawn = grid;
    for (int axis = 0; axis < 3; ++axis)
        if (grid.periodic[axis]) drawn.dims[axis] *= window.replicate[axis];
    return drawn;
}

glm::dvec3 wrappedShift(const PeriodicWindow& window) { return window.shift - glm::floor(window.shift); }

Grid placedGrid(const Grid& grid, const PeriodicWindow& window) {
    Grid placed = grid;
    placed.worldFromIndex = glm::translate(grid.worldFromIndex, wrappedShift(window) * glm::dvec3(grid.dims));
    return placed;
}

} // namespace voxsheet
