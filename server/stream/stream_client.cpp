#include "stream/stream_client.h"

#include "base/thread_count.h"
#include "stream/absent_tiles.h"
#include "stream/message.h"
#include "stream/tile_atlas.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace voxsheet::stream {

namespace {

using namespace std::chrono_literals;

constexpr auto kRestAfter = 150ms;     ///< no change for so long: final pictures
constexpr auto kPingAfter = 5s;        ///< silence that a ping breaks
constexpr auto kDatasetsEvery = 250ms; ///< at most so often
constexpr std::uint64_t kFramesInFlight = 2;
constexpr auto kAskAbsentAgain = 10ms; ///< for volumes of which nothing is there yet
/// Below so many pixels a second atlas, encoded and decoded beside the first, costs more than it saves.
constexpr std::size_t kAtlasPixels = 200'000;

std::string joined(const std::string& note, const std::string& other) {
    return note.empty() || other.empty() ? note + other : note + ". " + other;
}

double milliseconds(std::chrono::steady_clock::duration duration) {
    return std::chrono::duration<double, std::milli>(duration).count();
}

/// Everything but the encoded bytes; null, with the error kept in the plan, when there is no picture.
std::shared_ptr<EncodedImage> imageOf(PlannedTile& pending, const TilePixels& pixels, bool final) {
    if (!pixels.error.empty()) {
        pending.prepared.code = pixels.errorKind == ErrorKind::LimitExceeded ? "#MEM!" : "#GPU!";
        pending.prepared.message = pixels.error;
        return nullptr;
    }
    auto image = std::make_shared<EncodedImage>();
    image->size = pixels.size;
    image->level = pixels.level;
    image->renderMs = pixels.renderMs;
    image->final = final;
    image->awaited = pixels.awaited;
    image->note = pixels.note;
    return image;
}

/// What "tile", and each entry of "tiles", says of a picture.
void describe(nlohmann::json& json, const PlannedTile& pending) {
    const EncodedImage& image = *pending.image;
    json["width"] = image.size.x;
    json["height"] = image.size.y;
    json["level"] = image.level;
    json["scale"] = static_cast<double>(image.size.x) / pending.tile.sizePixels.x;
    json["renderMs"] = image.renderMs;
    json["final"] = image.final;
    if (const auto pinned = pending.prepared.needs.pinned) json["pinned"] = *pinned;
    if (const auto note = joined(pending.prepared.note, image.note); !note.empty()) json["note"] = note;
}

} // namespace

StreamClient::StreamClient(std::string id, std::string sheet, engine::Engine& engine, TileService& tiles,
                           SheetLevels& levels, const StreamOptions& options)
    : id_(std::move(id)), sheet_(std::move(sheet)), engine_(engine), tiles_(tiles), levels_(levels),
      options_(options), version_(engine.version()), planner_(id_, sheet_, engine, tiles, levels) {}

StreamClient::~StreamClient() { engine_.setShown(id_, {}); }

void StreamClient::update(const StreamUpdate& update) {
    const std::lock_guard lock(mutex_);
    if (update.ack) acknowledged_ = std::max(acknowledged_, *update.ack);
    if (update.view && (!hasView_ || update.view->id > view_.id)) {
        view_ = *update.view;
        hasView_ = true;
        lastChange_ = Clock::now();
        dirty_ = true;
    }
    wake_.notify_all();
}

void StreamClient::changed(engine::ChangeKind kind, std::uint64_t version) {
    const std::lock_guard lock(mutex_);
    if (kind == engine::ChangeKind::Workbook) {
        workbookChanged_ = true;
        version_ = version;
        lastChange_ = Clock::now();
    } else {
        datasetsChanged_ = true;
    }
    dirty_ = true;
    wake_.notify_all();
}

void StreamClient::levelsChanged() {
    const std::lock_guard lock(mutex_);
    dirty_ = true;
    wake_.notify_all();
}

void StreamClient::close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    wake_.notify_all();
}

