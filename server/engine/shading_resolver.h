// From a cell's shading and light style to what the renderer lights with.
#pragma once

#include "sheet/typed_style.h"
#include "stages/tile_spec.h"

namespace voxsheet::engine {

/// shading.model auto: Phong for isosurfaces, none for the others; maximum intensity projection never.
/// shading.gradient auto: from a texture for volume rendering, where every sample is shaded; on the fly for
/// isosurfaces, where a few are. Directions are normalised, and with light.frame world turned into the
/// camera's view frame.
[[nodiscard]] ShadingSpec resolveShading(const sheet::TypedStyle& style, const CameraSpec& camera);

} // namespace voxsheet::engine
