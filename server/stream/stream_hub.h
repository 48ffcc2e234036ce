// One framed binary stream per page: only tiles that changed, newest view first, at most two frames
// unacknowledged.
//
// Message = u32le headerBytes, u32le payloadBytes, header (UTF-8 JSON), payload (the encoded picture, or
// nothing). Header types: hello, workbook, datasets (something changed: ask again), tile, tiles and cell (in
// frames, the last of each with frameEnd), status (figures of the last frame), rest {view, version} (nothing
// more to send for this view and version of the workbook: every tile is final), ping. "tiles" comes only to
// pages that asked for it: the payload is one picture (an atlas) with what a frame of a gesture changes in
// many cells; in the header, `tiles` lists each cell with what "tile" says of it, and x and y of its upper
// left corner there.
#pragma once

#include "engine/engine.h"
#include "stream/sheet_levels.h"
#include "stream/tile_service.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace voxsheet::stream {

struct ViewTile {
    sheet::Address cell;
    glm::ivec2 sizePixels{0}; ///< device pixels of the picture on the page, [1, 8192]
};

/// What one page shows right now. The view with the largest id wins.
struct ClientView {
    std::uint64_t id = 0;
    bool moving = false;         ///< a gesture is under way: speed before quality
    std::vector<ViewTile> tiles; ///< the visible cells, most important first
    std::optional<sheet::Address> focus;
    engine::View overrides;
};

struct StreamUpdate {
    std::optional<std::uint64_t> ack; ///< cumulative: the last frame painted
    std::optional<ClientView> view;
};

struct StreamOptions {
    bool atlas = false; ///< several tiles may come in one picture ("tiles")
};

struct StreamStatistics {
    int streams = 0;
    std::uint64_t frames = 0;
    std::uint64_t tiles = 0;
    std::uint64_t bytes = 0;
};

/// The last frame that a page of some sheet was sent.
struct FrameTiming {
    std::chrono::steady_clock::time_point when;
    double frameMs = 0.0;  ///< render, read back and encode
    std::size_t tiles = 0; ///< drawn in it
    int level = 0;         ///< coarsest level of detail among them
    bool final = false;
};

class StreamClient;

/// Thread-safe. The thread that writes a stream's bytes calls next() in a loop; rendering and encoding of
/// that stream happen inside next(), so a client that reads slowly delays only itself.
class StreamHub {
public:
    /// \param levels  of every sheet whose workbook says nothing of them
    StreamHub(engine::Engine& engine, TileService& tiles, const LevelSettings& levels = {});
    ~StreamHub();
    StreamHub(const StreamHub&) = delete;
    StreamHub& operator=(const StreamHub&) = delete;

    /// Returns the stream's id (unguessable). Throws NotFound if the sheet does not exist, LimitExceeded
    /// beyond 256 streams.
    std::string open(const std::string& sheet, const StreamOptions& options = {});
    void close(const std::string& id);
    /// Throws NotFound if there is no such stream.
    void update(const std::string& id, const StreamUpdate& update);
    /// The next message, ready to be written. Empty optional: the stream is closed (or the hub is stopping).
    /// Never blocks longer than 5 s: a ping comes when nothing else does.
    [[nodiscard]] std::optional<std::string> next(const std::string& id);
    /// The view a stream's page last sent, for probes of that page. Throws NotFound.
    [[nodiscard]] ClientView view(const std::string& id) const;
    /// Makes every next() return at once, for ever.
    void stop();
    [[nodiscard]] StreamStatistics statistics() const;
    /// Of the open streams of this sheet; nothing before the first frame.
    [[nodiscard]] std::optional<FrameTiming> lastFrame(const std::string& sheet) const;
    /// Levels of detail of a sheet; made at the first call. Its settings follow the workbook. Throws NotFound
    /// if the sheet does not exist.
    [[nodiscard]] SheetLevels& levels(const std::string& sheet);
    /// The newest view of the sheet among its pages; nothing before a page has sent one.
    [[nodiscard]] std::optional<ClientView> newestView(const std::string& sheet) const;

private:
    [[nodiscard]] std::shared_ptr<StreamClient> find(const std::string& id) const;
    /// Called with the lock held.
    [[nodiscard]] SheetLevels& levelsOf(const std::string& sheet);
    void levelsChanged(const std::string& sheet);
    /// As the workbook's newest snapshot has them.
    void applyLevelSettings();
    [[nodiscard]] std::optional<LevelSettings> settingsOf(const std::string& sheet) const;

    engine::Engine& engine_;
    TileService& tiles_;
    std::uint64_t listener_ = 0;
    mutable std::mutex mutex_;
    bool stopping_ = false;
    StreamStatistics closed_;     ///< sums over streams that are gone
    LevelSettings levelSettings_; ///< where the workbook has none
    std::mutex applying_;         ///< so that an older snapshot never overtakes a newer one
    std::unordered_map<std::string, std::unique_ptr<SheetLevels>> levels_; ///< by sheet
    std::unordered_map<std::string, std::shared_ptr<StreamClient>> clients_;
};

} // namespace voxsheet::stream
