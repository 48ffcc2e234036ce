// What one page's next frame draws: which cells are dirty, at which level and quality, and which pictures are
// at hand already.
#pragma once

#include "resolution/interactive_quality.h"
#include "stream/sheet_levels.h"
#include "stream/stream_hub.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace voxsheet::stream {

struct PlannedTile {
    ViewTile tile;
    engine::PreparedTile prepared;
    std::shared_ptr<const EncodedImage> image; ///< when the cache had it, or once it is drawn
};

/// Some of a frame's tiles in one encoded picture.
struct EncodedAtlas {
    std::vector<std::size_t>
        tiles; ///< indices into FramePlan::tiles; their images have no bytes of their own
    std::vector<glm::ivec2> origins; ///< per tile: upper left corner
    std::string bytes;
    ImageFormat format = ImageFormat::Jpeg;
    double encodeMs = 0.0;
};

/// All dirty tiles while moving, as many final ones as fit a short time at rest.
struct FramePlan {
    std::vector<PlannedTile> tiles;
    std::vector<EncodedAtlas> atlases;         ///< once drawn; tiles that are in none are sent one by one
    std::vector<engine::PreparedTile> notices; ///< cells without a picture whose state changed
    bool interactive = false;
    std::uint64_t workbookVersion = 0;
    int step = 0;
    double pixels = 0.0;
    std::size_t finalCells = 0;
    std::size_t visibleCells = 0;
    [[nodiscard]] bool empty() const { return tiles.empty() && notices.empty(); }
};

/// Of one page; belongs to the thread that writes its stream.
class FramePlanner {
public:
    /// \param viewer  name that the engine is told who looks by; empty: nobody does
    FramePlanner(std::string viewer, std::string sheet, engine::Engine& engine, TileService& tiles,
                 SheetLevels& levels);

    [[nodiscard]] FramePlan plan(const ClientView& view, bool interactive);
    /// All tiles of the view at the levels that they are drawn at when at rest, dirty or not.
    [[nodiscard]] FramePlan planAll(const ClientView& view);
    [[nodiscard]] EncodeSettings encoding(bool interactive) const;

    /// A tile of the plan was drawn.
    void drawn(const FramePlan& plan, const PlannedTile& tile, const TilePixels& pixels);
    /// All tiles of the plan that were not at hand were drawn and encoded in `ms`.
    void frameDrawn(const FramePlan& plan, double pixels, double ms);
    void pictureSent(const PlannedTile& tile);
    /// Drawing it failed, and the page was told: it is not tried again until it is to look different.
    void failureSent(const PlannedTile& tile, bool final);
    void stateSent(const engine::PreparedTile& tile);
    /// Nothing is left to draw for the view of the last plan. True when some of its cells were redrawn since
    /// the last rest and what the others took is known: the time-N curve has a new point, and a rule may now
    /// change levels: plan again.
    [[nodiscard]] bool rested();
    /// What else than their number the time of the cells in the last plan depends on: techniques, and how
    /// large texels are on the screen, to the nearest octave. Redraw::kind.
    [[nodiscard]] std::string kindOfWork() const;

private:
    /// What the page shows in one cell.
    struct Shown {
        std::string identity; ///< of the pixels last sent
        std::string state;    ///< of the last "cell" message
        bool final = false;
    };
    struct Timed {
        std::string identity;
        double ms = 0.0;    ///< in a tile of kTimedTilePixels
        bool fresh = false; ///< since the last rest
    };

    void prepareVisible(const sheet::Workbook& workbook, const ClientView& view, FramePlan& plan);
    void chooseLevels(const ClientView& view, bool interactive);
    [[nodiscard]] std::vector<CellOnShow> cellsOnShow(const ClientView& view) const;
    /// Tells the engine which volumes are looked at, and which cells one may scroll to next.
    void tellShown(const sheet::Workbook& workbook, const ClientView& view);
    void addNeighbours(const sheet::Workbook& workbook, const ClientView& view,
                       std::vector<WantedVolume>& volumes) const;
    void keepChunk(FramePlan& plan) const;
    void reduceQuality(FramePlan& plan);
    [[nodiscard]] bool isShown(const sheet::Address& cell, const std::string& identity, bool final) const;

    const std::string viewer_;
    const std::string sheet_;
    engine::Engine& engine_;
    TileService& tiles_;
    SheetLevels& levels_;
    InteractiveQuality quality_{50.0};
    std::map<sheet::Address, Shown> shown_;
    std::map<sheet::Address, int> levelOf_;  ///< as chosen for the last plan
    std::string demanded_;                   ///< what they were chosen for
    std::map<sheet::Address, Timed> timed_;  ///< when last drawn at full quality
    std::vector<WantedVolume> shownVolumes_; ///< as told to the engine last, without neighbours
    std::vector<PlannedTile> visible_;       ///< cells with a picture in the last plan's view
};

} // namespace voxsheet::stream
