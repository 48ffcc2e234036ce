// At which level of detail each cell of a sheet is drawn. Pure arithmetic: no clock, no GL.
//
// The default, `focus`, goes beyond the paper's rule (one level for all cells): a cell is drawn no finer than
// its picture can show, and the whole sheet shares one frame time and one memory budget, which the cell that
// is looked at gets the most of.
#pragma once

#include "resolution/dynamic_resolution.h"
#include "resolution/level_settings.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace voxsheet {

/// Off and Focus: the criterion is Off.
[[nodiscard]] ResolutionRule ruleOf(const LevelSettings& settings);

/// A volume that a cell's picture reads besides the drawn one, at the level of that or, if it has not so
/// many, its coarsest.
struct FurtherVolume {
    std::string volume;                      ///< as CellDemand::volume
    std::vector<std::uint64_t> textureBytes; ///< per level of its own; at least one

    bool operator==(const FurtherVolume&) const = default;
};

/// What one cell asks for, and what it costs.
struct CellDemand {
    std::string volume; ///< cells that show the same volume share its textures
    /// Longest edge of a level-0 texel on the screen, in pixels, where the volume is nearest to the eye; > 0,
    /// may be infinite.
    double texelEdgePixels = 1.0;
    double pixels = 1.0;                     ///< of its picture
    std::vector<std::uint64_t> textureBytes; ///< per level; at least one
    std::vector<FurtherVolume> further;      ///< fused layers, what colours isosurfaces, clip objects
    std::vector<double> ms;                  ///< per level: expected time of its picture; 0 = not known
    int finest = 0;                          ///< no finer level is asked for
    std::optional<int> pinned;               ///< the level that the user chose; clamped to those there are
    bool focused = false;                    ///< looked at: under the pointer, selected or enlarged

    [[nodiscard]] int levels() const { return static_cast<int>(textureBytes.size()); }
};

struct SheetBudget {
    double frameMs = 1000.0;        ///< of all pictures together, > 0
    std::uint64_t textureBytes = 0; ///< of all textures together
};

/// The coarsest level whose texels are no larger than a pixel: finer texels are wasted on the picture. 0 when
/// a texel of level 0 is already larger.
[[nodiscard]] int footprintLevel(double texelEdgePixels, int levels);

/// Levels under `focus`, one per cell. Each cell starts at its footprint level (or `finest`, if that is
/// coarser); while the sheet is above a budget, the volume whose picture gains least from its level per
/// share of the budgets that the level takes is lowered by one. What a picture gains is its pixels times the
/// octaves by which its texels (as far as they are larger than pixels) would grow; those of a focused cell
/// count 16-fold. So all cells lose their finest level before one of them loses a second one. Pinned cells
/// keep their level and count in the budgets. When nothing can be lowered any more the sheet stays above the
/// budget.
[[nodiscard]] std::vector<int> focusLevels(std::span<const CellDemand> cells, const SheetBudget& budget);

/// The same with hysteresis: a cell keeps its previous level as long as that lies between the levels for the
/// budget and those for `upFraction` of it. `previous`: one per cell, absent for a cell that is new.
[[nodiscard]] std::vector<int> steadyFocusLevels(std::span<const CellDemand> cells,
                                                 std::span<const std::optional<int>> previous,
                                                 const SheetBudget& budget, double upFraction);

/// One level for all cells but those that are pinned, clamped to the levels of each.
[[nodiscard]] std::vector<int> commonLevels(std::span<const CellDemand> cells, int level);

struct SheetCost {
    double ms = 0.0;
    std::uint64_t textureBytes = 0; ///< one copy per volume and level
};
[[nodiscard]] SheetCost sheetCost(std::span<const CellDemand> cells, std::span<const int> levels);

} // namespace voxsheet
