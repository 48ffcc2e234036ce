#include "import/formats/nrrd_header.h"

#include "base/errors.h"
#include "import/formats/file_pattern.h"
#include "import/formats/number_text.h"

#include <algorithm>
#include <array>
#include <utility>

namespace voxsheet::import {

namespace {

constexpr std::size_t kLargestHeaderBytes = 1U << 20;
constexpr std::size_t kMostAxes = 16; // NRRD_DIM_MAX

using Fields = std::map<std::string, std::string>;

/// The header's lines as fields; LIST file names go to header.dataFiles.
class FieldReader {
public:
    FieldReader(const InputFile& file, NrrdHeader& header) : name_(file.name()), header_(header) {
        const auto text = file.textAt(0, kLargestHeaderBytes);
        std::string_view rest(text);
        const auto magic = takeLine(rest).value_or("");
        if (!magic.starts_with("NRRD000") || magic.size() != 8 || magic[7] < '1' || magic[7] > '5')
            fail("the first line is not a NRRD version that is known (NRRD0001 to NRRD0005)");
        bool ended = false;
        while (!ended) {
            const auto line = takeLine(rest);
            if (!line) {
                if (text.size() == kLargestHeaderBytes) fail("the header is longer than 1 MiB");
                break;
            }
            ended = line->empty();
            if (!ended) readLine(*line, rest);
        }
        header_.dataOffset = text.size() - rest.size();
        attachedDataExist_ = ended;
    }

    [[nodiscard]] bool attachedDataExist() const { return attachedDataExist_; }

    /// The value of a field (name without blanks, lower case), or nothing.
    [[nodiscard]] std::optional<std::string> find(const std::string& field) const {
        const auto it = fields_.find(field);
        return it == fields_.end() ? std::nullopt : std::optional(it->second);
    }
    [[nodiscard]] std::string need(const std::string& field) const {
        const auto value = find(field);
        if (!value) fail("the header has no field '" + field + "'");
        return *value;
    }
    [[noreturn]] void fail(const std::string& why) const { throw InvalidInput(name_, why); }
    [[noreturn]] void failValue(const std::string& field, const std::string& value) const {
        fail("the field '" + field + "' cannot be '" + printable(value) + "'");
    }
    [[nodiscard]] const std::string& name() const { return name_; }

private:
    void readLine(std::string_view line, std::string_view& rest) {
        if (line[0] == '#') return;
        const auto colon = line.find(':');
        if (colon == std::string_view::npos) fail("the header line '" + printable(line) + "' is no field");
        if (colon + 1 < line.size() && line[colon + 1] == '=') {
            // A key/value pair: for people and other programs, but names of segments are for all.
            if (line.starts_with("Segment"))
                header_.keyValues.emplace(line.substr(0, colon), line.substr(colon + 2));
            return;
        }
        auto field = lowerCase(line.substr(0, colon));
        std::erase(field, ' ');
        const auto value = trimmed(line.substr(colon + 1));
        if (!fields_.emplace(alias(field), std::string(value)).second)
            fail("the field '" + printable(field) + "' is there twice");
        if (field == "datafile" && value.starts_with("LIST")) readList(rest);
    }

    void readList(std::string_view& rest) {
        while (const auto line = takeLine(rest)) {
            const auto entry = trimmed(*line);
            if (entry.empty()) continue;
            header_.dataFiles.emplace_back(entry);
            if (header_.dataFiles.size() > kMostDataFiles) fail("it lists too many data files");
        }
    }

    static std::string alias(const std::string& field) { return field == "centers" ? "centerings" : field; }

