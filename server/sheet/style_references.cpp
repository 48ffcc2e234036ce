#include "sheet/style_references.h"

#include "base/errors.h"
#include "sheet/clip_shape.h"
#include "sheet/utf8.h"

#include <array>
#include <optional>

namespace voxsheet::sheet {

namespace {

constexpr std::array<const char*, 4> kNamingKeys{"clip.shape", "isosurface.colorBy", "layers",
                                                 "overlay.dataset"};
constexpr const char* kGone = "#REF!";

/// What takes the place of a name; nullopt: it stays as it was written.
using Replacement = std::function<std::optional<std::string>(const VolumeName&)>;

/// The blanks around the name stay.
std::string replacedName(std::string_view name, const char* key, const Replacement& replacement) {
    const auto first = name.find_first_not_of(' ');
    if (first == std::string_view::npos) return std::string(name);
    const auto last = name.find_last_not_of(' ');
    try {
        const auto with = replacement(parseVolumeName(name, key));
        if (!with) return std::string(name);
        return std::string(name.substr(0, first)) + *with + std::string(name.substr(last + 1));
    } catch (const InvalidInput&) {
        return std::string(name); // nothing that could move; the cell says what is wrong with it
    }
}

/// Whether the character ends a name of this key's value: names stand between semicolons, and before a
/// comparison.
bool endsName(char c, std::string_view key) {
    if (key == "layers") return c == ';';
    return key == "clip.shape" && (c == '<' || c == '>');
}

std::string rewritten(std::string_view value, const char* key, const Replacement& replacement) {
    std::string text;
    bool quoted = false;
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= value.size(); ++i) {
        const bool atEnd = i == value.size();
        if (!atEnd && value[i] == '\'') quoted = !quoted;
        if (!atEnd && (quoted || !endsName(value[i], key))) continue;
        text += replacedName(value.substr(begin, i - begin), key, replacement);
        if (atEnd) break;
        if (value[i] != ';') return text += value.substr(i); // a comparison with a number
        text += ';';
        begin = i + 1;
    }
    return text;
}

bool isAnalyticShape(const std::string& text) {
    try {
        return std::holds_alternative<AnalyticShape>(parseClipShape(text));
    } catch (const InvalidInput&) {
        return false;
    }
}

void rewriteNames(StyleMap& style, const Replacement& replacement) {
    for (const char* key : kNamingKeys) {
        const auto found = style.find(key);
        if (found == style.end()) continue;
        auto* text = std::get_if<std::string>(&found->second);
        if (text == nullptr || (key == kNamingKeys[0] && isAnalyticShape(*text))) continue;
        *text = rewritten(*text, key, replacement);
    }
}

} // namespace

void forEachStyle(Sheet& sheet, const std::function<void(StyleMap&)>& visit) {
    visit(sheet.style);
    for (auto& [line, header] : sheet.columnHeaders)
        visit(header.style);
    for (auto& [line, header] : sheet.rowHeaders)
        visit(header.style);
    for (auto& [address, cell] : sheet.cells)
        visit(cell.style);
}

void moveStyleReferences(StyleMap& style, const ReferenceMove& move) {
    rewriteNames(style, [&](const VolumeName& name) -> std::optional<std::string> {
        const auto* cell = std::get_if<SheetAddress>(&name);
        if (cell == nullptr) return std::nullopt;
        const auto moved = move(cell->sheet, {cell->cell, cell->cell});
        if (!moved) return kGone;
        if (moved->first == cell->cell) return std::nullopt;
        return addressName(SheetAddress{cell->sheet, moved->first});
    });
}

void renameSheetInStyle(StyleMap& style, std::string_view from, std::string_view to) {
    rewriteNames(style, [&](const VolumeName& name) -> std::optional<std::string> {
        const auto* cell = std::get_if<SheetAddress>(&name);
        if (cell == nullptr || cell->sheet.empty() || lowerAscii(cell->sheet) != lowerAscii(from))
            return std::nullopt;
        if (to.empty()) return kGone;
        return addressName(SheetAddress{std::string(to), cell->cell});
    });
}

void renameDatasetInStyle(StyleMap& style, std::string_view from, std::string_view to) {
    rewriteNames(style, [&](const VolumeName& name) -> std::optional<std::string> {
        const auto* dataset = std::get_if<std::string>(&name);
        if (dataset == nullptr || *dataset != from) return std::nullopt;
        return "'" + std::string(to) + "'";
    });
}

} // namespace voxsheet::sheet
