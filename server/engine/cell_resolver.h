// From a cell's style and dataset to what the renderer draws. Pure: everything that was read comes in as
// arguments.
#pragma once

#include "engine/camera_frame.h"
#include "engine/colour_map.h"
#include "engine/default_look.h"
#include "sheet/style.h"
#include "stages/tile_spec.h"
#include "volume/dataset.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace voxsheet::engine {

/// How the values of a cell become colours, before tables.
struct ResolvedTransfer {
    TransferFunction function;
    const ColourMap* map = nullptr; ///< null: own points or a cut shape
    bool diverging = false;         ///< transparent at zero by default
};

/// Which array of the dataset the cell shows.
struct FieldAndStep {
    int field = 0;
    int step = 0;
};

/// The step is held at the last one of the dataset: linked cells of different lengths play on together.
/// Throws InvalidInput (field "field") that lists the dataset's fields if there is no such one.
[[nodiscard]] FieldAndStep chooseField(const sheet::FieldChoice& choice, int timeStep,
                                       const DatasetMeta& meta);

/// \param summary  of the cell's own values; with range.mode shared: of all cells that share
/// \param boxPathUnitLengths  mean edge of the drawn box in mean voxel edges
/// Throws InvalidInput (with field) if range.min and range.max, as resolved, leave nothing between them or
/// the map is unknown.
[[nodiscard]] ResolvedTransfer resolveTransfer(const sheet::ResolvedStyle& resolved,
                                               const ColourMapTable& maps, const ValueSummary& summary,
                                               double boxPathUnitLengths);

/// Mean edge of the drawn box in mean voxel edges.
[[nodiscard]] double boxPathUnitLengths(const Grid& grid);

/// The merged distribution of several cells, each with equal weight.
[[nodiscard]] ValueSummary mergeSummaries(const std::vector<ValueSummary>& summaries);

/// What the style asks for, whether it fits a volume or not.
[[nodiscard]] PeriodicWindow periodicWindow(const sheet::PeriodicStyle& style);

/// Throws InvalidInput (field periodic.shift or periodic.replicate) if the style asks for it on an axis that
/// is not periodic. The shift comes wrapped to [0, 1).
[[nodiscard]] PeriodicWindow resolvePeriodicWindow(const sheet::PeriodicStyle& style, const Grid& grid);

/// Takes back, on axes that are not periodic, what columns, rows, the sheet or a page's view ask for all
/// linked cells. Returns a sentence that says so, empty when nothing was taken back. What the cell alone is
/// asked for stays, and is an error then.
[[nodiscard]] std::string dropLinkedPeriods(sheet::ResolvedStyle& resolved, const Grid& grid);

/// `grid`: whose box is drawn (drawnGrid). camera.fov is the vertical angle of pictures wider than high, the
/// horizontal one of others: what fits, fits in both.
[[nodiscard]] CameraSpec resolveCamera(const sheet::CameraStyle& camera, const CameraFrame& frame,
                                       glm::ivec2 sizePixels);

/// All but what other volumes decide: the clip object, and the isosurfaces (clip_resolver.h,
/// isosurface_resolver.h).
/// \param level  smallest level of detail asked for; the style's quality may ask for a coarser one, and its
/// level is what it says
/// \param linked  of camera.frame centre and world; not set: the cell's own
[[nodiscard]] TileSpec resolveTile(const sheet::TypedStyle& style, const DatasetMeta& meta,
                                   const FieldAndStep& shown, std::shared_ptr<const TransferTable> table,
                                   glm::ivec2 sizePixels, int level, double sampleDistanceFactor,
                                   const std::optional<CameraFrame>& linked = {});

} // namespace voxsheet::engine
