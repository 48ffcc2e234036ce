// A cell's colour bar in a finished picture.
#pragma once

#include "engine/canvas.h"
#include "engine/tile_maker.h"

namespace voxsheet::engine {

/// Not premultiplied.
struct BarColours {
    glm::vec4 text{1.0F};
    glm::vec4 quiet{1.0F}; ///< ticks and edges
    glm::vec4 background{
        0.0F}; ///< behind the volume: figures get an outline of it, to be legible on any picture
};

/// On the right edge of a picture: the colours from low to high, round numbers, isovalues, the colours of
/// values outside the range and of samples without one, and quantity, unit, scale and what is fused. Where
/// another volume colours the surfaces, it is that one's bar. Nothing where there is no room.
void paintColourBar(Canvas& canvas, const CellLook& look, const PixelRect& area, int fontPixels,
                    const BarColours& colours);

} // namespace voxsheet::engine
