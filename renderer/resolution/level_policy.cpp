#include "resolution/level_policy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace voxsheet {

namespace {

constexpr double kFocusWeight = 16.0;

/// In octaves of texel size, of which those below a pixel do not count.
double gainOfLevel(const CellDemand& cell, int level) {
    const auto blurOctaves = [&](int at) {
        return std::max(0.0, std::log2(std::ldexp(cell.texelEdgePixels, at)));
    };
    // An eye inside the volume sees texels without end: each level counts as an octave.
    const double octaves =
        std::isfinite(cell.texelEdgePixels) ? blurOctaves(level + 1) - blurOctaves(level) : 1.0;
    return cell.pixels * octaves * (cell.focused ? kFocusWeight : 1.0);
}

/// Level of a texture that a cell reads, and its bytes.
struct ReadTexture {
    std::pair<std::string_view, int> texture;
    std::uint64_t bytes;
};

ReadTexture furtherTexture(const FurtherVolume& further, int level) {
    const int own = std::min(level, static_cast<int>(further.textureBytes.size()) - 1);
    return {{further.volume, own}, further.textureBytes[static_cast<std::size_t>(own)]};
}

std::vector<ReadTexture> texturesRead(const CellDemand& cell, int level) {
    std::vector<ReadTexture> textures{
        {{cell.volume, level}, cell.textureBytes[static_cast<std::size_t>(level)]}};
    for (const FurtherVolume& further : cell.further)
        textures.push_back(furtherTexture(further, level));
    return textures;
}

bool movable(const CellDemand& cell, int level) { return !cell.pinned && level + 1 < cell.levels(); }

/// Lowering the finest cells of one volume together: only then does a texture go.
struct LoweringStep {
    std::vector<std::size_t> members; ///< all cells that show the volume
    std::vector<std::size_t> lowered; ///< empty: nothing is left to lower
    double ms = 0.0;                  ///< given back
    double bytes = 0.0;               ///< given back; negative where the coarser texture comes on top
    double gain = 0.0;                ///< of the pictures, lost
};

class Lowering {
public:
    Lowering(std::span<const CellDemand> cells, const SheetBudget& budget, std::vector<int> levels)
        : cells_(cells), budget_(budget), levels_(std::move(levels)) {
        const SheetCost cost = sheetCost(cells, levels_);
        ms_ = cost.ms;
        bytes_ = static_cast<double>(cost.textureBytes);
        std::map<std::string_view, std::size_t> known;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            for (const ReadTexture& read : texturesRead(cells[i], levels_[i]))
                ++readers_[read.texture];
            const auto [place, isNew] = known.emplace(cells[i].volume, steps_.size());
            if (isNew) steps_.emplace_back();
            steps_[place->second].members.push_back(i);
        }
        for (LoweringStep& step : steps_)
            prepare(step);
    }

    std::vector<int> run() {
        while (overTime() || overBytes()) {
            LoweringStep* step = cheapest();
            if (step == nullptr) {
                // What other steps gave back may have made one worth it that was not: they share layers.
                for (LoweringStep& each : steps_)
                    prepare(each);
                step = cheapest();
            }
            if (step == nullptr && !lowerTogether()) break;
            if (step == nullptr) continue;
            prepare(*step);
            take(*step);
            prepare(*step);
        }
        return std::move(levels_);
    }

private:
    bool overTime() const { return ms_ > budget_.frameMs; }
    bool overBytes() const { return bytes_ > static_cast<double>(budget_.textureBytes); }

    void prepare(LoweringStep& step) const {
        step.lowered.clear();
        int level = std::numeric_limits<int>::max();
        for (const std::size_t i : step.members) {
            if (!movable(cells_[i], levels_[i]) || levels_[i] > level) continue;
            if (levels_[i] < level) step.lowered.clear();
            level = levels_[i];
            step.lowered.push_back(i);
        }
        step.ms = step.gain = step.bytes = 0.0;
        if (step.lowered.empty()) return;
        const auto at = static_cast<std::size_t>(level);
        for (const std::size_t i : step.lowered) {
            if (!cells_[i].ms.empty()) step.ms += cells_[i].ms[at] - cells_[i].ms[at + 1];
            step.gain += gainOfLevel(cells_[i], level);
        }
        step.bytes = bytesGivenBack(step);
    }

    void take(const LoweringStep& step) {
        for (const std::size_t i : step.lowered)
            lower(i);
        ms_ -= step.ms;
        bytes_ -= step.bytes;
    }

    /// Cells that read each other's volumes give nothing back one by one: those of one level, the finest that
    /// helps, go together. False: it does not help either.
    bool lowerTogether() {
        if (!overBytes()) return false;
        std::map<int, LoweringStep> byLevel;
        for (const LoweringStep& step : steps_) {
            if (step.lowered.empty()) continue;
            LoweringStep& all = byLevel[levels_[step.lowered.front()]];
            all.lowered.insert(all.lowered.end(), step.lowered.begin(), step.lowered.end());
            all.ms += step.ms;
        }
        for (auto& [level, all] : byLevel) {
            all.bytes = bytesGivenBack(all);
            if (all.bytes <= 0.0) continue;
            take(all);
            for (LoweringStep& step : steps_)
                prepare(step);
            return true;
        }
        return false;
    }

