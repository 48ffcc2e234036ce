#include "stream/stream_client.h"

#include "engine/shown_volumes.h"
#include "stream/message.h"

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
constexpr std::size_t kMostNeighbours = 32; ///< cells beside the visible ones that are got ready
constexpr double kFinalChunkMs = 120.0; ///< final pictures are sent in chunks of about this time, so that a
                                        ///< new gesture is not kept waiting

double milliseconds(std::chrono::steady_clock::duration duration) {
    return std::chrono::duration<double, std::milli>(duration).count();
}

glm::ivec2 scaled(const glm::ivec2& size, double scale) {
    return glm::max(glm::ivec2(glm::round(glm::dvec2(size) * scale)), glm::ivec2(1));
}

std::string cellState(const engine::PreparedTile& tile) {
    return tile.code + "|" + tile.message + "|" + std::to_string(std::lround(tile.progress * 100.0));
}

} // namespace

StreamClient::StreamClient(std::string id, std::string sheet, engine::Engine& engine, TileService& tiles)
    : id_(std::move(id)), sheet_(std::move(sheet)), engine_(engine), tiles_(tiles),
      version_(engine.version()) {}

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

void StreamClient::close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    wake_.notify_all();
}

ClientView StreamClient::view() const {
    const std::lock_guard lock(mutex_);
    return view_;
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
            auto work = plan(view, interactive);
            const bool finished = work.tiles.empty() && work.notices.empty();
            const auto start = Clock::now();
            const bool drawn = finished || draw(work, view.id);
            if (drawn && !finished) emit(work, view, milliseconds(Clock::now() - start));
            lock.lock();
            // More to do: the pictures in between were not final ones, or only a chunk of the final ones was
            // drawn.
            if (!finished) dirty_ = true;
            if (finished && !interactive)
                push({{"type", "rest"}, {"view", view.id}, {"version", work.workbookVersion}});
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

EncodeSettings StreamClient::encoding(bool interactive) const {
    EncodeSettings settings;
    settings.format = interactive ? ImageFormat::Jpeg : ImageFormat::Png;
    settings.quality = 75;
    settings.subsampleChroma = interactive;
    settings.fast = true;
    return settings;
}

void StreamClient::addTile(Plan& plan, const sheet::Workbook& workbook, const ClientView& view,
                           const ViewTile& tile) const {
    engine::TileQuality full;
    full.sizePixels = tile.sizePixels;
    auto prepared = engine_.prepareTile(workbook, sheet_, tile.cell, view.overrides, full);
    const auto shown = shown_.find(tile.cell);
    if (!prepared.spec) {
        if (shown == shown_.end() || shown->second.state != cellState(prepared))
            plan.notices.push_back(std::move(prepared));
        return;
    }
    ++plan.visibleCells;
    const auto volumes = engine::volumesOf(*prepared.spec, WantedPriority::Visible);
    plan.shown.insert(plan.shown.end(), volumes.begin(), volumes.end());
    if (shown != shown_.end() && shown->second.final && shown->second.identity == prepared.identity) {
        ++plan.finalCells;
        return;
    }
    plan.tiles.push_back({tile, std::move(prepared), nullptr, 0});
}

void StreamClient::addNeighbours(Plan& plan, const sheet::Workbook& workbook, const ClientView& view) const {
    if (view.tiles.empty()) return;
    sheet::Address low = view.tiles.front().cell;
    sheet::Address high = low;
    for (const auto& tile : view.tiles) {
        low = {std::min(low.column, tile.cell.column), std::min(low.row, tile.cell.row)};
        high = {std::max(high.column, tile.cell.column), std::max(high.row, tile.cell.row)};
    }
    std::size_t added = 0;
    for (const auto& [cell, content] : sheet::sheetNamed(workbook, sheet_).cells) {
        const bool inside = cell.column >= low.column && cell.column <= high.column && cell.row >= low.row &&
                            cell.row <= high.row;
        const bool near = cell.column >= low.column - 1 && cell.column <= high.column + 1 &&
                          cell.row >= low.row - 1 && cell.row <= high.row + 1;
        if (inside || !near || content.source.empty()) continue;
        const auto prepared = engine_.prepareTile(workbook, sheet_, cell, view.overrides, {});
        if (!prepared.spec) continue;
        const auto volumes = engine::volumesOf(*prepared.spec, WantedPriority::Soon);
        plan.shown.insert(plan.shown.end(), volumes.begin(), volumes.end());
        if (++added == kMostNeighbours) return;
    }
}

StreamClient::Plan StreamClient::plan(const ClientView& view, bool interactive) {
    Plan plan;
    plan.interactive = interactive;
    const auto workbook = engine_.snapshot();
    plan.workbookVersion = workbook->version;
    for (const auto& tile : view.tiles)
        addTile(plan, *workbook, view, tile);
    if (plan.shown != shownVolumes_) {
        shownVolumes_ = plan.shown;
        addNeighbours(plan, *workbook, view);
        engine_.setShown(id_, std::move(plan.shown));
    }
    for (auto& pending : plan.tiles)
        pending.image = tiles_.cached(encodedIdentity(pending.prepared.identity, encoding(false)));
    for (const auto& pending : plan.tiles)
        plan.pixels += static_cast<double>(pending.tile.sizePixels.x) * pending.tile.sizePixels.y;
    if (!interactive) {
        // As many final pictures as fit the chunk; at least one.
        double pixels = 0.0;
        std::size_t count = 0;
        for (; count < plan.tiles.size(); ++count) {
            const auto& size = plan.tiles[count].tile.sizePixels;
            pixels += static_cast<double>(size.x) * size.y;
            if (count > 0 && quality_.predictedMs(pixels, 0) > kFinalChunkMs) break;
            plan.pixels = pixels;
        }
        plan.tiles.resize(count);
        return plan;
    }
    plan.step = quality_.choose(plan.pixels);
    engine::TileQuality reduced;
    reduced.sampleDistanceFactor = kQualitySteps[plan.step].sampleDistanceFactor;
    std::erase_if(plan.tiles, [&](Pending& pending) {
        if (pending.image) return false; // the final picture is at hand: nothing is faster
        reduced.sizePixels = scaled(pending.tile.sizePixels, kQualitySteps[plan.step].scale);
        pending.prepared = engine_.prepareTile(*workbook, sheet_, pending.tile.cell, view.overrides, reduced);
        const auto shown = shown_.find(pending.tile.cell);
        return !pending.prepared.spec ||
               (shown != shown_.end() && shown->second.identity == pending.prepared.identity);
    });
    return plan;
}

bool StreamClient::draw(Plan& plan, std::uint64_t viewId) {
    std::vector<TileSpec> specs;
    std::vector<std::size_t> drawnBy;
    for (std::size_t i = 0; i < plan.tiles.size(); ++i) {
        if (plan.tiles[i].image) continue;
        specs.push_back(*plan.tiles[i].prepared.spec);
        drawnBy.push_back(i);
    }
    if (specs.empty()) return true;
    const auto needless = [this, viewId, interactive = plan.interactive] {
        const std::lock_guard lock(mutex_);
        return closed_ || (!interactive && view_.id != viewId);
    };
    const auto start = Clock::now();
    FrameResult frame;
    try {
        frame = engine_
                    .render(specs, plan.interactive ? FramePriority::Interactive : FramePriority::Final,
                            needless, PixelFormat::Rgba8,
                            plan.interactive ? LevelChoice::AtHand : LevelChoice::WithinBudget)
                    .get();
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::Cancelled) throw;
        return false;
    }
    const auto settings = encoding(plan.interactive);
    tbb::parallel_for(std::size_t{0}, specs.size(), [&](std::size_t i) {
        auto& pending = plan.tiles[drawnBy[i]];
        const auto& pixels = frame.tiles[i];
        if (!pixels.error.empty()) {
            pending.prepared.code = pixels.errorKind == ErrorKind::LimitExceeded ? "#MEM!" : "#GPU!";
            pending.prepared.message = pixels.error;
            return;
        }
        auto image = std::make_shared<EncodedImage>();
        const auto encodeStart = Clock::now();
        image->bytes = encodeImage(pixels, settings);
        image->encodeMs = milliseconds(Clock::now() - encodeStart);
        image->identity = encodedIdentity(pending.prepared.identity, settings);
        image->format = settings.format;
        image->size = pixels.size;
        image->level = pixels.level;
        image->renderMs = pixels.renderMs;
        image->final = !plan.interactive;
        image->awaited = pixels.awaited;
        image->note = pixels.note;
        pending.image = image;
    });
    double pixels = 0.0;
    for (const auto index : drawnBy) {
        const auto& pending = plan.tiles[index];
        pixels += static_cast<double>(pending.tile.sizePixels.x) * pending.tile.sizePixels.y;
        // A coarser level than its identity says is for this page alone.
        if (pending.image && pending.image->final && pending.image->note.empty())
            tiles_.remember(pending.image);
    }
    quality_.measured(pixels, plan.step, milliseconds(Clock::now() - start));
    return true;
}

