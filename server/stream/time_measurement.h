// T_N measured on request: all cells on show, and the first 1, 2, … of them, drawn some times over.
#pragma once

#include "stream/stream_hub.h"

#include <functional>
#include <string>

namespace voxsheet::stream {

struct MeasureRequest {
    int repeats = 5;       ///< frames per N, [3, 25]
    bool curve = true;     ///< also for some smaller N, so that there is a curve
    double seconds = 30.0; ///< after which no further N is begun, (0, 300]
};

struct MeasureResult {
    int n = 0;                 ///< of the whole sheet
    int frames = 0;            ///< that were drawn
    bool stoppedEarly = false; ///< the time was over before all N were measured
    /// Nothing, or why the times say little: they varied by more than a tenth although all was the same.
    std::string warning;
};

/// Draws the cells of `view` that show a volume, at the levels they have now, each tile after the other with
/// the priority of exports: pages are not kept waiting. The camera rolls by a degree between frames, so that
/// no frame finds what was worked out for an equal one. The times go to `levels`; a machine that is busy
/// widens their intervals. Throws Cancelled when `cancelled` says so, Conflict if no cell shows a volume yet,
/// InvalidInput (field) for numbers out of range.
MeasureResult measureTimeN(engine::Engine& engine, SheetLevels& levels, const std::string& sheet,
                           const ClientView& view, const MeasureRequest& request,
                           const std::function<bool()>& cancelled);

} // namespace voxsheet::stream
