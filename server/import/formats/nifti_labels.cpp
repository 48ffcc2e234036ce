#include "import/formats/nifti_labels.h"

#include "base/errors.h"
#include "import/formats/label_set.h"
#include "import/formats/number_text.h"

#include <algorithm>
#include <expat.h>
#include <memory>
#include <optional>
#include <span>

namespace voxsheet::import {

namespace {

constexpr std::size_t kMostBytes = 4U << 20; // of all extensions
constexpr std::size_t kMostLetters = 4096;   // of a name in the file

/// The first LabelTable of the XML; anything else is skipped.
class LabelTableParser {
public:
    LabelTableParser() : parser_(XML_ParserCreate(nullptr), XML_ParserFree) {
        XML_SetUserData(parser_.get(), this);
        XML_SetElementHandler(parser_.get(), onStart, onEnd);
        XML_SetCharacterDataHandler(parser_.get(), onText);
        XML_SetStartDoctypeDeclHandler(parser_.get(), onDoctype);
    }

    /// What is wrong with the XML; empty if nothing is.
    std::string parse(std::string_view xml) {
        const auto status = XML_Parse(parser_.get(), xml.data(), static_cast<int>(xml.size()), 1);
        if (status == XML_STATUS_OK || tables_ > 1) return {}; // stopped after the first table
        if (doctype_) return "it declares a document type";
        return "line " + std::to_string(XML_GetCurrentLineNumber(parser_.get())) + ": " +
               XML_ErrorString(XML_GetErrorCode(parser_.get()));
    }

    [[nodiscard]] const LabelSet& labels() const { return labels_; }
    [[nodiscard]] std::size_t leftOut() const { return leftOut_; }

private:
    static LabelTableParser& self(void* parser) { return *static_cast<LabelTableParser*>(parser); }

    static void onStart(void* parser, const XML_Char* name, const XML_Char** attributes) {
        self(parser).start(name, attributes);
    }
    static void onEnd(void* parser, const XML_Char* name) { self(parser).end(name); }
    static void onText(void* parser, const XML_Char* text, int length) {
        auto& name = self(parser).name_;
        if (name.size() < kMostLetters) name.append(text, static_cast<std::size_t>(length));
    }
    static void onDoctype(void* parser, const XML_Char*, const XML_Char*, const XML_Char*, int) {
        self(parser).doctype_ = true;
        XML_StopParser(self(parser).parser_.get(), XML_FALSE);
    }

    void start(std::string_view element, const XML_Char** attributes) {
        if (element == "LabelTable" && ++tables_ > 1) XML_StopParser(parser_.get(), XML_FALSE);
        if (element != "Label" || tables_ != 1) return;
        name_.clear();
        key_.reset();
        std::string red;
        std::string green;
        std::string blue;
        for (; attributes[0]; attributes += 2) {
            const std::string_view attribute = attributes[0];
            if (attribute == "Key") key_ = parseInteger(attributes[1]);
            if (attribute == "Red") red = attributes[1];
            if (attribute == "Green") green = attributes[1];
            if (attribute == "Blue") blue = attributes[1];
        }
        rgb_ = colourOf(red + " " + green + " " + blue, 1.0);
    }

    void end(std::string_view element) {
        if (element != "Label" || tables_ != 1) return;
        if (!key_ || !labels_.add(*key_, name_, rgb_)) ++leftOut_;
    }

    std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_;
    bool doctype_ = false;
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
        if (content.find("<CaretExtension") == std::string_view::npos) continue;
        LabelTableParser parser;
        if (const auto wrong = parser.parse(content); !wrong.empty()) {
            notes.push_back("The table of labels in its header was left out: " + printable(wrong) + ".");
            return {};
        }
        if (parser.leftOut() > 0)
            notes.push_back(std::to_string(parser.leftOut()) +
                            " labels of its header were left out: their values are missing or given twice.");
        return parser.labels().list();
    }
    return {};
}

} // namespace voxsheet::import