void StreamClient::emit(const Plan& plan, const ClientView& view, double frameMs) {
    ++frame_;
    const std::size_t count = plan.notices.size() + plan.tiles.size();
    std::size_t index = 0;
    auto header = [&](const sheet::Address& cell, const char* type) {
        ++index;
        return nlohmann::json{{"type", type},
                              {"seq", ++sequence_},
                              {"frame", frame_},
                              {"view", view.id},
                              {"cell", sheet::addressName(cell)},
                              {"frameEnd", index == count}};
    };
    auto notice = [&](const engine::PreparedTile& tile) {
        auto json = header(tile.cell, "cell");
        json["state"] = tile.progress < 1.0 ? "importing" : (tile.code.empty() ? "empty" : "error");
        json["code"] = tile.code;
        json["message"] = tile.message;
        json["progress"] = tile.progress;
        push(json);
        shown_[tile.cell] = Shown{{}, cellState(tile), false};
    };
    for (const auto& tile : plan.notices)
        notice(tile);
    FrameTiming timing{Clock::now(), frameMs, 0, 0, !plan.interactive};
    for (const auto& pending : plan.tiles) {
        if (!pending.image) {
            notice(pending.prepared);
            continue;
        }
        const auto& image = *pending.image;
        auto json = header(pending.tile.cell, "tile");
        json["width"] = image.size.x;
        json["height"] = image.size.y;
        json["format"] = formatName(image.format);
        json["level"] = image.level;
        json["scale"] = static_cast<double>(image.size.x) / pending.tile.sizePixels.x;
        json["renderMs"] = image.renderMs;
        json["encodeMs"] = image.encodeMs;
        json["final"] = image.final;
        if (!image.note.empty()) json["note"] = image.note;
        push(json, image.bytes);
        // What stands in for a volume that is on its way is drawn again.
        shown_[pending.tile.cell] =
            Shown{image.awaited ? std::string{} : pending.prepared.identity, {}, image.final};
        ++timing.tiles;
        timing.level = std::max(timing.level, image.level);
    }
    emitStatus(plan, view.id, frameMs);
    const std::lock_guard lock(mutex_);
    ++statistics_.frames;
    statistics_.tiles += timing.tiles;
    if (timing.tiles > 0) lastFrame_ = timing;
}

void StreamClient::emitStatus(const Plan& plan, std::uint64_t viewId, double frameMs) {
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
          {"residentBytes", residency.residentBytes},
          {"budgetBytes", residency.budgetBytes}});
}

} // namespace voxsheet::stream
