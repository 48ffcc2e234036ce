#include "volume/grid.h"

#include "base/errors.h"

#include <cmath>
#include <string>

#include <glm/gtc/matrix_transform.hpp>

namespace voxsheet {

void validateGrid(const Grid& grid) {
    const auto text = std::to_string(grid.dims.x) + " x " + std::to_string(grid.dims.y) + " x " +
                      std::to_string(grid.dims.z);
    if (grid.dims.x < 1 || grid.dims.y < 1 || grid.dims.z < 1)
        throw InvalidInput("grid of " + text + " samples", "every axis needs at least one sample");
    const double samples = double(grid.dims.x) * double(grid.dims.y) * double(grid.dims.z);
    if (samples > 0x1p40) throw LimitExceeded("grid of " + text + " samples", "more than 2^40 samples");
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(grid.worldFromIndex[column][row]))
                throw InvalidInput("grid geometry", "spacing, origin or direction is not a finite number");
    const glm::dmat3 axes(grid.worldFromIndex);
    const double scale = glm::length(axes[0]) * glm::length(axes[1]) * glm::length(axes[2]);
    if (!(std::abs(glm::determinant(axes)) > 1e-9 * scale) || scale == 0.0)
        throw InvalidInput("grid geometry",
                           "the three axes do not span space (zero spacing or parallel directions)");
}

IndexBox boxIndex(const Grid& grid) {
    IndexBox box{};
    for (int axis = 0; axis < 3; ++axis) {
        const double n = grid.dims[axis];
        if (grid.periodic[axis]) {
            box.low[axis] = 0.0;
            box.high[axis] = n;
        } else if (grid.centring == Centring::Cell || grid.dims[axis] == 1) {
            box.low[axis] = -0.5;
            box.high[axis] = n - 0.5;
        } else {
            box.low[axis] = 0.0;
            box.high[axis] = n - 1.0;
        }
    }
    return box;
}

glm::dmat4 textureFromIndex(const Grid& grid) {
    const glm::dvec3 scale = 1.0 / glm::dvec3(grid.dims);
    return glm::translate(glm::dmat4(1.0), 0.5 * scale) * glm::scale(glm::dmat4(1.0), scale);
}

glm::dmat4 worldFromTexture(const Grid& grid) {
    return grid.worldFromIndex * glm::inverse(textureFromIndex(grid));
}

glm::dvec3 centreWorld(const Grid& grid) {
    const auto box = boxIndex(grid);
    return glm::dvec3(grid.worldFromIndex * glm::dvec4(0.5 * (box.low + box.high), 1.0));
}

double boundingRadiusWorld(const Grid& grid) {
    const auto box = boxIndex(grid);
    const auto centre = centreWorld(grid);
    double radius = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 index((corner & 1) ? box.high.x : box.low.x, (corner & 2) ? box.high.y : box.low.y,
                               (corner & 4) ? box.high.z : box.low.z);
        const auto world = glm::dvec3(grid.worldFromIndex * glm::dvec4(index, 1.0));
        radius = std::max(radius, glm::distance(world, centre));
    }
    return radius;
}

glm::dvec3 spacingWorld(const Grid& grid) {
    const glm::dmat3 axes(grid.worldFromIndex);
    return {glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2])};
}

double meanVoxelEdgeWorld(const Grid& grid) {
    const auto edges = spacingWorld(grid);
    return (edges.x + edges.y + edges.z) / 3.0;
}

glm::ivec3 levelDims(const glm::ivec3& dims, int level) {
    glm::ivec3 result = dims;
    for (int step = 0; step < level; ++step)
        result = (result + 1) / 2;
    return result;
}

int levelCount(const glm::ivec3& dims) {
    int count = 1;
    for (auto size = dims; size.x > 16 || size.y > 16 || size.z > 16; size = (size + 1) / 2)
        ++count;
    return count;
}

} // namespace voxsheet
