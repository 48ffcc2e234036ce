// Makes cells ready to draw: style, field, range, colours, camera and identity.
#pragma once

#include "engine/cell_contents.h"
#include "engine/cell_resolver.h"
#include "engine/engine.h"
#include "engine/label_table.h"
#include "engine/look_cache.h"
#include "engine/named_volumes.h"
#include "gpu/workarounds.h"

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace voxsheet::engine {

/// The volume whose values colour isosurfaces, and how.
struct ColouringLook {
    std::shared_ptr<const DatasetMeta> meta;
    FieldAndStep shown;
    ResolvedTransfer transfer; ///< by the cell's own style, over this volume's range
};

/// Another volume that is blended into a cell's picture, and how: as the cell that shows it, or with the
/// default look.
struct LayerLook {
    std::string name; ///< as the style names it: "B1", "run 2"
    std::shared_ptr<const DatasetMeta> meta;
    FieldAndStep shown;
    ResolvedTransfer transfer;
    double unitLengthWorld = 1.0;
    double weight = 1.0;
    FloatTexels floatTexels = FloatTexels::Full;
    std::optional<LabelTable> labels; ///< shown as categories: its table stands for `transfer`
    std::optional<double> threshold;  ///< of an overlay
};

/// How one cell shows its dataset.
struct CellLook {
    sheet::ResolvedStyle resolved;
    FieldAndStep shown;
    ResolvedTransfer transfer;
    std::optional<LabelTable> labels; ///< shown as categories: its table stands for `transfer`
    IsosurfaceSpec isosurface;        ///< empty unless the technique is isosurface
    std::string note;                 ///< PreparedTile::note
    std::shared_ptr<const DatasetMeta> meta;
    bool sharedRange = false;
    std::optional<CameraFrame> frame; ///< not set: the cell's own
    std::optional<ClipObjectVolume> clipObject;
    std::optional<ColouringLook> colouredBy;
    std::vector<LayerLook> layers;        ///< fused, or, of technique plane, the overlay
    std::optional<MissingVolume> missing; ///< a volume that the style names; without it there is no picture
};

/// Ranges are shared only by values that mean the same.
struct SharedQuantity {
    std::string quantity; ///< FieldMeta::quantity
    std::string unit;

    auto operator<=>(const SharedQuantity&) const = default;
};

/// What is the same for all tiles of this program.
struct TileEnvironment {
    std::string text; ///< device, driver, build: part of every identity
    DeviceForms forms;
};

/// Thread-safe.
class TileMaker {
public:
    TileMaker(const sheet::KeyTable& keys, const ColourMapTable& maps,
              std::shared_ptr<const VolumeProvider> volumes, NamedVolumeSources named,
              TileEnvironment environment)
        : keys_(keys), maps_(maps), cache_(std::move(volumes)), named_(keys, std::move(named)),
          environment_(std::move(environment)) {}

    /// The cell must be Ready. Starts what it takes to have the volumes that its style names. Throws
    /// InvalidInput (with field) if keys do not agree, or the field or a named volume is not there, NotFound
    /// if the cell lies outside the sheet, and what the provider throws.
    [[nodiscard]] CellLook look(const sheet::Workbook& workbook, std::size_t sheetIndex,
                                const sheet::Address& cell, const View& view,
                                const std::shared_ptr<const CellContents>& contents);

    /// Errors of the cell's own are values in the result. Errors of `view.request` are thrown: the caller
    /// sent them.
    [[nodiscard]] PreparedTile prepare(const sheet::Workbook& workbook, std::size_t sheetIndex,
                                       const sheet::Address& cell, const View& view,
                                       const TileQuality& quality,
                                       const std::shared_ptr<const CellContents>& contents);
    /// Of the cell, which must be Ready; not set: its own (camera.frame fit).
    [[nodiscard]] std::optional<CameraFrame> frame(const sheet::Workbook& workbook, std::size_t sheetIndex,
                                                   const sheet::Address& cell, const View& view,
                                                   const std::shared_ptr<const CellContents>& contents);
    /// As Engine::atLevel.
    [[nodiscard]] PreparedTile atLevel(PreparedTile tile, int level) const;
    /// As Engine::atQuality.
    [[nodiscard]] PreparedTile atQuality(const PreparedTile& tile, const TileQuality& quality);

private:
    /// Of all cells of the sheet that show the same quantity in the same unit and whose own range.mode is
    /// shared, with `own` among them.
    [[nodiscard]] std::shared_ptr<const ValueSummary>
    sharedSummary(const sheet::Workbook& workbook, std::size_t sheetIndex, const sheet::Address& asking,
                  const CellLook& own, const std::shared_ptr<const CellContents>& contents);
    [[nodiscard]] std::vector<ValueSummary> sharingSummaries(const sheet::Workbook& workbook,
                                                             std::size_t sheetIndex,
                                                             const CellContents& contents,
                                                             const SharedQuantity& quantity);
    /// As frame(), of a cell whose style, with all its periods, is resolved already.
    [[nodiscard]] std::optional<CameraFrame> frameOf(const sheet::TypedStyle& style,
                                                     const sheet::Workbook& workbook, std::size_t sheetIndex,
                                                     const sheet::Address& cell, const View& view,
                                                     const std::shared_ptr<const CellContents>& contents);
    /// What the Ready cells of the sheet draw whose camera.frame is `mode`.
    [[nodiscard]] std::vector<Grid> framedGrids(const sheet::Workbook& workbook, std::size_t sheetIndex,
                                                sheet::FrameMode mode, const View& view,
                                                const CellContents& contents) const;
    /// Without the volumes that the style names.
    [[nodiscard]] CellLook ownLook(const sheet::Workbook& workbook, std::size_t sheetIndex,
                                   const sheet::Address& cell, const View& view,
                                   const std::shared_ptr<const CellContents>& contents);
    void findClipObject(CellLook& look, const NamingCell& from);
    void findColours(CellLook& look, const NamingCell& from);
    void findLayers(CellLook& look, const NamingCell& from,
                    const std::shared_ptr<const CellContents>& contents);
    void findOverlay(CellLook& look, const NamingCell& from,
                     const std::shared_ptr<const CellContents>& contents);
    /// Nothing: it is not there, and `look.missing` says why.
    /// \param key  that names it
    [[nodiscard]] std::optional<LayerLook> layerLook(CellLook& look, const sheet::VolumeName& name,
                                                     const std::string& key, const NamingCell& from,
                                                     const std::shared_ptr<const CellContents>& contents);
    void addLabels(CellLook& look) const;
    [[nodiscard]] std::string identityOf(const TileSpec& spec) const;
    /// That the picture reads besides the cell's own.
    [[nodiscard]] std::vector<FurtherVolume> furtherVolumes(const CellLook& look, bool onHost) const;
    /// What the picture's colours come from.
    [[nodiscard]] std::shared_ptr<const TransferTable> tableOf(const std::optional<LabelTable>& labels,
                                                               const ResolvedTransfer& transfer);
    void draw(PreparedTile& tile, const CellLook& look, const TileQuality& quality);

    const sheet::KeyTable& keys_;
    const ColourMapTable& maps_;
    LookCache cache_;
    NamedVolumes named_;
    /// Every tile of a frame asks for the same one.
    struct SharedRange {
        std::uint64_t version = 0;
        std::size_t sheetIndex = 0;
        std::shared_ptr<const CellContents> contents;
        std::map<SharedQuantity, std::shared_ptr<const ValueSummary>> summaries;
    };
    struct SharedFrames {
        std::uint64_t version = 0;
        std::size_t sheetIndex = 0;
        std::shared_ptr<const CellContents> contents;
        std::map<sheet::FrameMode, FrameBounds> bounds;
    };
    std::mutex mutex_;
    SharedRange shared_;
    SharedFrames frames_;
    TileEnvironment environment_;
};

} // namespace voxsheet::engine
