// The facade over datasets, workbook and render thread: the only thing that stream, http and cli see.
#pragma once

#include "base/errors.h"
#include "engine/camera_frame.h"
#include "engine/cell_state.h"
#include "engine/dataset_state.h"
#include "engine/default_look.h"
#include "engine/level_needs.h"
#include "frame/render_thread.h"
#include "residency/host_cache_state.h"
#include "sheet/address.h"
#include "sheet/history.h"
#include "sheet/style.h"
#include "sheet/style_keys.h"
#include "sheet/style_presets.h"
#include "sheet/workbook.h"
#include "volume/dataset.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace voxsheet::engine {

struct EngineOptions {
    std::filesystem::path storeDir;
    std::uint64_t storeLimitBytes = 0; ///< 0 = 20 GiB
    std::filesystem::path uploadDir;
    std::vector<std::filesystem::path> roots; ///< folders that datasets may be opened from
    std::uint64_t textureBudgetBytes = 0;     ///< 0 = default of the device
    /// Samples kept in host memory, so that what leaves the textures need not be read from disk again; 0 = a
    /// quarter of RAM. Also what one import or formula may use.
    std::uint64_t memoryBudgetBytes = 0;
    int device = -1;
    std::filesystem::path importer; ///< voxsheet-import; empty = beside this program
    std::filesystem::path
        workbookFile;                  ///< where saveWorkbook() writes when given no other path; may be empty
    std::filesystem::path recoveryDir; ///< where recovery files go; empty = uploadDir
    std::filesystem::path calibrationDir; ///< what `bench calibrate` remembers; empty: nothing is looked up
    ForcedPaths paths;                    ///< win over the rule and what was calibrated
    bool render = true;                   ///< false: no GL (info, tests): images throw Unsupported
};

struct DatasetInfo {
    std::string name; ///< unique in the workbook
    std::vector<std::filesystem::path> files;
    DatasetState state = DatasetState::Queued;
    double progress = 0.0;                   ///< [0, 1]
    std::optional<Failure> failure;          ///< when Failed
    std::shared_ptr<const DatasetMeta> meta; ///< when Ready
    std::uint64_t job = 0;
};

struct ImportRequest {
    std::vector<std::filesystem::path> files; ///< one dataset from these (a single file or a series)
    std::string name;                         ///< empty: the shortest distinguishing tail of the path
    nlohmann::json options = nlohmann::json::object();
    bool place = true;                  ///< put it into a cell: `cell`, or the next free one
    std::optional<sheet::Address> cell; ///< must be free
};

/// Where a batch of imports goes.
struct ImportLayout {
    std::string sheet;                     ///< empty = the first
    std::optional<int> columns;            ///< of a sheet that is still empty
    std::vector<std::string> columnTitles; ///< from column A; empty strings leave what is there
    std::vector<std::string> rowTitles;    ///< from row 1
};

/// What an edit did.
struct EditReport {
    std::uint64_t version = 0;           ///< of the workbook afterwards
    std::vector<sheet::HiddenBy> hidden; ///< SetStyle only: cells whose nearer values hide the edit
};

/// What stands in a cell, whether it is on screen or not.
struct CellStatus {
    sheet::Address cell;
    CellState state = CellState::Empty;
    std::string code;                        ///< Error: "#IMPORT!", "#GRID!", …
    std::string message;                     ///< Error: the sentence; Pending: what is being done
    double progress = 1.0;                   ///< Pending: [0, 1)
    std::shared_ptr<const DatasetMeta> meta; ///< Ready: of the dataset or the formula's result
    std::vector<std::string> notes;          ///< what a user should know, one sentence each
    std::optional<CameraFrame> frame;        ///< Ready: what the camera's lengths refer to
};

/// Style values that are not in the workbook. `all` stands above the sheet's own values and below those of
/// columns, rows and cells (linked cells follow, overrides stay); `cells` stands above everything in the
/// workbook; `request` above all.
struct View {
    sheet::StyleMap all;                             ///< what one page looks at, for all linked cells
    std::map<sheet::Address, sheet::StyleMap> cells; ///< what it looks at in one cell
    sheet::StyleMap request;                         ///< the query of one image request, or `--set`

    bool operator==(const View&) const = default;
};

/// How a tile is to be drawn, apart from what it shows.
struct TileQuality {
    glm::ivec2 sizePixels{256};        ///< of the picture that is rendered
    int level = 0;                     ///< smallest level of detail; 0 = full
    double sampleDistanceFactor = 1.0; ///< > 1 while moving: multiplies sampling.distance
    /// For a page, where the style key `level` counts wherever it is set. Otherwise only the view's `request`
    /// may set it: exports are at full level unless they ask for another one themselves.
    bool live = false;
    /// Pictures of volumes have the crosshair of linked planes in them, at its depth, where `annotations` is
    /// "all". Otherwise they are bare. On planes, pages and sheets draw it over the picture.
    bool crosshair = false;
};

struct CellLook;

