#include "resolution/level_settings.h"

#include "base/errors.h"

#include <array>
#include <cmath>

namespace voxsheet {

namespace {

struct NamedPolicy {
    LevelPolicy policy;
    const char* name;
};

constexpr std::array<NamedPolicy, 8> kPolicies{{
    {LevelPolicy::Off, "off"},
    {LevelPolicy::Focus, "focus"},
    {LevelPolicy::Slope, "slope"},
    {LevelPolicy::SlopeFirst, "slope-first"},
    {LevelPolicy::Time, "time"},
    {LevelPolicy::Rate, "rate"},
    {LevelPolicy::Count, "count"},
    {LevelPolicy::Bytes, "bytes"},
}};

void positive(double value, const char* field, const char* what) {
    if (std::isfinite(value) && value > 0.0) return;
    throw InvalidInput(what, "it must be a number above 0", "give one, or leave it out").withField(field);
}

} // namespace

const char* levelPolicyName(LevelPolicy policy) {
    return kPolicies.at(static_cast<std::size_t>(policy)).name;
}

LevelPolicy levelPolicyFromName(std::string_view name) {
    for (const auto& row : kPolicies)
        if (row.name == name) return row.policy;
    std::string known;
    for (const auto& row : kPolicies)
        known += (known.empty() ? "" : ", ") + std::string(row.name);
    throw InvalidInput("policy of levels of detail", "there is no `" + std::string(name) + "`",
                       "choose one of " + known)
        .withField("policy");
}

std::vector<std::string> levelPolicyNames() {
    std::vector<std::string> names;
    for (const auto& row : kPolicies)
        names.emplace_back(row.name);
    return names;
}

void validateLevelSettings(const LevelSettings& settings) {
    positive(settings.frameMs, "frame_ms", "longest time of a frame");
    positive(settings.framesPerSecond, "frames_per_second", "fewest frames per second");
    positive(settings.datasets, "datasets", "number of datasets");
    positive(static_cast<double>(settings.bytes), "bytes", "number of bytes");
    positive(settings.upFraction, "up_fraction", "share for going back to a finer level");
    if (settings.upFraction > 1.0)
        throw InvalidInput("share for going back to a finer level", "it must be at most 1", "give 0.8")
            .withField("up_fraction");
}

} // namespace voxsheet
