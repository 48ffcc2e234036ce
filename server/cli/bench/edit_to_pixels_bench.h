// `voxsheet bench edit-to-pixels`: from an edit of each kind to the first pictures that show it, over
// loopback, with the program's own server.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace voxsheet::cli {

struct EditToPixelsOptions {
    int cells = 9;
    int dim = 128;
    int width = 768; ///< of the whole sheet, device pixels
    int height = 768;
    int edits = 40; ///< of each kind, beside a first one that does not count
    int device = -1;
};

/// {"bench": "edit-to-pixels", "dim", "size", "cells", "edits", "cases": [{edit, first_ms_p50, first_ms_p95,
/// scale, final_ms_p50, final_ms_p95}]}. From sending the edit, as a page does, to the last decoded pixel of
/// the first picture of each cell that it changes, and of the final ones; scale: median of the edges of the
/// first pictures, over those of the final ones (the coarsest of the sheet). All cells change but for a
/// formula, whose cell is the sheet's last. Throws IoError if pictures do not come.
[[nodiscard]] nlohmann::json runEditToPixelsBench(const EditToPixelsOptions& options);

} // namespace voxsheet::cli
