// What choosing a cell's level of detail needs to know about its picture.
#pragma once

#include "gpu/workarounds.h"
#include "residency/wanted_volume.h"
#include "resolution/level_policy.h"
#include "sheet/typed_style.h"
#include "stages/tile_spec.h"
#include "techniques/render_paths.h"
#include "volume/dataset.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace voxsheet::engine {

/// What decides the form in which a device holds volumes.
struct DeviceForms {
    gpu::Workarounds workarounds;
    RenderPaths paths;
};

struct LevelNeeds {
    std::string volume; ///< dataset, field and step, and how they are kept: cells with equal ones share
                        ///< textures
    std::string work;   ///< technique and what else changes the time of a picture per pixel
    double texelEdgePixels = 1.0;            ///< CellDemand::texelEdgePixels
    std::vector<std::uint64_t> textureBytes; ///< per level; its size is the number of levels
    /// Fused layers, what colours isosurfaces, and the distances of a clip object. A volume whose own cell is
    /// lit with a gradient texture counts once there and once here: an estimate from above.
    std::vector<FurtherVolume> further;
    int finest = 0;            ///< what the style's `quality` allows
    std::optional<int> pinned; ///< the style's `level`
};

/// The longest edge of a level-0 voxel in pixels, at the depth of the corner of the drawn box that is nearest
/// to the eye, whichever way the edge points. Infinite when that corner is beside or behind the eye.
[[nodiscard]] double texelEdgePixels(const Grid& grid, const CameraSpec& camera, glm::ivec2 sizePixels);

/// All but `further`.
/// \param device  its workarounds and paths decide the form in which volumes are held
[[nodiscard]] LevelNeeds levelNeeds(const TileSpec& tile, const DatasetMeta& meta,
                                    const sheet::TypedStyle& style, const DeviceForms& device);

/// One volume as textures hold it, for LevelNeeds::further.
[[nodiscard]] FurtherVolume furtherVolume(const DatasetMeta& meta, int field, int step, TexelForm form,
                                          const gpu::Workarounds& workarounds);

/// A clip object's distances, likewise: at level 0 whatever the level of the picture.
[[nodiscard]] FurtherVolume clipObjectVolume(const DatasetMeta& meta, bool onHost,
                                             const gpu::Workarounds& workarounds);

} // namespace voxsheet::engine
