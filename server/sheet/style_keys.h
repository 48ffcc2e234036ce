// The one table of style keys: what can be set on a cell, row, column or sheet, in which unit, within which
// bounds. The workbook, the API, queries, `--set` and the page's inspector are all built from it.
#pragma once

#include "sheet/style_value.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace voxsheet::sheet {

enum class KeyType {
    Number,        ///< double in [min, max]
    Integer,       ///< std::int64_t in [min, max]
    Choice,        ///< std::string out of `choices`
    Colour,        ///< Colour
    Vector3,       ///< glm::dvec3, each component in [min, max]
    OpacityPoints, ///< OpacityStops: 1 to 256, positions in [0, 1] and not falling, opacities in [0, 1]
    ColourPoints,  ///< ColourStops: 1 to 256, positions in [0, 1] and not falling
    FieldName,     ///< std::string (a field's name) or std::int64_t (its index, from 0)
    NumberRows,    ///< NumberTable: minRows to maxRows rows of columnNames.size() numbers, each in [min, max]
    Colours,       ///< ColourList: 1 to 8, opaque
    Text,          ///< std::string: 1 to maxBytes bytes of UTF-8 without control characters
};

/// "number", "integer", "choice", "colour", "vector3", "opacityPoints", "colourPoints", "fieldName",
/// "numberRows", "colours", "text".
[[nodiscard]] const char* keyTypeName(KeyType type);

/// Whom a key belongs to: what one person looks at starts from the workbook but belongs to the page.
enum class KeyScope { View, Data };

/// The key only matters while another key has one of these values; for the inspector and the documentation.
struct KeyCondition {
    std::string key; ///< empty: always
    std::vector<std::string> values;
};

struct KeySpec {
    std::string name; ///< dotted
    KeyType type = KeyType::Number;
    std::string unit; ///< "degrees", "voxels", …; empty when it has none
    double min = 0.0; ///< inclusive; Number, Integer, Vector3, NumberRows
    double max = 0.0;
    std::vector<std::string> columnNames; ///< NumberRows
    std::size_t minRows = 1;              ///< NumberRows
    std::size_t maxRows = 1;
    std::size_t maxBytes = 200;           ///< Text
    std::vector<std::string> suggestions; ///< Text: words that mean something, for the inspector
    std::vector<std::string> choices;     ///< Choice
    bool takesNone = false;               ///< "none" is a value
    bool takesAuto = false;               ///< "auto" is a value
    StyleValue defaultValue;
    std::string group;  ///< heading in the inspector
    std::string widget; ///< "slider", "number", "select", "swatch", "curve", "vector", "text"
    std::string doc;    ///< one or two sentences
    KeyScope scope = KeyScope::Data;
    KeyCondition appliesWhen;
};

class KeyTable {
public:
    explicit KeyTable(std::vector<KeySpec> keys);

    /// In the order of the inspector.
    [[nodiscard]] const std::vector<KeySpec>& keys() const { return keys_; }
    /// nullptr if there is no such key.
    [[nodiscard]] const KeySpec* find(std::string_view name) const;
    /// Throws InvalidInput (field = name) that names the nearest key.
    [[nodiscard]] const KeySpec& at(std::string_view name) const;

private:
    std::vector<KeySpec> keys_;
};

/// The keys of this build. `colourMapNames` become the choices of transfer.map; the default is "auto", else
/// "viridis", else the first. Throws InvalidInput if the list is empty.
[[nodiscard]] KeyTable makeKeyTable(std::vector<std::string> colourMapNames);

/// A list of {name, type, unit, min, max, choices, takesNone, takesAuto, default, group, widget, doc, scope,
/// appliesWhen}; members that do not apply are left out.
[[nodiscard]] nlohmann::json describeKeys(const KeyTable& table);

/// All throw InvalidInput whose field() is the key and whose text names the bounds or choices.
void validateStyleValue(const KeySpec& key, const StyleValue& value);
[[nodiscard]] StyleValue parseStyleValue(const KeySpec& key, const nlohmann::json& value);
/// As in `--set KEY=VALUE` and queries: numbers, words, `0,0,1`, `0:0,0.3:0.1,1:0.8`, `0:#000000,1:#ffffff`;
/// or JSON.
[[nodiscard]] StyleValue parseStyleText(const KeySpec& key, std::string_view text);

/// A flat object of dotted keys; null resets. Throws InvalidInput (with field).
[[nodiscard]] StylePatch parseStylePatch(const KeyTable& table, const nlohmann::json& object);
/// A flat object of dotted keys without nulls: what a layer holds. Throws InvalidInput (with field).
[[nodiscard]] StyleMap parseStyleMap(const KeyTable& table, const nlohmann::json& object);
/// `KEY=VALUE`. An empty VALUE or `null` resets. Throws InvalidInput (with field).
[[nodiscard]] std::pair<std::string, std::optional<StyleValue>> parseAssignment(const KeyTable& table,
                                                                                std::string_view text);

} // namespace voxsheet::sheet
