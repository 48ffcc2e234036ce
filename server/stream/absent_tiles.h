// Tiles of a frame of whose volumes nothing was there yet.
#pragma once

#include "frame/frame_spec.h"
#include "stream/frame_planner.h"

#include <cstddef>
#include <vector>

namespace voxsheet::stream {

/// Takes the absent tiles out of the plan and of what was drawn, so that nothing is sent of them and they
/// stay to be drawn.
/// \param drawnBy  per tile of the frame, ascending: its index in the plan's tiles
void leaveOutAbsent(FramePlan& plan, std::vector<std::size_t>& drawnBy, FrameResult& frame);

} // namespace voxsheet::stream
