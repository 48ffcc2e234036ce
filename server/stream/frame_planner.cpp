#include "stream/frame_planner.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace voxsheet::stream {

namespace {

constexpr std::size_t kMostNeighbours = 32; ///< cells beside the visible ones that are got ready
constexpr double kFinalChunkMs = 120.0; ///< final pictures are sent in chunks of about this time, so that a
                                        ///< new gesture is not kept waiting

double pixelsOf(const ViewTile& tile) {
    return static_cast<double>(tile.sizePixels.x) * static_cast<double>(tile.sizePixels.y);
}

glm::ivec2 scaled(const glm::ivec2& size, double scale) {
    return glm::max(glm::ivec2(glm::round(glm::dvec2(size) * scale)), glm::ivec2(1));
}

std::string cellState(const engine::PreparedTile& tile) {
    return tile.code + "|" + tile.message + "|" + std::to_string(std::lround(tile.progress * 100.0));
}

} // namespace

FramePlanner::FramePlanner(std::string viewer, std::string sheet, engine::Engine& engine, TileService& tiles,
                           SheetLevels& levels)
    : viewer_(std::move(viewer)), sheet_(std::move(sheet)), engine_(engine), tiles_(tiles), levels_(levels) {}

EncodeSettings FramePlanner::encoding(bool interactive) const {
    EncodeSettings settings;
    settings.format = interactive ? ImageFormat::Jpeg : ImageFormat::Png;
    settings.quality = 75;
    settings.subsampleChroma = interactive;
    settings.fast = true;
    return settings;
}

bool FramePlanner::isShown(const sheet::Address& cell, const std::string& identity, bool final) const {
    const auto shown = shown_.find(cell);
    return shown != shown_.end() && shown->second.identity == identity && (shown->second.final || !final);
}

FramePlan FramePlanner::plan(const ClientView& view, bool interactive) {
    FramePlan plan;
    plan.interactive = interactive;
    const auto workbook = engine_.snapshot();
    plan.workbookVersion = workbook->version;
    prepareVisible(*workbook, view, plan);
    chooseLevels(view, interactive);
    tellShown(*workbook, view);
    plan.visibleCells = visible_.size();
    for (const PlannedTile& tile : visible_) {
        if (isShown(tile.tile.cell, tile.prepared.identity, true))
            ++plan.finalCells;
        else
            plan.tiles.push_back(tile);
    }
    for (PlannedTile& tile : plan.tiles) {
        tile.image = tiles_.cached(encodedIdentity(tile.prepared.identity, encoding(false)));
        plan.pixels += pixelsOf(tile.tile);
    }
    // What is quick enough at full quality, and no gesture, needs no picture before the final one.
    if (!view.moving && quality_.fitsAtFullQuality(plan.pixels)) plan.interactive = false;
    if (plan.interactive)
        reduceQuality(plan);
    else
        keepChunk(plan);
    return plan;
}

FramePlan FramePlanner::planAll(const ClientView& view) {
    FramePlan plan;
    const auto workbook = engine_.snapshot();
    plan.workbookVersion = workbook->version;
    prepareVisible(*workbook, view, plan);
    chooseLevels(view, true);
    plan.visibleCells = visible_.size();
    plan.tiles = visible_;
    return plan;
}

void FramePlanner::prepareVisible(const sheet::Workbook& workbook, const ClientView& view, FramePlan& plan) {
    visible_.clear();
    for (const ViewTile& tile : view.tiles) {
        engine::TileQuality full;
        full.sizePixels = tile.sizePixels;
        full.live = true;
        full.crosshair = true;
        auto prepared = engine_.prepareTile(workbook, sheet_, tile.cell, view.overrides, full);
        if (prepared.spec) {
            visible_.push_back({tile, std::move(prepared), nullptr});
            continue;
        }
        const auto shown = shown_.find(tile.cell);
        if (shown == shown_.end() || shown->second.state != cellState(prepared))
            plan.notices.push_back(std::move(prepared));
    }
}

