// Identity of pixels: cache key, ETag, and "is this tile dirty".
#pragma once

#include "stages/tile_spec.h"
#include "techniques/render_paths.h"

#include <string>
#include <string_view>

namespace voxsheet::engine {

/// 32 hex digits: XXH3 (128 bit) over every number of the spec that its technique uses, tables by content,
/// the path that it is drawn by, and `environment` (device, driver, build). Same identity, same pixels.
[[nodiscard]] std::string tileIdentity(const TileSpec& tile, RenderPath path, std::string_view environment);

/// The same hash over any text.
[[nodiscard]] std::string textIdentity(std::string_view text);

/// 32 hex digits over the bytes of the running program: a new build never meets the pictures of an old one.
/// Throws IoError if the program cannot read itself.
[[nodiscard]] const std::string& buildIdentity();

} // namespace voxsheet::engine
