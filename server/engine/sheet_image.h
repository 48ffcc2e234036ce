// The picture of a whole sheet: pictures in rows and columns with names, headers and colour bars.
#pragma once

#include "engine/engine.h"
#include "engine/sheet_layout.h"
#include "engine/tile_maker.h"
#include "engine/typesetter.h"

#include <functional>

namespace voxsheet::engine {

/// What composing needs from the engine.
struct SheetImageSources {
    const sheet::KeyTable& keys;
    TileMaker& tiles;
    Typesetter& typesetter;
    /// Draws these tiles; throws what the render thread throws.
    std::function<FrameResult(const std::vector<TileSpec>&, PixelFormat)> render;
};

/// Throws InvalidInput (size, range, values of the view), NotFound (sheet), Unsupported (no font),
/// GpuError.
[[nodiscard]] SheetImage composeSheet(const SheetImageRequest& request, const sheet::Workbook& workbook,
                                      const std::shared_ptr<const CellContents>& contents,
                                      const SheetImageSources& sources);

} // namespace voxsheet::engine
