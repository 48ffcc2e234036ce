// How the levels of detail of a sheet's cells are chosen, as people set it: a policy and its limits.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace voxsheet {

enum class LevelPolicy {
    Off,   ///< level 0 for all
    Focus, ///< a level per cell: footprint, focus, budgets
    Slope, ///< the others: one level for all cells, by the criterion of that name (ResolutionCriterion)
    SlopeFirst,
    Time,
    Rate,
    Count,
    Bytes
};

/// "off", "focus", "slope", "slope-first", "time", "rate", "count", "bytes".
[[nodiscard]] const char* levelPolicyName(LevelPolicy policy);
/// Throws InvalidInput (field "policy") that lists the names.
[[nodiscard]] LevelPolicy levelPolicyFromName(std::string_view name);
[[nodiscard]] std::vector<std::string> levelPolicyNames();

struct LevelSettings {
    LevelPolicy policy = LevelPolicy::Focus;
    double frameMs = 1000.0;                      ///< Focus, Time: of a picture of the whole sheet at rest
    double framesPerSecond = 1.0;                 ///< Rate
    int datasets = 25;                            ///< Count
    std::uint64_t bytes = std::uint64_t{1} << 30; ///< Bytes
    double upFraction = 0.8; ///< all: a finer level comes back below this share of the limit, (0, 1]

    bool operator==(const LevelSettings&) const = default;
};

/// Throws InvalidInput whose field is the member's name in the API: frame_ms, frames_per_second, datasets,
/// bytes, up_fraction.
void validateLevelSettings(const LevelSettings& settings);

} // namespace voxsheet
