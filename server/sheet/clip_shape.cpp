#include "sheet/clip_shape.h"

#include "base/errors.h"
#include "sheet/number_text.h"
#include "sheet/utf8.h"

#include <algorithm>
#include <array>

namespace voxsheet::sheet {

namespace {

constexpr const char* kKey = "clip.shape";
constexpr std::array<std::string_view, 5> kShapes{"sphere", "ellipsoid", "box", "cylinder", "torus"};

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(' ');
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

[[noreturn]] void refuse(const std::string& key, std::string_view text, const std::string& why,
                         const std::string& toDo) {
    throw InvalidInput(key + " " + inQuotes(text), why, toDo).withField(key);
}

/// Where a comparison begins outside single quotes; npos: there is none.
std::size_t comparisonAt(std::string_view text) {
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\'') quoted = !quoted;
        if (!quoted && (text[i] == '<' || text[i] == '>')) return i;
    }
    return std::string_view::npos;
}

/// The name without its quotes; the text itself when it is not quoted as a whole.
std::string unquoted(std::string_view text) {
    const bool whole = text.size() >= 2 && text.front() == '\'' && text.back() == '\'' &&
                       text.substr(1, text.size() - 2).find('\'') == std::string_view::npos;
    return std::string(whole ? text.substr(1, text.size() - 2) : text);
}

ComparisonShape parseComparison(std::string_view text, std::size_t at) {
    const bool orEqual = at + 1 < text.size() && text[at + 1] == '=';
    ComparisonShape shape;
    if (text[at] == '>')
        shape.comparison = orEqual ? Comparison::GreaterOrEqual : Comparison::Greater;
    else
        shape.comparison = orEqual ? Comparison::LessOrEqual : Comparison::Less;
    const auto operand = trimmed(text.substr(0, at));
    const auto number = parseNumber(trimmed(text.substr(at + (orEqual ? 2 : 1))));
    if (!number)
        refuse(kKey, text, "there is no number after the comparison", "write a comparison such as B1 > 0.4");
    shape.operand = parseVolumeName(operand, kKey);
    shape.value = *number;
    return shape;
}

} // namespace

const char* comparisonSign(Comparison comparison) {
    switch (comparison) {
    case Comparison::Greater:
        return ">";
    case Comparison::GreaterOrEqual:
        return ">=";
    case Comparison::Less:
        return "<";
    case Comparison::LessOrEqual:
        break;
    }
    return "<=";
}

VolumeName parseVolumeName(std::string_view text, const std::string& key) {
    const auto name = trimmed(text);
    if (name.empty()) refuse(key, text, "no volume is named", "name a cell such as B1, or a dataset");
    if (name == "#REF!")
        refuse(key, text, "the cell that it named is gone",
               "name another cell or dataset, or set it to none");
    const auto plain = unquoted(name);
    if (plain.size() == name.size() && (looksLikeAddress(name) || name.find('!') != std::string_view::npos)) {
        try {
            return parseSheetAddress(name);
        } catch (const InvalidInput& error) {
            refuse(key, text, error.what(),
                   "name a cell such as B1, or put a dataset's name in single quotes");
        }
    }
    if (plain.empty()) refuse(key, text, "the name is empty", "name a cell such as B1, or a dataset");
    return plain;
}

std::vector<VolumeName> parseLayers(std::string_view text) {
    std::vector<VolumeName> names;
    bool quoted = false;
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= text.size(); ++i) {
        if (i < text.size() && text[i] == '\'') quoted = !quoted;
        if (i < text.size() && (quoted || text[i] != ';')) continue;
        names.push_back(parseVolumeName(text.substr(begin, i - begin), "layers"));
        begin = i + 1;
    }
    if (names.size() > kMaxLayerNames)
        refuse("layers", text, std::to_string(names.size()) + " volumes are named",
               "name at most " + std::to_string(kMaxLayerNames) + " besides the cell's own");
    return names;
}

ClipShape parseClipShape(std::string_view text) {
    const auto whole = trimmed(text);
    if (const auto at = comparisonAt(whole); at != std::string_view::npos) return parseComparison(whole, at);
    if (whole.empty())
        refuse(kKey, text, "it is empty",
               "give sphere, ellipsoid, box, cylinder, torus, a mesh, or B1 > 0.4; or none");
    const auto lower = lowerAscii(whole);
    if (std::find(kShapes.begin(), kShapes.end(), lower) != kShapes.end()) return AnalyticShape{lower};
    if (looksLikeAddress(whole))
        refuse(kKey, text, "a cell alone is no shape",
               "compare it with a number, as in " + std::string(whole) + " > 0.4");
    const auto dataset = unquoted(whole);
    if (dataset.empty())
        refuse(kKey, text, "the name is empty", "name a mesh's dataset, or a shape such as sphere");
    return DatasetShape{dataset};
}

} // namespace voxsheet::sheet