/// One cell made ready to draw: everything that decides its pixels, and the identity of those pixels.
struct PreparedTile {
    sheet::Address cell;
    std::optional<TileSpec> spec; ///< absent: `code` and `message` say why (or the cell is empty)
    std::string identity;  ///< 32 hex digits over spec, device, driver, build; equal identity, equal pixels
    std::string code;      ///< "", "#IMPORT!", "#GRID!", …
    std::string message;   ///< sentence for `code`
    std::string note;      ///< with `spec`: what a user should know about the picture; empty: nothing
    double progress = 1.0; ///< < 1 while the source is being imported or computed
    LevelNeeds needs;      ///< with `spec` only
    int colourVolumeLevels = 1;           ///< of the volume that colours isosurfaces, if there is one
    std::vector<int> layerLevels;         ///< of the volumes blended with the cell's own
    std::shared_ptr<const CellLook> look; ///< with `spec`: what Engine::atQuality draws again
};

/// Which of a cell's values: all of the shown time step, of all steps, or those within the picture (as
/// visibleRange()).
enum class RangeOver { Data, Time, Visible };

/// The value of a volume that is blended into a cell's picture.
struct LayerValue {
    std::string name;            ///< as the style names it: "B1", "run 2"
    std::optional<double> value; ///< as ProbeValue
    std::optional<double> interpolated;
    std::string label; ///< of a label map: what the value is called
    std::string unit;
    std::string note;
};

struct ProbeValue {
    sheet::Address cell;
    std::optional<double>
        value; ///< of the nearest sample; absent: outside the box, NaN, or no volume (see `note`)
    std::optional<double> interpolated; ///< trilinear at the point itself, as drawn
    glm::dvec3 world{0.0};
    glm::ivec3 index{0}; ///< nearest sample
    std::string label;   ///< of a label map: what the value is called
    std::string unit;
    std::string note;
    /// Of the cell whose picture was probed: what lies under the pixel. "isosurface", "face" (of the box, a
    /// cut, or a clip object), "atom", "sample", "middle" (nothing is opaque enough: the point nearest to the
    /// middle of the box). Empty for other cells and for points of the world.
    std::string hit;
    std::optional<double> isovalue; ///< of the surface, when an isosurface was hit
    std::string
        atom; ///< symbol of the element, when `hit` is "atom"; world: its centre, or in a plane the point
    std::vector<LayerValue>
        layers; ///< of the fused view, in the order of the style's `layers`, or the overlay
};

struct SheetImageRequest {
    std::string sheet;                        ///< empty = the first
    std::optional<sheet::AddressRange> range; ///< absent = all used cells
    glm::ivec2 sizePixels{0};                 ///< of the whole image; 0 = 320x240 per cell
    View view;
    std::string title; ///< drawn above the sheet when not empty
    PixelFormat format = PixelFormat::Rgba8;
    bool annotate = true; ///< names, headers, colour bars as the `annotations` key says
};

struct SheetImage {
    TilePixels pixels;
    std::string identity;
    int failedCells = 0;               ///< cells drawn as a labelled error tile
    std::vector<std::string> failures; ///< one sentence per failed cell: "cell B2: #TYPE! ..."
    std::vector<std::string> notes;    ///< "cell B2: ...": what to know about cells that are drawn
    bool final = true;                 ///< nothing that is shown is still being imported or computed
};

/// Where a whole document comes from: one that stands in files already needs no recovery file.
enum class DocumentOrigin { File, Edit };

enum class ChangeKind { Workbook, Datasets };
using ChangeListener = std::function<void(ChangeKind, std::uint64_t version)>;

/// Thread-safe: every member may be called from any thread. Snapshots are immutable.
class Engine {
public:
    /// Throws GpuError if options.render and no usable EGL is there; IoError if a folder cannot be made.
    explicit Engine(EngineOptions options);
    ~Engine();
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;

    // --- datasets ---
    /// Starts imports in the background (a job each); returns the names given. A request with the name, files
    /// and options of a dataset that is there reads the files again if they have changed. Throws InvalidInput
    /// if options are wrong (field options.MEMBER) or a path lies outside the roots, NotFound if it does not
    /// exist, Conflict if the name is taken by another source.
    std::vector<std::string> importDatasets(const std::vector<ImportRequest>& requests,
                                            const ImportLayout& layout = {});
    /// Stores the bytes as a source in uploadDir under `fileName` (its last path component) and imports it.
    std::string importUpload(const std::string& name, const std::filesystem::path& receivedFile,
                             const std::string& fileName);
    [[nodiscard]] std::vector<DatasetInfo> datasets() const;
    /// Throws NotFound.
    [[nodiscard]] DatasetInfo dataset(const std::string& name) const;
    void removeDataset(const std::string& name);
    void cancelImport(const std::string& name);
    /// Blocks until no import, formula or clip object is under way, or the deadline passed; false on
    /// deadline.
    bool waitIdle(double seconds) const;
    /// Header-only look at a file (voxsheet-import --header-only); throws as the importer reports.
    [[nodiscard]] nlohmann::json previewFile(const std::filesystem::path& file,
                                             const nlohmann::json& options) const;

