// Patches of cells of different sizes (adaptive mesh refinement) onto one uniform grid of cells.
#pragma once

#include "volume/grid.h"
#include "volume/scalar_type.h"

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace voxsheet::import {

/// A box of equal cells whose edges are parallel to the world's axes.
struct CellPatch {
    int level = 0; ///< of refinement: where patches overlap, the highest counts
    glm::dvec3 low{0.0};
    glm::dvec3 cellSize{1.0}; ///< > 0
    glm::ivec3 dims{1};       ///< cells
    glm::bvec3 flat{false};   ///< has no extent along the axis: one cell, whatever its size
};

class PatchResampling {
public:
    /// The uniform grid spans all patches, with cells as those of the finest level that gives at most 2^27,
    /// and at most 64 times as many as the patches have together (or 2^20), since a small file must not
    /// become a huge volume. Patches are in the order of their levels. Throws InvalidInput (subject `name`)
    /// if patches of one level have cells of different sizes, LimitExceeded if not even the coarsest level
    /// gives so few.
    PatchResampling(const std::string& name, std::vector<CellPatch> patches);

    /// Of cells, in the coordinates of the patches.
    [[nodiscard]] const Grid& grid() const { return grid_; }
    /// For people.
    [[nodiscard]] std::string note() const;
    /// Integers stay integers unless cells are averaged, or some place has no patch (F64 from 32 bits on).
    [[nodiscard]] ScalarType resultType(ScalarType source) const;

    /// Values of the grid's cells before anything is painted: no value, or 0 of an integer type.
    [[nodiscard]] std::vector<std::byte> blank(ScalarType source) const;
    /// Puts a patch's values (as many as it has cells) over what lies there: to be called in the order of the
    /// patches. A cell of the grid takes the value of the patch's cell that holds its centre; where the
    /// patch's cells are smaller, their mean.
    void paint(std::size_t patch, std::span<const std::byte> values, ScalarType type,
               std::vector<std::byte>& cells) const;

private:
    struct Pair {
        int from = 0; ///< of the patch
        int to = 0;   ///< of the grid
    };
    [[nodiscard]] std::array<std::vector<Pair>, 3> pairsOf(const CellPatch& patch) const;
    template <typename In, typename Out>
    void paintAs(const CellPatch& patch, std::span<const In> in, std::span<Out> out) const;

    void placeGrid(const std::string& name);
    [[nodiscard]] bool isFiner(const CellPatch& patch, int axis) const;
    [[nodiscard]] bool coversAll() const;

    std::vector<CellPatch> patches_;
    glm::dvec3 low_{0.0};
    glm::dvec3 high_{0.0};
    glm::dvec3 cellSize_{1.0};
    glm::bvec3 flat_{true}; ///< all patches are
    int level_ = 0;         ///< whose cells the grid has
    bool averages_ = false;
    bool gaps_ = false;
    Grid grid_;
};

} // namespace voxsheet::import