ClientView StreamClient::view() const {
    const std::lock_guard lock(mutex_);
    return view_;
}

bool StreamClient::hasView() const {
    const std::lock_guard lock(mutex_);
    return hasView_;
}

std::chrono::steady_clock::time_point StreamClient::lastChange() const {
    const std::lock_guard lock(mutex_);
    return lastChange_;
}

StreamStatistics StreamClient::statistics() const {
    const std::lock_guard lock(mutex_);
    return statistics_;
}

std::optional<FrameTiming> StreamClient::lastFrame() const {
    const std::lock_guard lock(mutex_);
    return lastFrame_;
}

void StreamClient::push(const nlohmann::json& header, std::string_view payload) {
    outbox_.push_back(frameMessage(header, payload));
}

/// Called with the lock held.
void StreamClient::queueNotices() {
    if (!greeted_) {
        push({{"type", "hello"}, {"stream", id_}, {"version", version_}});
        greeted_ = true;
    }
    if (workbookChanged_) {
        push({{"type", "workbook"}, {"version", version_}});
        workbookChanged_ = false;
    }
    if (datasetsChanged_ && Clock::now() - lastDatasets_ >= kDatasetsEvery) {
        push({{"type", "datasets"}});
        datasetsChanged_ = false;
        lastDatasets_ = Clock::now();
    }
}

std::optional<std::string> StreamClient::next() {
    const auto silentSince = Clock::now();
    std::unique_lock lock(mutex_);
    for (;;) {
        if (closed_) return std::nullopt;
        if (outbox_.empty()) queueNotices();
        if (!outbox_.empty()) {
            auto message = std::move(outbox_.front());
            outbox_.pop_front();
            statistics_.bytes += message.size();
            return message;
        }
        const auto now = Clock::now();
        if (now - silentSince >= kPingAfter) return frameMessage({{"type", "ping"}});
        const bool mayDraw = hasView_ && frame_ - acknowledged_ < kFramesInFlight;
        const bool interactive = view_.moving || now - lastChange_ < kRestAfter;
        if (mayDraw && dirty_) {
            const auto view = view_;
            dirty_ = false;
            lock.unlock();
            auto work = planner_.plan(view, interactive);
            const bool finished = work.empty();
            const auto start = Clock::now();
            const bool drawn = finished || draw(work, view.id);
            const bool nothingThere = drawn && !finished && work.empty();
            if (drawn && !work.empty()) emit(work, view, milliseconds(Clock::now() - start));
            // After a redraw of all cells a rule may change their level.
            const bool judgeAgain = finished && !interactive && planner_.rested();
            lock.lock();
            // More to do: the pictures in between were not final ones, or only a chunk of the final ones was
            // drawn.
            if (!finished || judgeAgain) dirty_ = true;
            if (finished && !interactive && !judgeAgain)
                push({{"type", "rest"}, {"view", view.id}, {"version", work.workbookVersion}});
            if (nothingThere) wake_.wait_for(lock, kAskAbsentAgain, [this] { return closed_; });
            if (finished && interactive) {
                wake_.wait_until(lock, lastChange_ + kRestAfter, [this] { return closed_ || dirty_; });
                dirty_ = true;
            }
            continue;
        }
        const auto deadline = datasetsChanged_
                                  ? std::min(silentSince + kPingAfter, lastDatasets_ + kDatasetsEvery)
                                  : silentSince + kPingAfter;
        wake_.wait_until(lock, deadline);
    }
}