std::vector<CellOnShow> FramePlanner::cellsOnShow(const ClientView& view) const {
    std::vector<CellOnShow> cells;
    for (const PlannedTile& tile : visible_) {
        const engine::LevelNeeds& needs = tile.prepared.needs;
        CellOnShow cell;
        cell.cell = tile.tile.cell;
        cell.demand.volume = needs.volume;
        cell.demand.texelEdgePixels = needs.texelEdgePixels;
        cell.demand.pixels = pixelsOf(tile.tile);
        cell.demand.textureBytes = needs.textureBytes;
        cell.demand.further = needs.further;
        cell.demand.finest = needs.finest;
        cell.demand.pinned = needs.pinned;
        cell.demand.focused = view.focus == tile.tile.cell;
        cell.work = needs.work;
        if (const auto known = levelOf_.find(cell.cell); known != levelOf_.end())
            cell.previous = known->second;
        cells.push_back(std::move(cell));
    }
    return cells;
}

void FramePlanner::chooseLevels(const ClientView& view, bool interactive) {
    auto cells = cellsOnShow(view);
    const std::uint64_t budget = engine_.residency().budgetBytes;
    std::ostringstream demanded;
    demanded << levels_.revision() << ' ' << budget;
    for (const CellOnShow& cell : cells) {
        const CellDemand& demand = cell.demand;
        demanded << '\n'
                 << sheet::addressName(cell.cell) << ' ' << demand.volume << ' ' << demand.texelEdgePixels
                 << ' ' << demand.pixels << ' ' << demand.finest << ' ' << demand.pinned.value_or(-1) << ' '
                 << demand.focused;
        for (const FurtherVolume& further : demand.further)
            demanded << ' ' << further.volume;
    }
    const bool same = demanded.str() == demanded_;
    demanded_ = demanded.str();
    const auto levels = levels_.choose(std::move(cells), budget, !interactive, same);
    levelOf_.clear();
    for (std::size_t i = 0; i < visible_.size(); ++i) {
        visible_[i].prepared = engine_.atLevel(std::move(visible_[i].prepared), levels[i]);
        levelOf_[visible_[i].tile.cell] = levels[i];
    }
}

void FramePlanner::tellShown(const sheet::Workbook& workbook, const ClientView& view) {
    std::vector<WantedVolume> volumes;
    for (const PlannedTile& tile : visible_) {
        const auto each = engine_.volumesOf(*tile.prepared.spec, WantedPriority::Visible);
        volumes.insert(volumes.end(), each.begin(), each.end());
    }
    if (viewer_.empty() || volumes == shownVolumes_) return;
    shownVolumes_ = volumes;
    addNeighbours(workbook, view, volumes);
    engine_.setShown(viewer_, std::move(volumes));
}

void FramePlanner::addNeighbours(const sheet::Workbook& workbook, const ClientView& view,
                                 std::vector<WantedVolume>& volumes) const {
    if (view.tiles.empty() || visible_.empty()) return;
    sheet::Address low = view.tiles.front().cell;
    sheet::Address high = low;
    for (const auto& tile : view.tiles) {
        low = {std::min(low.column, tile.cell.column), std::min(low.row, tile.cell.row)};
        high = {std::max(high.column, tile.cell.column), std::max(high.row, tile.cell.row)};
    }
    // Most likely they will be drawn at the level of the last cell before them.
    const int level = visible_.back().prepared.spec->level;
    std::size_t added = 0;
    for (const auto& [cell, content] : sheet::sheetNamed(workbook, sheet_).cells) {
        const bool inside = cell.column >= low.column && cell.column <= high.column && cell.row >= low.row &&
                            cell.row <= high.row;
        const bool near = cell.column >= low.column - 1 && cell.column <= high.column + 1 &&
                          cell.row >= low.row - 1 && cell.row <= high.row + 1;
        if (inside || !near || content.source.empty()) continue;
        engine::TileQuality quality;
        quality.level = level;
        quality.live = true;
        quality.crosshair = true;
        const auto prepared = engine_.prepareTile(workbook, sheet_, cell, view.overrides, quality);
        if (!prepared.spec) continue;
        const auto each = engine_.volumesOf(*prepared.spec, WantedPriority::Soon);
        volumes.insert(volumes.end(), each.begin(), each.end());
        if (++added == kMostNeighbours) return;
    }
}

