// One page's stream: decides what to draw next, at which quality, and makes the messages.
#pragma once

#include "stream/frame_planner.h"
#include "stream/stream_hub.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

namespace voxsheet::stream {

/// next() belongs to one thread (the writer); every other member may be called from any thread.
class StreamClient {
public:
    StreamClient(std::string id, std::string sheet, engine::Engine& engine, TileService& tiles,
                 SheetLevels& levels, const StreamOptions& options);
    ~StreamClient(); ///< nobody looks any more
    StreamClient(const StreamClient&) = delete;
    StreamClient& operator=(const StreamClient&) = delete;

    void update(const StreamUpdate& update);
    void changed(engine::ChangeKind kind, std::uint64_t version);
    /// Cells may get other levels than the page has them at.
    void levelsChanged();
    void close();
    [[nodiscard]] std::optional<std::string> next();
    [[nodiscard]] ClientView view() const;
    [[nodiscard]] bool hasView() const;
    /// When the page's view changed last.
    [[nodiscard]] std::chrono::steady_clock::time_point lastChange() const;
    [[nodiscard]] StreamStatistics statistics() const;
    [[nodiscard]] const std::string& sheet() const { return sheet_; }
    [[nodiscard]] std::optional<FrameTiming> lastFrame() const;

private:
    using Clock = std::chrono::steady_clock;

    void queueNotices();
    /// Draws and encodes; false when a newer view made the work needless.
    bool draw(FramePlan& plan, std::uint64_t viewId);
    /// Encodes each picture by itself.
    void encodeTiles(FramePlan& plan, const std::vector<std::size_t>& drawnBy, const FrameResult& frame);
    /// Encodes many pictures in few.
    void encodeAtlases(FramePlan& plan, const std::vector<std::size_t>& drawnBy, const FrameResult& frame);
    void emit(const FramePlan& plan, const ClientView& view, double frameMs);
    void emitStatus(const FramePlan& plan, std::uint64_t viewId, double frameMs);
    void push(const nlohmann::json& header, std::string_view payload = {});

    const std::string id_;
    const std::string sheet_;
    engine::Engine& engine_;
    TileService& tiles_;
    SheetLevels& levels_;
    const StreamOptions options_;

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
    FramePlanner planner_;
    std::uint64_t frame_ = 0;
    std::uint64_t sequence_ = 0;
    bool greeted_ = false;
    Clock::time_point lastDatasets_{};
};

} // namespace voxsheet::stream
