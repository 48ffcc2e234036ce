#include "stream/sheet_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxsheet::stream {

namespace {

constexpr std::size_t kMostCosts = 8192; ///< volumes and kinds of work; beyond it learning starts anew
constexpr int kMostLevels = 9;
constexpr double kExpectedSpread = 0.25; ///< until pictures were drawn again
constexpr double kSpreadMemory = 0.9;
constexpr double kCoarserAtMost = 0.9; ///< expected time of a level / that of the next finer one

/// Of the time of a picture at a level that has not been drawn yet, from one that has: a ray takes half the
/// samples at the next level, and some of its time stays.
double levelRatio(int from, int to) { return 0.3 + 0.7 * std::ldexp(1.0, from - to); }

std::string costKey(const std::string& volume, const std::string& work) { return volume + "|" + work; }

std::string inWords(const LevelSettings& settings) {
    return settings.policy == LevelPolicy::Focus
               ? "each cell is as fine as its picture can show, within the budgets"
               : "every cell is at full level";
}

} // namespace

SheetLevels::SheetLevels(const LevelSettings& settings, std::function<void()> changed)
    : changed_(std::move(changed)), settings_(settings), controller_(ruleOf(settings), kMostLevels),
      reason_(inWords(settings)), spread_(kExpectedSpread) {
    validateLevelSettings(settings);
}

bool SheetLevels::forAllCells(LevelPolicy policy) {
    return policy != LevelPolicy::Off && policy != LevelPolicy::Focus;
}

LevelSettings SheetLevels::settings() const {
    const std::lock_guard lock(mutex_);
    return settings_;
}

void SheetLevels::setSettings(const LevelSettings& settings) {
    validateLevelSettings(settings);
    {
        const std::lock_guard lock(mutex_);
        if (settings == settings_) return;
        const bool comparable = forAllCells(settings.policy) && forAllCells(settings_.policy);
        settings_ = settings;
        ++revision_;
        controller_.setRule(ruleOf(settings));
        // With a level per cell the times are those of another mixture.
        if (!comparable) {
            controller_.restart();
            redrawn_.clear();
        }
        newRedraw_ = true;
        reason_ = inWords(settings);
    }
    changed_();
}

std::vector<double> SheetLevels::expectedMs(const CellOnShow& cell) const {
    const int levels = cell.demand.levels();
    std::vector<double> ms(static_cast<std::size_t>(levels), 0.0);
    const auto found = costs_.find(costKey(cell.demand.volume, cell.work));
    if (found == costs_.end()) return ms;
    const Costs& known = found->second;
    for (int level = 0; level < levels; ++level) {
        int nearest = -1;
        for (int other = 0; other < static_cast<int>(known.size()); ++other)
            if (known[static_cast<std::size_t>(other)] > 0.0 &&
                (nearest < 0 || std::abs(other - level) < std::abs(nearest - level)))
                nearest = other;
        if (nearest >= 0)
            ms[static_cast<std::size_t>(level)] =
                cell.demand.pixels * known[static_cast<std::size_t>(nearest)] * levelRatio(nearest, level);
    }
    // Times waver: a coarser level that once seemed slower must not keep the sheet from getting there.
    for (std::size_t level = 1; level < ms.size(); ++level)
        ms[level] = std::min(ms[level], kCoarserAtMost * ms[level - 1]);
    return ms;
}

bool SheetLevels::decideCommonLevel(const std::vector<CellDemand>& demands) {
    const std::vector<int> full(demands.size(), 0);
    const SheetLoad load{static_cast<int>(demands.size()), sheetCost(demands, full).textureBytes};
    if (!newRedraw_ && judged_ == std::pair{load.n, load.levelZeroBytes}) return false;
    newRedraw_ = false;
    judged_ = {load.n, load.levelZeroBytes};
    int levels = 1;
    for (const CellDemand& demand : demands)
        levels = std::max(levels, demand.levels());
    controller_.setLevels(levels);
    const Decision decision = controller_.decide(load);
    reason_ = decision.reason;
    return decision.changed;
}

std::uint64_t SheetLevels::revision() const {
    const std::lock_guard lock(mutex_);
    return revision_;
}