bool StreamClient::draw(FramePlan& plan, std::uint64_t viewId) {
    FrameSpec spec;
    // A gesture never waits for a texture; a picture at rest is as fine as the budget allows.
    spec.levels = plan.interactive ? LevelChoice::AtHand : LevelChoice::WithinBudget;
    std::vector<std::size_t> drawnBy;
    for (std::size_t i = 0; i < plan.tiles.size(); ++i) {
        if (plan.tiles[i].image) continue;
        spec.tiles.push_back(*plan.tiles[i].prepared.spec);
        drawnBy.push_back(i);
    }
    if (spec.tiles.empty()) return true;
    const auto needless = [this, viewId, interactive = plan.interactive] {
        const std::lock_guard lock(mutex_);
        return closed_ || (!interactive && view_.id != viewId);
    };
    const auto start = Clock::now();
    FrameResult frame;
    try {
        const auto priority = plan.interactive ? FramePriority::Interactive : FramePriority::Final;
        frame = engine_.render(std::move(spec), priority, needless).get();
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::Cancelled) throw;
        return false;
    }
    leaveOutAbsent(plan, drawnBy, frame);
    if (options_.atlas && plan.interactive)
        encodeAtlases(plan, drawnBy, frame);
    else
        encodeTiles(plan, drawnBy, frame);
    double pixels = 0.0;
    for (std::size_t i = 0; i < drawnBy.size(); ++i) {
        const auto& pending = plan.tiles[drawnBy[i]];
        pixels += static_cast<double>(pending.tile.sizePixels.x) * pending.tile.sizePixels.y;
        planner_.drawn(plan, pending, frame.tiles[i]);
        // A coarser level than its identity says is for this page alone.
        if (pending.image && pending.image->final && pending.image->note.empty())
            tiles_.remember(pending.image);
    }
    if (!drawnBy.empty()) planner_.frameDrawn(plan, pixels, milliseconds(Clock::now() - start));
    return true;
}

void StreamClient::encodeTiles(FramePlan& plan, const std::vector<std::size_t>& drawnBy,
                               const FrameResult& frame) {
    const auto settings = planner_.encoding(plan.interactive);
    tbb::parallel_for(std::size_t{0}, drawnBy.size(), [&](std::size_t i) {
        PlannedTile& pending = plan.tiles[drawnBy[i]];
        auto image = imageOf(pending, frame.tiles[i], !plan.interactive);
        if (!image) return;
        const auto start = Clock::now();
        image->bytes = encodeImage(frame.tiles[i], settings);
        image->encodeMs = milliseconds(Clock::now() - start);
        image->identity = encodedIdentity(pending.prepared.identity, settings);
        image->format = settings.format;
        pending.image = std::move(image);
    });
}

void StreamClient::encodeAtlases(FramePlan& plan, const std::vector<std::size_t>& drawnBy,
                                 const FrameResult& frame) {
    const auto settings = planner_.encoding(plan.interactive);
    std::vector<std::size_t> drawn; // of the frame's tiles, those with a picture
    std::vector<std::size_t> pixels;
    for (std::size_t i = 0; i < drawnBy.size(); ++i) {
        PlannedTile& pending = plan.tiles[drawnBy[i]];
        auto image = imageOf(pending, frame.tiles[i], !plan.interactive);
        if (!image) continue;
        image->format = settings.format;
        drawn.push_back(i);
        pixels.push_back(frame.tiles[i].rgba8.size() / 4);
        pending.image = std::move(image);
    }
    const auto ends = splitEvenly(pixels, static_cast<std::size_t>(threadCount().threads), kAtlasPixels);
    plan.atlases.resize(ends.size());
    tbb::parallel_for(std::size_t{0}, ends.size(), [&](std::size_t run) {
        const auto start = Clock::now();
        EncodedAtlas& atlas = plan.atlases[run];
        std::vector<const TilePixels*> pictures;
        std::vector<glm::ivec2> sizes;
        for (std::size_t i = run == 0 ? 0 : ends[run - 1]; i < ends[run]; ++i) {
            atlas.tiles.push_back(drawnBy[drawn[i]]);
            pictures.push_back(&frame.tiles[drawn[i]]);
            sizes.push_back(pictures.back()->size);
        }
        const AtlasLayout layout = layOutAtlas(sizes);
        atlas.bytes = encodeImage(composeAtlas(pictures, layout), settings);
        atlas.origins = layout.origins;
        atlas.format = settings.format;
        atlas.encodeMs = milliseconds(Clock::now() - start);
    });
}