    // --- workbook ---
    [[nodiscard]] sheet::Snapshot snapshot() const;
    [[nodiscard]] std::uint64_t version() const;
    [[nodiscard]] const sheet::KeyTable& keys() const;
    /// Applies one command as one undo step; the same non-empty gesture id merges. Throws InvalidInput,
    /// NotFound.
    EditReport apply(const sheet::Command& command, const std::string& gesture = {});
    bool undo();
    bool redo();
    [[nodiscard]] bool canUndo() const;
    [[nodiscard]] bool canRedo() const;
    [[nodiscard]] nlohmann::json workbookJson() const;
    /// Replaces the document (one undo step) and imports its sources. `folder`: what relative source paths
    /// start from.
    void setWorkbookJson(const nlohmann::json& document, const std::filesystem::path& folder,
                         DocumentOrigin origin = DocumentOrigin::Edit);
    /// Atomic: temporary file, fsync, rename. Throws IoError; the old file stays whole.
    void saveWorkbook(const std::filesystem::path& file) const;
    /// Saves a recovery file when there are edits that saveWorkbook has not written. Never over a named
    /// workbook.
    std::optional<std::filesystem::path> saveRecovery() const;

    /// Of every cell of the sheet that has a source, in reading order. Throws NotFound.
    [[nodiscard]] std::vector<CellStatus> cellStatuses(const sheet::Workbook& workbook,
                                                       const std::string& sheetName) const;

    // --- pictures ---
    [[nodiscard]] PreparedTile prepareTile(const sheet::Workbook& workbook, const std::string& sheetName,
                                           const sheet::Address& cell, const View& view,
                                           const TileQuality& quality) const;
    /// The same tile at another level of detail, clamped to those there are. It must have a spec.
    [[nodiscard]] PreparedTile atLevel(PreparedTile tile, int level) const;
    /// The same tile as prepareTile gives it at another quality of the same `live`, without working out anew
    /// what the styles of the cell come to. It must have a spec.
    [[nodiscard]] PreparedTile atQuality(const PreparedTile& tile, const TileQuality& quality) const;
    [[nodiscard]] std::future<FrameResult> render(FrameSpec frame, FramePriority priority,
                                                  std::function<bool()> cancelled = {}) const;
    /// What a viewer (a page, by any name of its own) looks at, and what it may look at next; replaces what
    /// it showed before. Empty: nothing any more. What all viewers show together is evicted last and brought
    /// in first.
    void setShown(const std::string& viewer, std::vector<WantedVolume> volumes);
    [[nodiscard]] SheetImage renderSheet(const SheetImageRequest& request) const;
    /// One value per used cell at a world point; or at what lies under a pixel of a cell's picture, (0, 0)
    /// being its top left corner (empty when the ray misses the cell's volume, or the cell shows none).
    [[nodiscard]] std::vector<ProbeValue> probeWorld(const std::string& sheetName,
                                                     const glm::dvec3& world) const;
    [[nodiscard]] std::vector<ProbeValue> probePixel(const std::string& sheetName, const sheet::Address& cell,
                                                     const View& view, glm::dvec2 pixel,
                                                     glm::ivec2 sizePixels) const;
    /// The transfer function as drawn: colour-bar stops, range, unit, scale (JSON as in the API).
    [[nodiscard]] nlohmann::json colourBar(const std::string& sheetName, const sheet::Address& cell,
                                           const View& view) const;
    /// Smallest and largest finite value of what a cell shows; empty if there is none. Throws NotFound if the
    /// cell shows no volume.
    /// \param sizePixels  of the picture; it decides what of it is visible
    [[nodiscard]] std::optional<ValueExtremes> valueRange(const std::string& sheetName,
                                                          const sheet::Address& cell, const View& view,
                                                          RangeOver over, glm::ivec2 sizePixels) const;
    [[nodiscard]] nlohmann::json colourMaps() const;
    /// The looks that the program carries inside itself.
    [[nodiscard]] const std::vector<sheet::StylePreset>& stylePresets() const;

    // --- state ---
    [[nodiscard]] const RenderDevice* device() const; ///< null when options.render is false
    /// By which code each technique is drawn, and why; empty when options.render is false.
    [[nodiscard]] const std::vector<PathChoice>& paths() const;
    /// Every volume that the tile reads, in the form that its path does.
    [[nodiscard]] std::vector<WantedVolume> volumesOf(const TileSpec& tile, WantedPriority priority) const;
    [[nodiscard]] ResidencyState residency() const; ///< textures
    [[nodiscard]] HostCacheState hostCache() const; ///< samples in host memory, and what was read from disk
    [[nodiscard]] const EngineOptions& options() const;
    [[nodiscard]] std::uint64_t
    addListener(ChangeListener listener); ///< called from any thread; must not block
    void removeListener(std::uint64_t id);

private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace voxsheet::engine