std::vector<int> SheetLevels::choose(std::vector<CellOnShow> cells, std::uint64_t textureBudgetBytes,
                                     bool atRest, bool sameAsBefore) {
    std::vector<int> levels;
    bool changed = false;
    {
        const std::lock_guard lock(mutex_);
        std::vector<CellDemand> demands;
        std::vector<std::optional<int>> previous;
        for (CellOnShow& cell : cells) {
            cell.demand.ms = expectedMs(cell);
            demands.push_back(cell.demand);
            previous.push_back(cell.previous);
        }
        const bool known = std::all_of(previous.begin(), previous.end(),
                                       [](const std::optional<int>& level) { return level.has_value(); });
        if (settings_.policy == LevelPolicy::Focus && sameAsBefore && known) {
            for (const std::optional<int>& level : previous)
                levels.push_back(*level);
        } else if (settings_.policy == LevelPolicy::Focus) {
            levels = steadyFocusLevels(demands, previous, {settings_.frameMs, textureBudgetBytes},
                                       settings_.upFraction);
        } else {
            changed = atRest && forAllCells(settings_.policy) && decideCommonLevel(demands);
            levels = commonLevels(demands, controller_.level());
        }
        if (atRest) note(cells, demands, levels);
    }
    if (changed) changed_();
    return levels;
}

void SheetLevels::note(const std::vector<CellOnShow>& cells, const std::vector<CellDemand>& demands,
                       const std::vector<int>& levels) {
    onShow_.clear();
    for (std::size_t i = 0; i < cells.size(); ++i) {
        onShow_.push_back({cells[i].cell, levels[i],
                           footprintLevel(demands[i].texelEdgePixels, demands[i].levels()),
                           demands[i].pinned.has_value()});
    }
}

std::optional<double> SheetLevels::drawn(const DrawnPicture& picture) {
    const std::lock_guard lock(mutex_);
    if (costs_.size() > kMostCosts) costs_.clear();
    if (seen_.size() > kMostCosts) seen_.clear();
    const std::string key = costKey(picture.volume, picture.work);
    Costs& costs = costs_[key];
    costs.resize(static_cast<std::size_t>(std::max(picture.levels, picture.level + 1)), 0.0);
    double& known = costs[static_cast<std::size_t>(picture.level)];
    const double measured = picture.renderMs / std::max(1.0, picture.pixels);
    const int before = seen_[{key, picture.level}]++;
    if (before >= 2 && known > 0.0)
        spread_ = kSpreadMemory * spread_ + (1.0 - kSpreadMemory) * std::abs(measured / known - 1.0);
    known = before < 2 ? measured : 0.5 * (known + measured);
    if (warm_.insert(picture.work).second) return std::nullopt;
    return picture.renderMs + (before == 0 ? 0.0 : picture.swapMs);
}

void SheetLevels::redrawn(const Redraw& redraw) {
    const std::lock_guard lock(mutex_);
    if (redraw.n < 1 || !(redraw.ms > 0.0)) return;
    if (redraw.kind != kind_) {
        controller_.forgetTimes();
        redrawn_.clear();
        kind_ = redraw.kind;
    }
    // The spread is a mean deviation: two and a half of them make a 95 % interval. What slowed one of the
    // earlier pictures may have slowed all, so their doubts add up.
    if (redraw.earlierMs > 0.0)
        controller_.addPartialFrame(redraw.n, redraw.ms, 2.5 * spread_ * redraw.earlierMs);
    else
        controller_.addFrame(redraw.n, redraw.ms);
    redrawn_[{controller_.level(), redraw.n}] = {redraw.coarsest, redraw.residentBytes};
    newRedraw_ = true;
}

std::vector<TimingPoint> SheetLevels::pointsOf(int level) const {
    std::vector<TimingPoint> points;
    std::vector<TimePoint> curve;
    for (const TimePoint& point : controller_.times().curve(level, std::numeric_limits<int>::max())) {
        curve.push_back(point);
        const auto found = redrawn_.find({level, point.n});
        const Redrawn extra = found == redrawn_.end() ? Redrawn{level, 0} : found->second;
        points.push_back({point.n, extra.coarsest, point.ms, rawSlopeRatio(curve), newestSlopeRatio(curve),
                          extra.residentBytes, point.partly});
    }
    return points;
}

SheetTimings SheetLevels::timings() const {
    const std::lock_guard lock(mutex_);
    SheetTimings timings;
    timings.settings = settings_;
    timings.n = static_cast<int>(onShow_.size());
    timings.cells = onShow_;
    timings.reason = reason_;
    for (const CellLevel& cell : onShow_)
        timings.level = std::max(timings.level, cell.level);
    for (int level = 0; level < kMostLevels; ++level) {
        const auto points = pointsOf(level);
        for (const TimingPoint& point : points)
            if (level == controller_.level() && (point.n == timings.n || timings.n == 0)) timings.now = point;
        timings.points.insert(timings.points.end(), points.begin(), points.end());
    }
    return timings;
}

} // namespace voxsheet::stream
