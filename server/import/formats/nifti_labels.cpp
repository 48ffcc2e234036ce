#include "import/formats/nifti_labels.h"

#include "base/errors.h"
#include "import/formats/label_markup.h"
#include "import/formats/label_set.h"
#include "import/formats/number_text.h"
#include "import/formats/xml_walk.h"

#include <algorithm>
#include <optional>
#include <span>

namespace voxsheet::import {

namespace {

constexpr std::size_t kMostBytes = 4U << 20; // of all extensions
constexpr std::size_t kMostLetters = 4096;   // of a name in the file

/// The first LabelTable of the XML; anything else is skipped.
class LabelTableParser {
public:
    explicit LabelTableParser(const std::string& name)
        : walk_(name, {[this](auto& element, auto& attributes) { start(element, attributes); },
                       [this](auto& element) { end(element); },
                       [this](auto characters) {
                           if (name_.size() < kMostLetters) name_ += characters;
                       }}) {}

    /// Throws InvalidInput.
    void parse(std::string_view xml) { walk_.feed(xml, true); }

    [[nodiscard]] const LabelSet& labels() const { return labels_; }
    [[nodiscard]] std::size_t leftOut() const { return leftOut_; }

private:
    void start(const std::string& element, const XmlWalk::Attributes& attributes) {
        if (element == "LabelTable" && ++tables_ > 1) walk_.stop();
        if (element != "Label" || tables_ != 1) return;
        name_.clear();
        key_ = parseInteger(valueOf(attributes, "Key"));
        rgb_ = colourOf(valueOf(attributes, "Red") + " " + valueOf(attributes, "Green") + " " +
                            valueOf(attributes, "Blue"),
                        1.0);
    }

    void end(const std::string& element) {
        if (element != "Label" || tables_ != 1) return;
        if (!key_ || !labels_.add(*key_, name_, rgb_)) ++leftOut_;
    }

    XmlWalk walk_;
    int tables_ = 0;
    std::optional<std::int64_t> key_;
    std::optional<glm::dvec3> rgb_;
    std::string name_;
    LabelSet labels_;
    std::size_t leftOut_ = 0;
};

/// What lies between the header and the voxels (the file's end, where those are in another file).
std::string extensionsOf(const InputFile& file, Compression compression, const NiftiHeader& header) {
    const std::size_t headerBytes = header.version == 1 ? kNifti1Bytes : kNifti2Bytes;
    std::size_t bytes = kMostBytes;
    if (header.singleFile && header.voxOffset < static_cast<double>(headerBytes + kMostBytes))
        bytes = header.voxOffset > static_cast<double>(headerBytes)
                    ? static_cast<std::size_t>(header.voxOffset) - headerBytes
                    : 0;
    std::string text;
    try {
        const auto stream = openStream(file, 0, compression);
        if (stream->skip(headerBytes) < headerBytes) return {};
        // In pieces, since an offset may lie about a small file.
        constexpr std::size_t piece = 16 * 1024;
        while (text.size() < bytes) {
            const auto before = text.size();
            const auto wanted = std::min(piece, bytes - before);
            text.resize(before + wanted);
            const auto got = stream->read(std::as_writable_bytes(std::span(text).subspan(before)));
            text.resize(before + got);
            if (got < wanted) break;
            if (before == 0 && text[0] == '\0') return {}; // "no extensions" (nifti1.h, nifti1_extender)
        }
    } catch (const InvalidInput&) { // damaged later on: the voxels will say so
    }
    return text;
}

std::int32_t integerAt(std::string_view bytes, std::size_t at, bool bigEndian) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value = (value << 8U) | static_cast<unsigned char>(bytes[at + (bigEndian ? i : 3 - i)]);
    return static_cast<std::int32_t>(value);
}

/// Nothing if the content is no table at all. A damaged one has no labels.
std::optional<LabelLookup> tableIn(std::string_view content, const std::string& fileName,
                                   std::vector<std::string>& notes) {
    if (const auto afni = parseAfniAttributes(content)) return afni;
    if (content.find("<CaretExtension") == std::string_view::npos) return std::nullopt;
    LabelTableParser parser(fileName);
    try {
        parser.parse(content);
    } catch (const InvalidInput& error) {
        notes.push_back("The table of labels in its header was left out: " + error.why() + ".");
        return LabelLookup{};
    }
    return LabelLookup{parser.labels().list(), parser.leftOut()};
}

} // namespace

std::vector<LabelMeta> niftiLabels(const InputFile& file, Compression compression, const NiftiHeader& header,
                                   std::vector<std::string>& notes) {
    constexpr std::size_t extender = 4; // bytes; the first says whether extensions follow
    constexpr std::size_t head = 8;     // of each: its size, head included, and its code
    const auto text = extensionsOf(file, compression, header);
    if (text.size() < extender || text[0] == '\0') return {};
    auto rest = std::string_view(text).substr(extender);
    while (rest.size() >= head) {
        const auto size = integerAt(rest, 0, header.bigEndian);
        if (size < static_cast<std::int32_t>(head) || static_cast<std::size_t>(size) > rest.size()) return {};
        auto content = rest.substr(head, static_cast<std::size_t>(size) - head);
        rest.remove_prefix(static_cast<std::size_t>(size));
        content = trimmed(content.substr(0, content.find('\0'))); // filled up to 16 bytes
        const auto table = tableIn(content, file.name(), notes);
        if (!table) continue;
        if (table->linesLeftOut > 0)
            notes.push_back(std::to_string(table->linesLeftOut) +
                            " labels of its header were left out: their values are missing or given twice.");
        return table->labels;
    }
    return {};
}

} // namespace voxsheet::import
