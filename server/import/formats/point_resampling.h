// Patches of points at different spacings onto one uniform grid of points.
#pragma once

#include "import/formats/patch_resampling.h"

namespace voxsheet::import {

class PointResampling : public Resampling {
public:
    /// Of each patch, `low` is its first point, `cellSize` its spacing and `dims` its points; `flat`: a
    /// single layer. The grid spans all patches and has the spacing of the finest level that gives no more
    /// points than PatchResampling gives cells. Throws as PatchResampling.
    PointResampling(const std::string& name, std::vector<CellPatch> patches);

    [[nodiscard]] const Grid& grid() const override { return grid_; }
    [[nodiscard]] std::string note() const override;
    /// Floats stay; integers become F32, from 32 bits on F64, since values lie between those of the patches.
    [[nodiscard]] ScalarType resultType(ScalarType source) const override;
    /// A point of the grid within the patch takes the trilinear value of the patch there; a corner of weight
    /// 0 does not matter.
    void paint(std::size_t patch, std::span<const std::byte> values, ScalarType type,
               std::vector<std::byte>& points) const override;

private:
    std::vector<CellPatch> patches_;
    int level_ = 0; ///< whose spacing the grid has
    Grid grid_;
};

} // namespace voxsheet::import