    std::string name_;
    NrrdHeader& header_;
    Fields fields_;
    bool attachedDataExist_ = false;
};

std::optional<ScalarType> nrrdType(const std::string& name) {
    static const std::map<std::string, ScalarType> types{{"signed char", ScalarType::I8},
                                                         {"int8", ScalarType::I8},
                                                         {"int8_t", ScalarType::I8},
                                                         {"uchar", ScalarType::U8},
                                                         {"unsigned char", ScalarType::U8},
                                                         {"uint8", ScalarType::U8},
                                                         {"uint8_t", ScalarType::U8},
                                                         {"short", ScalarType::I16},
                                                         {"short int", ScalarType::I16},
                                                         {"signed short", ScalarType::I16},
                                                         {"signed short int", ScalarType::I16},
                                                         {"int16", ScalarType::I16},
                                                         {"int16_t", ScalarType::I16},
                                                         {"ushort", ScalarType::U16},
                                                         {"unsigned short", ScalarType::U16},
                                                         {"unsigned short int", ScalarType::U16},
                                                         {"uint16", ScalarType::U16},
                                                         {"uint16_t", ScalarType::U16},
                                                         {"int", ScalarType::I32},
                                                         {"signed int", ScalarType::I32},
                                                         {"int32", ScalarType::I32},
                                                         {"int32_t", ScalarType::I32},
                                                         {"uint", ScalarType::U32},
                                                         {"unsigned int", ScalarType::U32},
                                                         {"uint32", ScalarType::U32},
                                                         {"uint32_t", ScalarType::U32},
                                                         {"longlong", ScalarType::I64},
                                                         {"long long", ScalarType::I64},
                                                         {"long long int", ScalarType::I64},
                                                         {"signed long long", ScalarType::I64},
                                                         {"signed long long int", ScalarType::I64},
                                                         {"int64", ScalarType::I64},
                                                         {"int64_t", ScalarType::I64},
                                                         {"ulonglong", ScalarType::U64},
                                                         {"unsigned long long", ScalarType::U64},
                                                         {"unsigned long long int", ScalarType::U64},
                                                         {"uint64", ScalarType::U64},
                                                         {"uint64_t", ScalarType::U64},
                                                         {"float", ScalarType::F32},
                                                         {"double", ScalarType::F64}};
    const auto it = types.find(name);
    return it == types.end() ? std::nullopt : std::optional(it->second);
}

void readTypeAndEncoding(const FieldReader& fields, NrrdHeader& header) {
    const auto typeName = lowerCase(fields.need("type"));
    if (typeName == "block") throw Unsupported(fields.name(), "NRRD blocks have no defined values");
    const auto type = nrrdType(typeName);
    if (!type) fields.failValue("type", typeName);
    header.type = *type;

    static const std::map<std::string, NrrdEncoding> encodings{
        {"raw", NrrdEncoding::Raw},     {"txt", NrrdEncoding::Ascii}, {"text", NrrdEncoding::Ascii},
        {"ascii", NrrdEncoding::Ascii}, {"hex", NrrdEncoding::Hex},   {"gz", NrrdEncoding::Gzip},
        {"gzip", NrrdEncoding::Gzip},   {"bz2", NrrdEncoding::Bzip2}, {"bzip2", NrrdEncoding::Bzip2}};
    const auto encodingName = lowerCase(fields.need("encoding"));
    const auto encoding = encodings.find(encodingName);
    if (encoding == encodings.end()) fields.failValue("encoding", encodingName);
    header.encoding = encoding->second;

    const auto endian = lowerCase(fields.find("endian").value_or(""));
    const bool matters = scalarBytes(header.type) > 1 && header.encoding != NrrdEncoding::Ascii;
    if (endian == "big")
        header.bigEndian = true;
    else if (endian != "little" && (matters || !endian.empty())) {
        if (endian.empty())
            fields.fail("the header does not say whether its values are little or big endian");
        fields.failValue("endian", endian);
    }
}

void readSkips(const FieldReader& fields, NrrdHeader& header) {
    if (const auto text = fields.find("lineskip")) {
        const auto skip = parseInteger(*text);
        if (!skip || *skip < 0) fields.failValue("line skip", *text);
        header.lineSkip = *skip;
    }
    if (const auto text = fields.find("byteskip")) {
        const auto skip = parseInteger(*text);
        if (!skip || *skip < -1) fields.failValue("byte skip", *text);
        header.byteSkip = *skip;
    }
    const bool text = header.encoding == NrrdEncoding::Ascii || header.encoding == NrrdEncoding::Hex;
    if (header.byteSkip == -1 && text) fields.fail("a byte skip of -1 has no meaning for text");
}

/// `"mm" "mm" "s"` as words without quotation marks.
std::vector<std::string> quotedWords(const std::string& text) {
    std::vector<std::string> words;
    for (auto begin = text.find('"'); begin != std::string::npos;) {
        const auto end = text.find('"', begin + 1);
        if (end == std::string::npos) break;
        words.push_back(text.substr(begin + 1, end - begin - 1));
        begin = text.find('"', end + 1);
    }
    return words;
}

/// The numbers of one finite vector "(x,y,z)" from the front of `text`, which it shortens; empty after
/// "none".
std::vector<double> takeVector(const FieldReader& fields, const std::string& field, std::size_t least,
                               std::size_t most, std::string_view& text) {
    const auto whole = std::string(text);
    text = trimmed(text);
    if (text.starts_with("none")) {
        text.remove_prefix(4);
        return {};
    }
    const auto end = text.find(')');
    if (!text.starts_with('(') || end == std::string_view::npos) fields.failValue(field, whole);
    std::string inner(text.substr(1, end - 1));
    text.remove_prefix(end + 1);
    const auto commas = std::count(inner.begin(), inner.end(), ',');
    std::replace(inner.begin(), inner.end(), ',', ' ');
    const auto numbers = parseNumbers(inner, static_cast<std::size_t>(commas) + 1);
    if (!numbers || numbers->size() < least || numbers->size() > most) fields.failValue(field, whole);
    return *numbers;
}

/// The part of a vector that lies in space.
glm::dvec3 spatialPart(const std::vector<double>& numbers) {
    glm::dvec3 part(0.0);
    for (std::size_t i = 0; i < std::min<std::size_t>(numbers.size(), 3); ++i)
        part[static_cast<int>(i)] = numbers[i];
    return part;
}

/// A direction along the time of the space makes its axis the time axis, with the direction's length as step.
void setDirection(const FieldReader& fields, const std::vector<double>& numbers, NrrdAxis& axis) {
    if (numbers.empty()) return;
    const auto part = spatialPart(numbers);
    const double time = numbers.size() == 4 ? numbers[3] : 0.0;
    if (time == 0.0) {
        axis.direction = part;
        return;
    }
    if (part != glm::dvec3(0.0))
        throw Unsupported(fields.name(), "an axis of it leads through space and time at once");
    axis.kind = "time";
    axis.spacing = time;
}

/// The long name without "-time", and whether it had that.
std::pair<std::string, bool> spaceName(const FieldReader& fields) {
    static const std::map<std::string, std::string> shortNames{
        {"ras", "right-anterior-superior"},      {"las", "left-anterior-superior"},
        {"lps", "left-posterior-superior"},      {"rast", "right-anterior-superior-time"},
        {"last", "left-anterior-superior-time"}, {"lpst", "left-posterior-superior-time"}};
    static const std::array<std::string_view, 7> known{"",
                                                       "right-anterior-superior",
                                                       "left-anterior-superior",
                                                       "left-posterior-superior",
                                                       "scanner-xyz",
                                                       "3d-right-handed",
                                                       "3d-left-handed"};
    const auto given = lowerCase(fields.find("space").value_or(""));
    const auto it = shortNames.find(given);
    auto space = it == shortNames.end() ? given : it->second;
    const bool withTime = space.ends_with("-time");
    if (withTime) space.resize(space.size() - 5);
    if (std::find(known.begin(), known.end(), space) == known.end() || (withTime && space.empty()))
        throw Unsupported(fields.name(), "the space '" + printable(given) + "' is not one that is known");
    return {space, withTime};
}

void readSpace(const FieldReader& fields, NrrdHeader& header) {
    const auto [space, withTime] = spaceName(fields);
    header.space = space;
    const std::size_t least = withTime ? 4 : 2;
    const std::size_t most = withTime ? 4 : 3;

    if (const auto text = fields.find("spaceunits")) {
        auto units = quotedWords(*text);
        if (withTime && units.size() == 4) units.pop_back();
        if (!units.empty() &&
            std::all_of(units.begin(), units.end(), [&](const auto& u) { return u == units[0]; }))
            header.spaceUnit = units[0];
    }
    if (const auto text = fields.find("spacedirections")) {
        std::string_view rest(*text);
        for (auto& axis : header.axes)
            setDirection(fields, takeVector(fields, "space directions", least, most, rest), axis);
        if (!trimmed(rest).empty()) fields.failValue("space directions", *text);
        header.hasDirections = true;
    }
    if (const auto text = fields.find("spaceorigin")) {
        std::string_view rest(*text);
        const auto origin = takeVector(fields, "space origin", least, most, rest);
        header.spaceOrigin = spatialPart(origin);
        for (auto& axis : header.axes)
            if (origin.size() == 4 && axis.kind == "time") axis.min = origin[3];
        if (!trimmed(rest).empty()) fields.failValue("space origin", *text);
    }
}

/// Per-axis numbers where "nan" stands for "none".
void readAxisNumbers(const FieldReader& fields, const std::string& field, NrrdHeader& header,
                     std::optional<double> NrrdAxis::*member) {
    const auto text = fields.find(field);
    if (!text) return;
    const auto words = splitWords(*text);
    if (words.size() != header.axes.size()) fields.failValue(field, *text);
    for (std::size_t axis = 0; axis < words.size(); ++axis) {
        const auto number = parseNumber(words[axis]);
        if (!number) fields.failValue(field, *text);
        header.axes[axis].*member = *number;
    }
}

void readAxes(const FieldReader& fields, NrrdHeader& header) {
    const auto dimensionText = fields.need("dimension");
    const auto dimension = parseInteger(dimensionText);
    if (!dimension || *dimension < 1 || *dimension > static_cast<std::int64_t>(kMostAxes))
        fields.failValue("dimension", dimensionText);
    header.axes.resize(static_cast<std::size_t>(*dimension));

    const auto sizesText = fields.need("sizes");
    const auto sizes = parseIntegers(sizesText, header.axes.size());
    if (!sizes) fields.failValue("sizes", sizesText);
    for (std::size_t axis = 0; axis < sizes->size(); ++axis)
        header.axes[axis].size = (*sizes)[axis];

    readAxisNumbers(fields, "spacings", header, &NrrdAxis::spacing);
    readAxisNumbers(fields, "axismins", header, &NrrdAxis::min);
    readAxisNumbers(fields, "axismaxs", header, &NrrdAxis::max);

    if (const auto text = fields.find("kinds")) {
        const auto words = splitWords(*text);
        if (words.size() != header.axes.size()) fields.failValue("kinds", *text);
        for (std::size_t axis = 0; axis < words.size(); ++axis)
            header.axes[axis].kind = lowerCase(words[axis]);
    }
    if (const auto text = fields.find("centerings")) {
        const auto words = splitWords(*text);
        if (words.size() != header.axes.size()) fields.failValue("centerings", *text);
        for (std::size_t axis = 0; axis < words.size(); ++axis)
            header.axes[axis].cell = lowerCase(words[axis]) == "cell";
    }
    if (const auto text = fields.find("units")) {
        const auto units = quotedWords(*text);
        for (std::size_t axis = 0; axis < std::min(units.size(), header.axes.size()); ++axis)
            header.axes[axis].unit = units[axis];
    }
}

void readDataFiles(const FieldReader& fields, NrrdHeader& header) {
    const auto value = fields.find("datafile");
    if (!value) {
        if (!fields.attachedDataExist())
            fields.fail("the header does not end with a blank line, and no data follow");
        return;
    }
    if (value->starts_with("LIST")) {
        if (header.dataFiles.empty()) fields.fail("its list of data files is empty");
    } else if (value->find('%') != std::string::npos && splitWords(*value).size() > 1) {
        const auto names = expandFilePattern(*value);
        if (!names) fields.failValue("data file", *value);
        header.dataFiles = *names;
    } else {
        header.dataFiles = {*value};
    }
}

} // namespace

NrrdHeader parseNrrdHeader(const InputFile& file) {
    NrrdHeader header;
    const FieldReader fields(file, header);
    readTypeAndEncoding(fields, header);
    readSkips(fields, header);
    readAxes(fields, header);
    readSpace(fields, header);
    header.sampleUnit = fields.find("sampleunits").value_or("");
    std::erase(header.sampleUnit, '"');
    readDataFiles(fields, header);
    return header;
}

} // namespace voxsheet::import
