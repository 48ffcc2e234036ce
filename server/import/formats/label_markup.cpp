#include "import/formats/label_markup.h"

#include "base/errors.h"
#include "import/formats/label_set.h"
#include "import/formats/number_text.h"
#include "import/formats/xml_walk.h"

#include <array>
#include <string>
#include <utility>

namespace voxsheet::import {

namespace {

constexpr std::string_view kNimlTable = "VALUE_LABEL_DTABLE";
constexpr std::size_t kMostLetters = 4096; // of a name or type in the file

/// NIML writes five characters, and the ends of lines, as XML does.
std::string unescaped(std::string_view text) {
    static constexpr std::array<std::pair<std::string_view, char>, 7> escapes{{{"&lt;", '<'},
                                                                               {"&gt;", '>'},
                                                                               {"&quot;", '"'},
                                                                               {"&apos;", '\''},
                                                                               {"&amp;", '&'},
                                                                               {"&#x0a;", '\n'},
                                                                               {"&#x0d;", '\r'}}};
    std::string result;
    while (!text.empty()) {
        std::size_t taken = 1;
        char letter = text[0];
        for (const auto& [escape, meant] : escapes)
            if (text.starts_with(escape)) {
                taken = escape.size();
                letter = meant;
            }
        result += letter;
        text.remove_prefix(taken);
    }
    return result;
}

/// The next string of NIML: within quotation marks of either kind, or up to the next white space; nothing
/// before a '<', at the end, or for marks that do not close.
std::optional<std::string> takeNimlString(std::string_view& text) {
    text = trimmed(text);
    if (text.empty() || text[0] == '<') return std::nullopt;
    const bool quoted = text[0] == '"' || text[0] == '\'';
    if (!quoted) {
        const auto end = std::min(text.find_first_of(" \t\r\n<"), text.size());
        auto word = unescaped(text.substr(0, end));
        text.remove_prefix(end);
        return word;
    }
    const auto end = text.find(text[0], 1);
    if (end == std::string_view::npos) return std::nullopt;
    auto word = unescaped(text.substr(1, end - 1));
    text.remove_prefix(end + 1);
    return word;
}

/// The labels of an atlas of FSL.
class AtlasParser {
public:
    AtlasParser()
        : walk_("atlas", {[this](auto& element, auto& attributes) { start(element, attributes); },
                          [this](auto& element) { end(element); },
                          [this](auto characters) {
                              if (text_.size() < kMostLetters) text_ += characters;
                          }}) {}

    /// Throws InvalidInput.
    void parse(std::string_view xml) { walk_.feed(xml, true); }

    [[nodiscard]] std::optional<LabelLookup> result() const {
        if (!isAtlas_) return std::nullopt;
        LabelSet labels;
        LabelLookup lookup;
        for (const auto& row : rows_) {
            auto value = row.value;
            if (!value && row.index && *row.index < (std::int64_t{1} << 53))
                value = *row.index + (probabilities_ ? 1 : 0);
            if (!value || !labels.add(*value, row.name, row.rgb)) ++lookup.linesLeftOut;
        }
        lookup.linesLeftOut += rowsBeyond_;
        lookup.labels = labels.list();
        return lookup;
    }

private:
    struct Row {
        std::optional<std::int64_t> value;
        std::optional<std::int64_t> index;
        std::optional<glm::dvec3> rgb;
        std::string name;
    };

    void start(const std::string& element, const XmlWalk::Attributes& attributes) {
        if (depth_++ == 0) isAtlas_ = element == "atlas";
        if (!isAtlas_) walk_.stop();
        text_.clear();
        if (element == "label")
            row_ = {parseInteger(valueOf(attributes, "value")),
                    parseInteger(valueOf(attributes, "index")),
                    hexColour(valueOf(attributes, "color")),
                    {}};
    }

    void end(const std::string& element) {
        --depth_;
        if (element == "type") probabilities_ = lowerCase(trimmed(text_)).starts_with("probabilistic");
        if (element != "label") return;
        row_.name = text_;
        if (rows_.size() < kMostLabels)
            rows_.push_back(row_);
        else
            ++rowsBeyond_;
    }

    XmlWalk walk_;
    int depth_ = 0;
    bool isAtlas_ = false;
    bool probabilities_ = false;
    std::string text_;
    Row row_;
    std::vector<Row> rows_;
    std::size_t rowsBeyond_ = 0;
};

} // namespace

std::optional<LabelLookup> parseNimlLabels(std::string_view text) {
    const auto begin = text.find("<" + std::string(kNimlTable));
    if (begin == std::string_view::npos) return std::nullopt;
    text.remove_prefix(begin);
    const auto head = text.find('>');
    if (head == std::string_view::npos || text.substr(0, head).ends_with('/')) return std::nullopt;
    text.remove_prefix(head + 1);
    LabelSet labels;
    LabelLookup lookup;
    while (const auto value = takeNimlString(text)) {
        const auto name = takeNimlString(text);
        const auto number = parseInteger(*value);
        if (!name || !number || !labels.add(*number, *name, std::nullopt)) ++lookup.linesLeftOut;
    }
    lookup.labels = labels.list();
    return lookup;
}

std::optional<LabelLookup> parseFslAtlas(std::string_view xml) {
    AtlasParser parser;
    try {
        parser.parse(xml);
    } catch (const InvalidInput&) { // something else, or damaged: no table of labels
        return std::nullopt;
    }
    return parser.result();
}

std::optional<LabelLookup> parseAfniAttributes(std::string_view xml) {
    const auto name = xml.find("atr_name=\"" + std::string(kNimlTable) + "\"");
    if (name == std::string_view::npos) return std::nullopt;
    xml.remove_prefix(name);
    const auto head = xml.find('>');
    if (head == std::string_view::npos) return std::nullopt;
    xml.remove_prefix(head + 1);
    const auto table = takeNimlString(xml);
    return table ? parseNimlLabels(*table) : std::nullopt;
}

} // namespace voxsheet::import