void StreamClient::emit(const FramePlan& plan, const ClientView& view, double frameMs) {
    ++frame_;
    std::vector<bool> inAtlas(plan.tiles.size(), false);
    std::size_t left = plan.notices.size() + plan.tiles.size() + plan.atlases.size();
    for (const EncodedAtlas& atlas : plan.atlases) {
        left -= atlas.tiles.size();
        for (const std::size_t tile : atlas.tiles)
            inAtlas[tile] = true;
    }
    auto header = [&](const char* type) {
        --left;
        return nlohmann::json{{"type", type}, {"frame", frame_}, {"view", view.id}, {"frameEnd", left == 0}};
    };
    auto identify = [&](nlohmann::json& json, const sheet::Address& cell) {
        json["seq"] = ++sequence_;
        json["cell"] = sheet::addressName(cell);
    };
    auto notice = [&](const engine::PreparedTile& tile) {
        auto json = header("cell");
        identify(json, tile.cell);
        json["state"] = tile.progress < 1.0 ? "importing" : (tile.code.empty() ? "empty" : "error");
        json["code"] = tile.code;
        json["message"] = tile.message;
        json["progress"] = tile.progress;
        push(json);
    };
    FrameTiming timing{Clock::now(), frameMs, 0, 0, !plan.interactive};
    auto sent = [&](const PlannedTile& pending) {
        planner_.pictureSent(pending);
        ++timing.tiles;
        timing.level = std::max(timing.level, pending.image->level);
    };
    for (const auto& tile : plan.notices) {
        notice(tile);
        planner_.stateSent(tile);
    }
    for (std::size_t i = 0; i < plan.tiles.size(); ++i) {
        const PlannedTile& pending = plan.tiles[i];
        if (inAtlas[i]) continue;
        if (!pending.image) {
            notice(pending.prepared);
            planner_.failureSent(pending, !plan.interactive);
            continue;
        }
        auto json = header("tile");
        identify(json, pending.tile.cell);
        describe(json, pending);
        json["format"] = formatName(pending.image->format);
        json["encodeMs"] = pending.image->encodeMs;
        push(json, pending.image->bytes);
        sent(pending);
    }
    for (const EncodedAtlas& atlas : plan.atlases) {
        auto json = header("tiles");
        json["format"] = formatName(atlas.format);
        json["encodeMs"] = atlas.encodeMs;
        auto& tiles = json["tiles"] = nlohmann::json::array();
        for (std::size_t i = 0; i < atlas.tiles.size(); ++i) {
            const PlannedTile& pending = plan.tiles[atlas.tiles[i]];
            nlohmann::json tile{{"x", atlas.origins[i].x}, {"y", atlas.origins[i].y}};
            identify(tile, pending.tile.cell);
            describe(tile, pending);
            tiles.push_back(std::move(tile));
            sent(pending);
        }
        push(json, atlas.bytes);
    }
    emitStatus(plan, view.id, frameMs);
    const std::lock_guard lock(mutex_);
    ++statistics_.frames;
    statistics_.tiles += timing.tiles;
    if (timing.tiles > 0) lastFrame_ = timing;
}

void StreamClient::emitStatus(const FramePlan& plan, std::uint64_t viewId, double frameMs) {
    std::size_t finalCells = plan.finalCells;
    int level = 0;
    for (const auto& pending : plan.tiles) {
        if (!pending.image) continue;
        if (pending.image->final) ++finalCells;
        level = std::max(level, pending.image->level);
    }
    const auto residency = engine_.residency();
    push({{"type", "status"},
          {"view", viewId},
          {"frameMs", frameMs},
          {"finalCells", finalCells},
          {"cells", plan.visibleCells},
          {"level", level},
          {"policy", levelPolicyName(levels_.settings().policy)},
          {"residentBytes", residency.residentBytes},
          {"budgetBytes", residency.budgetBytes}});
}

} // namespace voxsheet::stream
