// One page's stream: decides what to draw next, at which quality, and makes the messages.
#pragma once

#include "resolution/interactive_quality.h"
#include "stream/stream_hub.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace voxsheet::stream {

/// next() belongs to one thread (the writer); every other member may be called from any thread.
class StreamClient {
public:
    StreamClient(std::string id, std::string sheet, engine::Engine& engine, TileService& tiles);
    ~StreamClient(); ///< nobody looks any more
    StreamClient(const StreamClient&) = delete;
    StreamClient& operator=(const StreamClient&) = delete;

    void update(const StreamUpdate& update);
    void changed(engine::ChangeKind kind, std::uint64_t version);
    void close();
    [[nodiscard]] std::optional<std::string> next();
    [[nodiscard]] ClientView view() const;
    [[nodiscard]] StreamStatistics statistics() const;
    [[nodiscard]] const std::string& sheet() const { return sheet_; }
    [[nodiscard]] std::optional<FrameTiming> lastFrame() const;

private:
    using Clock = std::chrono::steady_clock;

    /// What the page shows in one cell.
    struct Shown {
        std::string identity; ///< of the pixels last sent
        std::string state;    ///< of the last "cell" message
        bool final = false;
    };
    struct Pending {
        ViewTile tile;
        engine::PreparedTile prepared;
        std::shared_ptr<const EncodedImage> image; ///< when the cache had it
        int level = 0;
    };
    /// What one frame draws: all dirty tiles while moving, as many final ones as fit a short time at rest.
    struct Plan {
        std::vector<Pending> tiles;
        std::vector<engine::PreparedTile> notices; ///< cells without a picture whose state changed
        bool interactive = false;
        std::uint64_t workbookVersion = 0;
        int step = 0;
        double pixels = 0.0;
        std::size_t finalCells = 0;
        std::size_t visibleCells = 0;
        std::vector<WantedVolume> shown; ///< by all visible cells, the final ones too
    };

    void queueNotices();
    [[nodiscard]] Plan plan(const ClientView& view, bool interactive);
    void addTile(Plan& plan, const sheet::Workbook& workbook, const ClientView& view,
                 const ViewTile& tile) const;
    /// Cells just outside of the view: where one scrolls to next.
    void addNeighbours(Plan& plan, const sheet::Workbook& workbook, const ClientView& view) const;
    [[nodiscard]] EncodeSettings encoding(bool interactive) const;
    /// Draws and encodes; false when a newer view made the work needless.
    bool draw(Plan& plan, std::uint64_t viewId);
    void emit(const Plan& plan, const ClientView& view, double frameMs);
    void emitStatus(const Plan& plan, std::uint64_t viewId, double frameMs);
    void push(const nlohmann::json& header, std::string_view payload = {});

    const std::string id_;
    const std::string sheet_;
    engine::Engine& engine_;
    TileService& tiles_;

    mutable std::mutex mutex_;
    std::condition_variable wake_;
    bool closed_ = false;
    ClientView view_;
    bool hasView_ = false;
    bool dirty_ = false; ///< something changed since the last plan that found nothing to do
    bool workbookChanged_ = false;
    bool datasetsChanged_ = false;
    std::uint64_t version_ = 0;
    std::uint64_t acknowledged_ = 0;
    Clock::time_point lastChange_ = Clock::now();
    StreamStatistics statistics_;
    std::optional<FrameTiming> lastFrame_;

    // Of the writer thread alone.
    std::deque<std::string> outbox_;
    std::map<sheet::Address, Shown> shown_;
    std::vector<WantedVolume> shownVolumes_; ///< as told to the engine last, without neighbours
    InteractiveQuality quality_{50.0};
    std::uint64_t frame_ = 0;
    std::uint64_t sequence_ = 0;
    bool greeted_ = false;
    Clock::time_point lastDatasets_{};
};

} // namespace voxsheet::stream
