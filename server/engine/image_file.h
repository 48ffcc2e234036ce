// Finished pictures to files, by OpenImageIO.
#pragma once

#include "frame/frame_spec.h"

#include <filesystem>

namespace voxsheet::engine {

/// Which pixels a file of this name wants: floats for .exr and .tif, 8 bits for .png, .jpg, .jpeg and
/// .webp. Throws InvalidInput for any other ending.
[[nodiscard]] PixelFormat pixelFormatFor(const std::filesystem::path& file);

/// Writes the picture under a temporary name in the same folder and renames it: the file is either whole or
/// as before. PNG, WebP: 8 bits, sRGB, straight alpha; without an alpha channel when the picture is opaque.
/// JPEG: quality 95, over black. TIFF and EXR: the floats as composited, *display* sRGB values (not linear
/// light), alpha premultiplied as both formats define it; EXR says so in the attribute
/// "voxsheet:colorspace". Either pixel format is accepted for any file. Throws InvalidInput (ending, or a
/// buffer that does not fit its size), IoError (naming the file).
void writeImageFile(const TilePixels& picture, const std::filesystem::path& file);

} // namespace voxsheet::engine
