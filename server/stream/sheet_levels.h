// The levels of detail of one sheet's cells, for all pages that show it: policy, what pictures cost, and the
// time-N curve from the redraws that happen anyway.
#pragma once

#include "resolution/level_policy.h"
#include "sheet/address.h"

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace voxsheet::stream {

/// One cell on show, as its level is chosen.
struct CellOnShow {
    sheet::Address cell;
    CellDemand demand;           ///< `ms` is filled in here
    std::string work;            ///< LevelNeeds::work
    std::optional<int> previous; ///< level that the page has it at now
};

/// One picture that was drawn at full quality of its level.
struct DrawnPicture {
    std::string volume;
    std::string work;
    int levels = 1;
    int level = 0;
    double pixels = 1.0;
    double renderMs = 0.0;
    double swapMs = 0.0; ///< upload and reading
};

/// A redraw of all n cells on show, or of some of them.
struct Redraw {
    int n = 0;
    double ms = 0.0;  ///< of all n, with every tile of kTimedTilePixels
    int coarsest = 0; ///< level among its cells
    std::string kind; ///< of what else its time depends on: curves of different kinds are not compared
    std::uint64_t residentBytes = 0;
    /// Part of `ms`: of pictures that were not dirty, from when they were drawn last.
    double earlierMs = 0.0;
};

/// Times are stated for tiles of this many pixels (256 x 256), so that a page that fits its tiles to its
/// window draws one curve.
inline constexpr double kTimedTilePixels = 65536.0;

struct CellLevel {
    sheet::Address cell;
    int level = 0;
    int footprint = 0; ///< the level that its size on the screen asks for
    bool pinned = false;
};

struct TimingPoint {
    int n = 0;
    int level = 0; ///< the coarsest of its cells
    MeasuredMedian ms;
    std::optional<double> rawRatio;
    std::optional<SlopeRatio> ratio;
    std::uint64_t residentBytes = 0;
    bool partly = false; ///< from redraws of some cells; no whole one has come yet
};

struct SheetTimings {
    LevelSettings settings;
    int n = 0;          ///< cells on show
    int level = 0;      ///< the coarsest of them
    std::string reason; ///< one sentence on why
    std::vector<CellLevel> cells;
    std::vector<TimingPoint> points; ///< by level, then N
    std::optional<TimingPoint> now;  ///< of the N and level on show; while nothing is: of the largest N
};

/// Thread-safe.
class SheetLevels {
public:
    /// `changed` is called, with no lock held, when cells may get other levels for a reason that is not in
    /// their page's view.
    SheetLevels(const LevelSettings& settings, std::function<void()> changed);

    [[nodiscard]] LevelSettings settings() const;
    /// Throws InvalidInput (with field); the old settings stay.
    void setSettings(const LevelSettings& settings);

    /// Grows with every change of the settings.
    [[nodiscard]] std::uint64_t revision() const;

    /// One level per cell.
    /// \param atRest  the rules for all cells judge at rest only
    /// \param sameAsBefore  nothing but what is known of costs has changed since `previous` was chosen: under
    /// Focus the levels then stay, so that a picture at rest is never drawn again
    [[nodiscard]] std::vector<int> choose(std::vector<CellOnShow> cells, std::uint64_t textureBudgetBytes,
                                          bool atRest, bool sameAsBefore);
    /// Returns the time that counts for T_N: the first picture of a volume at a level brings it in, which
    /// counts only when later ones have to do it again. Nothing for the first picture of a kind of work: it
    /// may have waited for shaders.
    std::optional<double> drawn(const DrawnPicture& picture);
    void redrawn(const Redraw& redraw);
    /// Asks all pages to have their levels chosen again, by what was told.
    void judge() { changed_(); }
    [[nodiscard]] SheetTimings timings() const;

private:
    using Costs = std::vector<double>; ///< ms per pixel by level; 0 = not known

    [[nodiscard]] static bool forAllCells(LevelPolicy policy);
    [[nodiscard]] std::vector<double> expectedMs(const CellOnShow& cell) const;
    [[nodiscard]] bool decideCommonLevel(const std::vector<CellDemand>& demands);
    void note(const std::vector<CellOnShow>& cells, const std::vector<CellDemand>& demands,
              const std::vector<int>& levels);
    [[nodiscard]] std::vector<TimingPoint> pointsOf(int level) const;

    std::function<void()> changed_;
    mutable std::mutex mutex_;
    LevelSettings settings_;
    std::uint64_t revision_ = 0;
    DynamicResolution controller_;
    std::string reason_;
    bool newRedraw_ = false;
    std::pair<int, std::uint64_t> judged_{0, 0}; ///< N and bytes that the controller was last asked about
    std::string kind_;
    std::unordered_map<std::string, Costs> costs_; ///< by volume and work
    double spread_; ///< by how much, relatively, pictures of one kind differ from one drawing to the next
    std::map<std::pair<std::string, int>, int> seen_; ///< pictures by volume with work, and level
    std::set<std::string> warm_;                      ///< kinds of work that have been done before
    struct Redrawn {
        int coarsest = 0;
        std::uint64_t residentBytes = 0;
    };
    std::map<std::pair<int, int>, Redrawn> redrawn_; ///< by the controller's level and N
    std::vector<CellLevel> onShow_;
};

} // namespace voxsheet::stream