    void lower(std::size_t cell) {
        for (const ReadTexture& read : texturesRead(cells_[cell], levels_[cell]))
            --readers_[read.texture];
        ++levels_[cell];
        for (const ReadTexture& read : texturesRead(cells_[cell], levels_[cell]))
            ++readers_[read.texture];
    }

    /// What nobody reads any more, less what nobody has read before.
    double bytesGivenBack(const LoweringStep& step) const {
        std::map<std::pair<std::string_view, int>, std::pair<int, std::uint64_t>> changes;
        for (const std::size_t i : step.lowered) {
            for (const ReadTexture& read : texturesRead(cells_[i], levels_[i]))
                changes.try_emplace(read.texture, 0, read.bytes).first->second.first -= 1;
            for (const ReadTexture& read : texturesRead(cells_[i], levels_[i] + 1))
                changes.try_emplace(read.texture, 0, read.bytes).first->second.first += 1;
        }
        double bytes = 0.0;
        for (const auto& [texture, change] : changes) {
            const auto found = readers_.find(texture);
            const int before = found == readers_.end() ? 0 : found->second;
            const int after = before + change.first;
            if (before > 0 && after == 0) bytes += static_cast<double>(change.second);
            if (before == 0 && after > 0) bytes -= static_cast<double>(change.second);
        }
        return bytes;
    }

    /// Of the exceeded budgets; 0 when the step does not help.
    double sharesGivenBack(const LoweringStep& step) const {
        double shares = 0.0;
        if (overTime()) shares += std::max(0.0, step.ms) / budget_.frameMs;
        if (overBytes())
            shares += std::max(0.0, step.bytes) / std::max(1.0, static_cast<double>(budget_.textureBytes));
        return shares;
    }

    LoweringStep* cheapest() {
        LoweringStep* best = nullptr;
        double least = std::numeric_limits<double>::infinity();
        for (LoweringStep& step : steps_) {
            const double shares = step.lowered.empty() ? 0.0 : sharesGivenBack(step);
            if (shares <= 0.0 || step.gain / shares >= least) continue;
            least = step.gain / shares;
            best = &step;
        }
        return best;
    }

    std::span<const CellDemand> cells_;
    SheetBudget budget_;
    std::vector<int> levels_;
    double ms_ = 0.0;
    double bytes_ = 0.0;
    std::map<std::pair<std::string_view, int>, int> readers_; ///< cells by texture
    std::vector<LoweringStep> steps_;                         ///< one per volume
};

} // namespace

ResolutionRule ruleOf(const LevelSettings& settings) {
    ResolutionRule rule;
    // Policies for all cells are named after their criterion; the others have none.
    rule.criterion =
        resolutionCriterionFromName(levelPolicyName(settings.policy)).value_or(ResolutionCriterion::Off);
    rule.frameMs = settings.frameMs;
    rule.framesPerSecond = settings.framesPerSecond;
    rule.datasets = settings.datasets;
    rule.bytes = settings.bytes;
    rule.upFraction = settings.upFraction;
    return rule;
}

int footprintLevel(double texelEdgePixels, int levels) {
    int level = 0;
    while (level + 1 < levels && std::ldexp(texelEdgePixels, level + 1) <= 1.0)
        ++level;
    return level;
}

std::vector<int> focusLevels(std::span<const CellDemand> cells, const SheetBudget& budget) {
    std::vector<int> levels;
    for (const CellDemand& cell : cells) {
        const int coarsest = cell.levels() - 1;
        const int wanted =
            cell.pinned.value_or(std::max(footprintLevel(cell.texelEdgePixels, cell.levels()), cell.finest));
        levels.push_back(std::clamp(wanted, 0, coarsest));
    }
    return Lowering(cells, budget, std::move(levels)).run();
}

std::vector<int> steadyFocusLevels(std::span<const CellDemand> cells,
                                   std::span<const std::optional<int>> previous, const SheetBudget& budget,
                                   double upFraction) {
    std::vector<int> levels = focusLevels(cells, budget);
    const SheetBudget tight{
        budget.frameMs * upFraction,
        static_cast<std::uint64_t>(static_cast<double>(budget.textureBytes) * upFraction)};
    const std::vector<int> tightLevels = focusLevels(cells, tight);
    for (std::size_t i = 0; i < levels.size(); ++i) {
        if (!previous[i] || cells[i].pinned) continue;
        levels[i] = std::clamp(*previous[i], levels[i], std::max(levels[i], tightLevels[i]));
    }
    return levels;
}

std::vector<int> commonLevels(std::span<const CellDemand> cells, int level) {
    std::vector<int> levels;
    for (const CellDemand& cell : cells)
        levels.push_back(
            std::clamp(cell.pinned.value_or(std::max(level, cell.finest)), 0, cell.levels() - 1));
    return levels;
}

SheetCost sheetCost(std::span<const CellDemand> cells, std::span<const int> levels) {
    SheetCost cost;
    std::set<std::pair<std::string_view, int>> textures;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto level = static_cast<std::size_t>(levels[i]);
        if (!cells[i].ms.empty()) cost.ms += cells[i].ms[level];
        for (const ReadTexture& read : texturesRead(cells[i], levels[i]))
            if (textures.insert(read.texture).second) cost.textureBytes += read.bytes;
    }
    return cost;
}

} // namespace voxsheet
