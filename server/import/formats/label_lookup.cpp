#include "import/formats/label_lookup.h"

#include "import/formats/label_markup.h"
#include "import/formats/label_set.h"
#include "import/formats/number_text.h"

#include <algorithm>
#include <string>

namespace voxsheet::import {

namespace {

struct Row {
    std::int64_t value = 0;
    std::string name;
    std::optional<glm::dvec3> rgb;
};

using Words = std::vector<std::string_view>;

/// Words `first`, `first` + 1, `first` + 2 as a colour from 0 to 255.
std::optional<glm::dvec3> colourAt(const Words& words, std::size_t first) {
    std::string numbers;
    for (std::size_t i = first; i < first + 3; ++i)
        numbers += std::string(words[i]) + " ";
    return colourOf(numbers, 255.0);
}

std::optional<Row> itkSnapRow(std::string_view line) {
    const auto open = line.find('"');
    const auto close = line.rfind('"');
    if (open == std::string_view::npos || close == open) return std::nullopt;
    const auto words = splitWords(line.substr(0, open));
    if (words.size() != 7 || !trimmed(line.substr(close + 1)).empty()) return std::nullopt;
    const auto value = parseInteger(words[0]);
    const auto rgb = colourAt(words, 1);
    const auto isNumber = [](std::string_view word) { return parseNumber(word).has_value(); };
    if (!value || !rgb || !std::all_of(words.begin() + 4, words.end(), isNumber)) return std::nullopt;
    return Row{*value, std::string(line.substr(open + 1, close - open - 1)), rgb};
}

std::optional<Row> freeSurferRow(std::string_view line) {
    constexpr std::size_t afterName = 4; // red, green, blue, opacity
    const auto words = splitWords(line);
    if (words.size() < 2 + afterName) return std::nullopt;
    const auto nameEnd = words.size() - afterName;
    const auto value = parseInteger(words[0]);
    const auto rgb = colourAt(words, nameEnd);
    if (!value || !rgb || !parseNumber(words.back()) || parseNumber(words[1])) return std::nullopt;
    std::string name(words[1]); // some tables have a short and a long name
    for (std::size_t i = 2; i < nameEnd; ++i)
        name += " " + std::string(words[i]);
    return Row{*value, name, rgb};
}

Words tabSeparated(std::string_view line) {
    Words cells;
    for (;;) {
        const auto tab = line.find('\t');
        cells.push_back(trimmed(line.substr(0, tab)));
        if (tab == std::string_view::npos) return cells;
        line.remove_prefix(tab + 1);
    }
}

/// Which columns of a tab-separated table say what.
class TsvColumns {
public:
    static std::optional<TsvColumns> from(std::string_view header) {
        const auto names = tabSeparated(header);
        TsvColumns columns;
        const auto find = [&](std::string_view name) {
            return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
        };
        columns.index_ = find("index");
        columns.name_ = find("name");
        columns.colour_ = find("color");
        if (columns.index_ == names.size() || columns.name_ == names.size()) return std::nullopt;
        return columns;
    }

    [[nodiscard]] std::optional<Row> row(std::string_view line) const {
        const auto cells = tabSeparated(line);
        if (cells.size() <= std::max(index_, name_)) return std::nullopt;
        const auto value = parseInteger(cells[index_]);
        if (!value) return std::nullopt;
        const bool coloured = colour_ < cells.size();
        return Row{*value, std::string(cells[name_]), coloured ? hexColour(cells[colour_]) : std::nullopt};
    }

private:
    std::size_t index_ = 0;
    std::size_t name_ = 0;
    std::size_t colour_ = 0; ///< beyond the last column: there is none
};

std::optional<std::string_view> nextLine(std::string_view& text) {
    while (const auto line = takeLine(text))
        if (const auto said = trimmed(*line); !said.empty() && said[0] != '#') return line;
    return std::nullopt;
}

template <typename RowOf>
LabelLookup readRows(std::string_view text, const RowOf& rowOf) {
    LabelSet labels;
    LabelLookup lookup;
    while (const auto line = nextLine(text)) {
        const auto row = rowOf(*line);
        if (!row || !labels.add(row->value, row->name, row->rgb)) ++lookup.linesLeftOut;
    }
    lookup.labels = labels.list();
    return lookup;
}

} // namespace

std::optional<LabelLookup> parseLabelLookup(std::string_view text) {
    auto rest = text;
    const auto first = nextLine(rest);
    if (!first) return std::nullopt;
    if (trimmed(*first).starts_with('<')) {
        const auto niml = parseNimlLabels(text);
        return niml ? niml : parseFslAtlas(trimmed(text));
    }
    if (const auto columns = TsvColumns::from(*first))
        return readRows(rest, [&](std::string_view line) { return columns->row(line); });
    if (itkSnapRow(*first)) return readRows(text, itkSnapRow);
    if (freeSurferRow(*first)) return readRows(text, freeSurferRow);
    return std::nullopt;
}

} // namespace voxsheet::import
