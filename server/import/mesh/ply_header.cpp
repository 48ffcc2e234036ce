#include "import/mesh/ply_header.h"

#include "base/errors.h"
#include "import/formats/input_file.h"
#include "import/formats/number_text.h"
#include "import/mesh/word_cursor.h"

namespace voxsheet::import {

namespace {

std::optional<ScalarType> typeNamed(std::string_view name) {
    constexpr std::pair<std::string_view, ScalarType> types[] = {
        {"char", ScalarType::I8},    {"int8", ScalarType::I8},     {"uchar", ScalarType::U8},
        {"uint8", ScalarType::U8},   {"short", ScalarType::I16},   {"int16", ScalarType::I16},
        {"ushort", ScalarType::U16}, {"uint16", ScalarType::U16},  {"int", ScalarType::I32},
        {"int32", ScalarType::I32},  {"uint", ScalarType::U32},    {"uint32", ScalarType::U32},
        {"float", ScalarType::F32},  {"float32", ScalarType::F32}, {"double", ScalarType::F64},
        {"float64", ScalarType::F64}};
    for (const auto& [known, type] : types)
        if (known == name) return type;
    return std::nullopt;
}

class HeaderParser {
public:
    HeaderParser(std::string_view bytes, const std::string& file)
        : bytes_(bytes), lines_(bytes), file_(file) {}

    PlyHeader parse() {
        (void)lines_.line(); // "ply"
        bool encodingKnown = false;
        for (int count = 0; count < 10'000; ++count) {
            if (lines_.atEnd()) fail("it ends within the header");
            const auto words = splitWords(lines_.line());
            if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
            if (words[0] == "end_header") {
                if (!encodingKnown) fail("the header has no line 'format'");
                header_.bytes = bytes_.size() - lines_.rest().size();
                return std::move(header_);
            }
            if (words[0] == "format")
                encodingKnown = readEncoding(words);
            else if (words[0] == "element")
                readElement(words);
            else if (words[0] == "property")
                readProperty(words);
            else
                fail("'" + printable(words[0]) + "' is unknown in a header");
        }
        fail("the header has more than 10000 lines");
    }

private:
    using Words = std::vector<std::string_view>;

    bool readEncoding(const Words& words) {
        if (words.size() != 3 || words[2] != "1.0") fail("the format should be of version 1.0");
        if (words[1] == "ascii")
            header_.encoding = PlyEncoding::Ascii;
        else if (words[1] == "binary_little_endian")
            header_.encoding = PlyEncoding::LittleEndian;
        else if (words[1] == "binary_big_endian")
            header_.encoding = PlyEncoding::BigEndian;
        else
            fail("the format '" + printable(words[1]) + "' is unknown");
        return true;
    }

    void readElement(const Words& words) {
        const auto count = words.size() == 3 ? parseInteger(words[2]) : std::nullopt;
        if (!count || *count < 0) fail("an element needs a name and a count");
        header_.elements.push_back({std::string(words[1]), static_cast<std::uint64_t>(*count), {}});
    }

    void readProperty(const Words& words) {
        if (header_.elements.empty()) fail("a property stands before all elements");
        PlyProperty property;
        const bool isList = words.size() == 5 && words[1] == "list";
        if (!isList && words.size() != 3) fail("a property needs a type and a name");
        const auto type = typeNamed(words[isList ? 3 : 1]);
        const auto countType = typeNamed(words[isList ? 2 : 1]);
        if (!type || !countType) fail("the type of a property is unknown");
        if (isList && isFloat(*countType)) fail("the length of a list cannot be a fraction");
        property.type = *type;
        if (isList) property.countType = countType;
        property.name = words.back();
        header_.elements.back().properties.push_back(property);
    }

    [[noreturn]] void fail(const std::string& why) const {
        throw InvalidInput(file_, "PLY header, " + lines_.place() + ": " + why,
                           "the file is damaged: copy or write it again");
    }

    std::string_view bytes_;
    WordCursor lines_;
    const std::string& file_;
    PlyHeader header_;
};

void checkCounts(const PlyHeader& header, std::uint64_t fileBytes, const std::string& file) {
    const auto available = fileBytes - header.bytes + 1; // text may end without a line end
    for (const auto& element : header.elements) {
        if (element.properties.empty())
            throw InvalidInput(file, "its element '" + printable(element.name) + "' has no property",
                               "the file is damaged: copy or write it again");
        if (element.count > available / header.leastBytes(element))
            throw InvalidInput(file,
                               "its header says " + std::to_string(element.count) + " of '" +
                                   printable(element.name) + "', and the file has only " +
                                   std::to_string(fileBytes - header.bytes) + " bytes after the header",
                               "the file is probably truncated: copy or write it again");
    }
}

} // namespace

std::uint64_t PlyHeader::leastBytes(const PlyElement& element) const {
    std::uint64_t least = 0;
    for (const auto& property : element.properties)
        least += encoding == PlyEncoding::Ascii ? 2 : scalarBytes(property.countType.value_or(property.type));
    return least;
}

PlyHeader parsePlyHeader(std::string_view bytes, const std::string& file) {
    auto header = HeaderParser(bytes, file).parse();
    checkCounts(header, bytes.size(), file);
    return header;
}

} // namespace voxsheet::import