/// As many final pictures as fit the chunk; at least one.
void FramePlanner::keepChunk(FramePlan& plan) const {
    double pixels = 0.0;
    std::size_t count = 0;
    for (; count < plan.tiles.size(); ++count) {
        pixels += pixelsOf(plan.tiles[count].tile);
        if (count > 0 && quality_.predictedMs(pixels, 0) > kFinalChunkMs) break;
        plan.pixels = pixels;
    }
    plan.tiles.resize(count);
}

void FramePlanner::reduceQuality(FramePlan& plan) {
    plan.step = quality_.choose(plan.pixels);
    engine::TileQuality reduced;
    reduced.live = true;
    reduced.crosshair = true;
    reduced.sampleDistanceFactor = kQualitySteps[plan.step].sampleDistanceFactor;
    std::erase_if(plan.tiles, [&](PlannedTile& tile) {
        if (tile.image) return false; // the final picture is at hand: nothing is faster
        reduced.sizePixels = scaled(tile.tile.sizePixels, kQualitySteps[plan.step].scale);
        reduced.level = tile.prepared.spec->level;
        tile.prepared = engine_.atLevel(engine_.atQuality(tile.prepared, reduced), reduced.level);
        return isShown(tile.tile.cell, tile.prepared.identity, false);
    });
}

void FramePlanner::drawn(const FramePlan& plan, const PlannedTile& tile, const TilePixels& pixels) {
    if (plan.interactive || !pixels.error.empty() || pixels.standIn) return;
    const engine::LevelNeeds& needs = tile.prepared.needs;
    const auto ms =
        levels_.drawn({needs.volume, needs.work, static_cast<int>(needs.textureBytes.size()), pixels.level,
                       pixelsOf(tile.tile), pixels.renderMs, pixels.uploadMs + pixels.readMs});
    if (ms)
        timed_[tile.tile.cell] = {tile.prepared.identity, *ms * kTimedTilePixels / pixelsOf(tile.tile), true};
}

void FramePlanner::frameDrawn(const FramePlan& plan, double pixels, double ms) {
    quality_.measured(pixels, plan.step, ms);
}

void FramePlanner::pictureSent(const PlannedTile& tile) {
    // What stands in for a volume that is on its way is drawn again.
    shown_[tile.tile.cell] =
        Shown{tile.image->awaited ? std::string{} : tile.prepared.identity, {}, tile.image->final};
}

void FramePlanner::failureSent(const PlannedTile& tile, bool final) {
    shown_[tile.tile.cell] = Shown{tile.prepared.identity, cellState(tile.prepared), final};
}

void FramePlanner::stateSent(const engine::PreparedTile& tile) {
    shown_[tile.cell] = Shown{{}, cellState(tile), false};
}

std::string FramePlanner::kindOfWork() const {
    std::set<std::string> kinds;
    for (const PlannedTile& tile : visible_) {
        const auto& needs = tile.prepared.needs;
        // A tile's own size is taken out: T_N is stated for tiles of one size.
        const double edge = needs.texelEdgePixels / tile.tile.sizePixels.y;
        kinds.insert(needs.work + "@" +
                     (std::isfinite(edge) ? std::to_string(std::lround(std::log2(edge))) : "inside"));
    }
    std::string all;
    for (const std::string& kind : kinds)
        all += kind + ";";
    return all;
}

bool FramePlanner::rested() {
    Redraw redraw;
    redraw.n = static_cast<int>(visible_.size());
    bool known = true;
    bool anyFresh = false;
    for (const PlannedTile& tile : visible_) {
        const auto timed = timed_.find(tile.tile.cell);
        known = timed != timed_.end() && timed->second.identity == tile.prepared.identity;
        if (!known) break;
        redraw.ms += timed->second.ms;
        if (!timed->second.fresh) redraw.earlierMs += timed->second.ms;
        anyFresh = anyFresh || timed->second.fresh;
        redraw.coarsest = std::max(redraw.coarsest, tile.prepared.spec->level);
    }
    for (auto& [cell, timed] : timed_)
        timed.fresh = false;
    if (!known || !anyFresh) return false;
    redraw.kind = kindOfWork();
    redraw.residentBytes = engine_.residency().residentBytes;
    levels_.redrawn(redraw);
    return true;
}

} // namespace voxsheet::stream
