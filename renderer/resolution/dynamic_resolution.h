// Dynamic resolution (Khanduja & Karki 2007, section 5): at which level of detail a sheet of N datasets is
// drawn. Pure arithmetic on what it is told: no clock, no GL.
#pragma once

#include "resolution/slope_rule.h"
#include "resolution/time_n.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace voxsheet {

enum class ResolutionCriterion {
    Off,        ///< the level stays
    Slope,      ///< the paper's rule: coarser when the slope of the time-N curve grows by more than 1.5
    SlopeFirst, ///< the same with a limit of 1.2, so that the paper's first transition counts as well
    Time,       ///< coarser when a frame takes longer than a limit
    Rate,       ///< coarser when there are fewer frames per second than a limit
    Count,      ///< coarser when more than a number of datasets are shown
    Bytes       ///< coarser when the datasets take more than a number of bytes
};

/// "off", "slope", "slope-first", "time", "rate", "count", "bytes".
[[nodiscard]] const char* resolutionCriterionName(ResolutionCriterion criterion);
[[nodiscard]] std::optional<ResolutionCriterion> resolutionCriterionFromName(std::string_view name);

struct ResolutionRule {
    ResolutionCriterion criterion = ResolutionCriterion::Slope;
    double frameMs = 1000.0;      ///< Time: the longest frame, > 0
    double framesPerSecond = 1.0; ///< Rate: the fewest, > 0
    int datasets = 25; ///< Count: the most at level 0, >= 1; a coarser level holds eight times as many
    std::uint64_t bytes = std::uint64_t{1} << 30; ///< Bytes: the most, > 0; a coarser level takes an eighth
    /// Hysteresis: a finer level comes back only when N (Slope, SlopeFirst, Count), the expected time (Time,
    /// Rate) or the bytes (Bytes) are below this share of where the coarser one began. (0, 1].
    double upFraction = 0.8;

    bool operator==(const ResolutionRule&) const = default;
};

/// What is to be shown.
struct SheetLoad {
    int n = 0;                        ///< datasets, each in a tile of equal size
    std::uint64_t levelZeroBytes = 0; ///< that their textures take at level 0 (Bytes only)
};

struct Decision {
    int level = 0; ///< of all cells from now on
    bool changed = false;
    std::string reason;              ///< one sentence for people
    std::optional<double> rawRatio;  ///< R of the newest three points of the curve that was judged
    std::optional<SlopeRatio> ratio; ///< fitted R with its confidence: of the bend, else of the newest points
};

/// A value: copies are independent, so that a caller may ask "what if".
///
/// Tell it frames as they are drawn (addFrame) and ask it when datasets were added or removed or a new frame
/// was told (decide). Times only count against each other while everything else that they depend on stays
/// the same: call forgetTimes() when tile size, technique or style change, and restart() when budgets do. A
/// machine that is busy while T_N is measured widens the intervals, and the level stays.
class DynamicResolution {
public:
    /// Starts at level 0. Throws InvalidInput if a number of the rule is out of its range, or levels < 1.
    /// \param levels  that every dataset has
    DynamicResolution(const ResolutionRule& rule, int levels);

    /// A frame of all n datasets, drawn at level(), took `ms`. Throws InvalidInput as TimeN::add.
    void addFrame(int n, double ms);
    /// As TimeN::addPartly, at level().
    void addPartialFrame(int n, double ms, double doubtMs);
    /// At most one level at a time towards the coarse or the fine (Slope, SlopeFirst, Time, Rate: the new
    /// level has to be measured before the next step; one step up per call), or straight to the level that
    /// the load asks for (Count, Bytes). N = 0 keeps the level.
    [[nodiscard]] Decision decide(const SheetLoad& load);

    /// Forgets the curves; keeps the level, and up to which N the finer levels kept the rule.
    void forgetTimes();
    /// As newly made.
    void restart();
    /// Another rule from now on; keeps level and times. Throws as the constructor.
    void setRule(const ResolutionRule& rule);
    /// Another number of levels: the level is clamped. Throws InvalidInput if levels < 1.
    void setLevels(int levels);

    [[nodiscard]] int level() const { return level_; }
    [[nodiscard]] const ResolutionRule& rule() const { return rule_; }
    [[nodiscard]] const TimeN& times() const { return times_; }
    /// Per level that was left for a coarser one by the slope rule: the last N that kept it.
    [[nodiscard]] const std::vector<std::optional<int>>& lastNOfLevel() const { return lastN_; }

private:
    [[nodiscard]] Decision stay(std::string reason) const;
    Decision moveTo(int level, std::string reason);
    [[nodiscard]] Decision decideBySlope(int n, double ratioLimit);
    [[nodiscard]] Decision decideByTime(int n, double limitMs);
    [[nodiscard]] Decision decideByAmount(double amount, double limitAtLevelZero, const char* what);
    [[nodiscard]] double expectedFinerMs(int n, double currentMs) const;

    ResolutionRule rule_;
    int levels_;
    int level_ = 0;
    TimeN times_;
    std::vector<std::optional<int>> lastN_;
    std::vector<SlopeWatch> watches_; ///< per level
};

} // namespace voxsheet
