#include "sheet/level_settings_json.h"

#include "base/errors.h"
#include "sheet/workbook.h"

#include <nlohmann/json.hpp>

namespace voxsheet::sheet {

nlohmann::ordered_json levelSettingsToJson(const LevelSettings& settings) {
    return {{"policy", levelPolicyName(settings.policy)},
            {"frame_ms", settings.frameMs},
            {"frames_per_second", settings.framesPerSecond},
            {"datasets", settings.datasets},
            {"bytes", settings.bytes},
            {"up_fraction", settings.upFraction}};
}

LevelSettings levelSettingsFromJson(const JsonReader& object, const LevelSettings& base) {
    object.allow({"policy", "frame_ms", "frames_per_second", "datasets", "bytes", "up_fraction"});
    LevelSettings settings = base;
    try {
        if (const auto policy = object.find("policy")) settings.policy = levelPolicyFromName(policy->text());
        if (const auto limit = object.find("frame_ms")) settings.frameMs = limit->number();
        if (const auto limit = object.find("frames_per_second")) settings.framesPerSecond = limit->number();
        if (const auto limit = object.find("datasets"))
            settings.datasets = static_cast<int>(limit->integer(1, static_cast<std::int64_t>(kMaxCells)));
        if (const auto limit = object.find("bytes"))
            settings.bytes = static_cast<std::uint64_t>(limit->integer(1, std::int64_t{1} << 60));
        if (const auto share = object.find("up_fraction")) settings.upFraction = share->number();
        validateLevelSettings(settings);
    } catch (const InvalidInput& error) {
        if (object.path().empty() || error.field().starts_with(object.path() + ".")) throw;
        // The rules of the settings know nothing of the document that they stand in.
        const std::string path = object.path() + "." + error.field();
        throw InvalidInput(path, error.why(), error.toDo()).withField(path);
    }
    return settings;
}

} // namespace voxsheet::sheet
