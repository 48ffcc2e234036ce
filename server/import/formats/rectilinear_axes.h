// Rectilinear grids (coordinates of their own along each axis) onto uniform ones, which is what volumes are
// here.
#pragma once

#include "volume/grid.h"
#include "volume/scalar_type.h"

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace voxsheet::import {

/// Coordinates of the points along x, y, z, each at least one.
using AxisCoordinates = std::array<std::vector<double>, 3>;

class UniformResampling {
public:
    /// The uniform grid spans the same box. Where coordinates are equally spaced, its samples are the file's;
    /// else an axis has samples as close as its closest points, at most 4 times as many as it had, fewer
    /// where all together would be more than 2^27. Throws InvalidInput (subject `name`) if coordinates are
    /// not finite or neither rise nor fall throughout. \param ofCells  values stand for the cells between the
    /// points
    UniformResampling(const std::string& name, const AxisCoordinates& points, bool ofCells);

    /// Point- or cell-centred, in the coordinates of the file.
    [[nodiscard]] const Grid& grid() const { return grid_; }
    /// Samples in the file.
    [[nodiscard]] const glm::ivec3& sourceDims() const { return sourceDims_; }
    /// No axis changes: values stay as they are.
    [[nodiscard]] bool isIdentity() const { return identity_; }
    /// For people; empty when nothing changes.
    [[nodiscard]] std::string note() const;

    /// Of the result: interpolated integers become floats (F64 from 32 bits on).
    [[nodiscard]] ScalarType resultType(ScalarType source) const;
    /// Values of points: linear between the file's. Values of cells: those of the cell that holds the sample.
    [[nodiscard]] std::vector<std::byte> apply(std::span<const std::byte> values, ScalarType type) const;

private:
    /// value = (1 - weight) * source[index] + weight * source[index + 1]
    struct Tap {
        std::size_t index = 0;
        double weight = 0.0;
    };

    void placeAxis(int axis, const std::vector<double>& points, int samples);
    template <typename In, typename Out>
    void interpolate(std::span<const In> in, std::span<Out> out) const;

    bool ofCells_ = false;
    bool identity_ = true;
    Grid grid_;
    glm::ivec3 sourceDims_{1};
    std::array<std::vector<Tap>, 3> taps_;
};

} // namespace voxsheet::import
