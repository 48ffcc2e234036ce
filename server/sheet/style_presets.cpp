#include "sheet/style_presets.h"

#include "base/errors.h"
#include "sheet/bounded_json.h"
#include "sheet/json_reader.h"
#include "sheet/near_miss.h"
#include "sheet/utf8.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace voxsheet::sheet {

std::vector<StylePreset> parseStylePresets(std::string_view text, const KeyTable& keys) {
    const auto document = parseBoundedJson(text, "style presets", {1U << 20U, 16});
    const JsonReader root(document);
    root.allow({"keys", "presets"});
    StylePatch resets;
    for (const JsonReader& key : root.at("keys").items())
        resets[keys.at(key.text()).name] = std::nullopt;
    std::vector<StylePreset> presets;
    for (const JsonReader& item : root.at("presets").items()) {
        item.allow({"name", "label", "doc", "style"});
        StylePreset preset{item.at("name").text(), item.at("label").text(), item.at("doc").text(), resets};
        for (const auto& [key, value] : parseStyleMap(keys, item.at("style").value())) {
            if (resets.count(key) == 0)
                item.refuse("it sets " + key + ", which presets do not reset", "add it to `keys`");
            preset.style[key] = value;
        }
        const bool taken = std::any_of(presets.begin(), presets.end(),
                                       [&](const StylePreset& other) { return other.name == preset.name; });
        if (taken) item.refuse("the name is taken", "choose another one");
        presets.push_back(std::move(preset));
    }
    return presets;
}

const StylePreset& presetNamed(const std::vector<StylePreset>& presets, std::string_view name) {
    std::vector<std::string> names;
    std::string list;
    for (const StylePreset& preset : presets) {
        if (preset.name == name) return preset;
        names.push_back(preset.name);
        list += (list.empty() ? "" : ", ") + preset.name;
    }
    const auto nearest = nearestName(name, names);
    throw NotFound("preset " + inQuotes(name), "there is no such preset",
                   nearest.empty() ? "choose one of: " + list : "did you mean \"" + nearest + "\"?")
        .withField("preset");
}

nlohmann::json describePresets(const std::vector<StylePreset>& presets) {
    auto list = nlohmann::json::array();
    for (const StylePreset& preset : presets) {
        auto style = nlohmann::json::object();
        for (const auto& [key, value] : preset.style)
            style[key] = value ? styleValueToJson(*value) : nlohmann::json(nullptr);
        list.push_back({{"name", preset.name},
                        {"label", preset.label},
                        {"doc", preset.doc},
                        {"style", std::move(style)}});
    }
    return list;
}

} // namespace voxsheet::sheet
