// `voxsheet bench edit`: what an edit costs that makes one cell of a sheet dirty, against one that makes all
// of them dirty.
#pragma once

#include <nlohmann/json.hpp>

namespace voxsheet::cli {

struct EditBenchOptions {
    int cells = 25;
    int dim = 128;   ///< samples per edge of each volume; all volumes differ
    int width = 256; ///< of each tile, pixels
    int height = 256;
    int repeats = 21; ///< of either edit, by turns; medians count
    int device = -1;
};

/// {"bench": "edit", "dim", "tile", "level", "repeats", "cases": [{cells, dirty_ms, dirty_ms_p95, all_ms,
/// all_ms_p95, ratio}]}. Both edits set the opacity curve, of the whole sheet or of one cell (each in its
/// turn). Times are from the edit until the final pictures of all dirty cells, as the planner of a page's
/// stream asks for them, are in host memory; full level of detail, not encoded. ratio: all_ms / dirty_ms.
/// Throws InternalError if an edit makes more or fewer cells dirty than it should, IoError if the volumes do
/// not come.
[[nodiscard]] nlohmann::json runEditBench(const EditBenchOptions& options);

} // namespace voxsheet::cli
