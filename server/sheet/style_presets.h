// Named looks: patches of style that give a defined picture whatever was set before.
#pragma once

#include "sheet/style_keys.h"

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace voxsheet::sheet {

struct StylePreset {
    std::string name;  ///< as in `--preset`
    std::string label; ///< for people
    std::string doc;   ///< one sentence
    StylePatch style;  ///< sets the preset's own keys and resets all others that some preset sets
};

/// {"keys": [names], "presets": [{"name", "label", "doc", "style": {KEY: VALUE}}]}; `keys` are those that
/// presets reset. Throws InvalidInput (with field) if a key or value is not of the table, a preset sets a key
/// that is not listed, or two presets have one name.
[[nodiscard]] std::vector<StylePreset> parseStylePresets(std::string_view text, const KeyTable& keys);

/// Throws NotFound (field preset) that names the nearest.
[[nodiscard]] const StylePreset& presetNamed(const std::vector<StylePreset>& presets, std::string_view name);

/// A list of {name, label, doc, style}, null for keys that are reset.
[[nodiscard]] nlohmann::json describePresets(const std::vector<StylePreset>& presets);

} // namespace voxsheet::sheet
