// From a cell's clip style to half-spaces and a clip object in the world of its volume.
#pragma once

#include "sheet/typed_style.h"
#include "volume/clip.h"
#include "volume/dataset.h"
#include "volume/grid.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace voxsheet::engine {

/// The half-spaces of clip.planes, in their order, then those of clip.box, with unit normals. One that keeps
/// the whole drawn box is left out: it cuts nothing. One that keeps nothing of it stays, close to the box, so
/// that its offset fits a float. A box in fractions has faces that are the planes of the volume's own axes,
/// also where those are oblique.
[[nodiscard]] std::vector<ClipPlane> resolveClipPlanes(const sheet::ClipStyle& clip, const Grid& grid);

/// A volume of signed distances, and how large what it holds is.
struct ClipObjectVolume {
    std::string dataset; ///< DatasetMeta::key
    /// Its drawn box is what clip.units fraction fits to the cell's: of a mesh, its own grid; of a threshold,
    /// the volume that was compared, so that it lands on itself. Not set: an analytic shape, which has a unit
    /// and an origin of its own (volume/clip_shapes.h).
    std::optional<Grid> extent;
    std::shared_ptr<const DatasetMeta> meta = nullptr; ///< of the distances
};

/// Places the object. World: as it is, then clip.transform about the world's origin. Fraction: an analytic
/// shape's unit becomes half the shortest edge of the cell's box and its origin the box's centre; a volume is
/// moved from the centre of `extent` to the box's centre and scaled by the ratio of their bounding radii;
/// then clip.transform follows about the box's centre, its translation in units of half the shortest edge.
/// Throws InvalidInput (field clip.transform) if a factor is so small or large that no picture can hold it.
[[nodiscard]] ClipObject resolveClipObject(const sheet::ClipStyle& clip, const ClipObjectVolume& volume,
                                           const Grid& cell);

} // namespace voxsheet::engine
