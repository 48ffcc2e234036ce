#include "import/vtk_legacy/legacy_vtk_header.h"

#include "base/errors.h"
#include "import/formats/number_text.h"
#include "import/vtk_legacy/text_cursor.h"

#include <array>
#include <optional>
#include <utility>

namespace voxsheet::import {

namespace {

struct NumberType {
    std::string_view name;
    ScalarType binary;
    ScalarType text;
};

// vtkIdType is written as 32-bit integers in binary files, whatever it is in memory.
constexpr std::array<NumberType, 16> kTypes{{
    {"unsigned_char", ScalarType::U8, ScalarType::U8},
    {"char", ScalarType::I8, ScalarType::I8},
    {"signed_char", ScalarType::I8, ScalarType::I8},
    {"unsigned_short", ScalarType::U16, ScalarType::U16},
    {"short", ScalarType::I16, ScalarType::I16},
    {"unsigned_int", ScalarType::U32, ScalarType::U32},
    {"int", ScalarType::I32, ScalarType::I32},
    {"unsigned_long", ScalarType::U64, ScalarType::U64},
    {"long", ScalarType::I64, ScalarType::I64},
    {"unsigned_long_long", ScalarType::U64, ScalarType::U64},
    {"long_long", ScalarType::I64, ScalarType::I64},
    {"vtktypeuint64", ScalarType::U64, ScalarType::U64},
    {"vtktypeint64", ScalarType::I64, ScalarType::I64},
    {"vtkidtype", ScalarType::I32, ScalarType::I64},
    {"float", ScalarType::F32, ScalarType::F32},
    {"double", ScalarType::F64, ScalarType::F64},
}};

/// VTK writes blanks and other special characters of names as %XX.
std::string decodedName(std::string_view name) {
    const auto digit = [](char c) {
        if (c >= '0' && c <= '9') return c - '0';
        if (c >= 'a' && c <= 'f') return c - 'a' + 10;
        if (c >= 'A' && c <= 'F') return c - 'A' + 10;
        return -1;
    };
    std::string text;
    for (std::size_t i = 0; i < name.size(); ++i) {
        const bool coded =
            name[i] == '%' && i + 2 < name.size() && digit(name[i + 1]) >= 0 && digit(name[i + 2]) >= 0;
        text += coded ? static_cast<char>(digit(name[i + 1]) * 16 + digit(name[i + 2])) : name[i];
        if (coded) i += 2;
    }
    return text;
}

class LegacyParser {
public:
    explicit LegacyParser(const InputFile& file) : file_(file), cursor_(file) {}

    LegacyVtkHeader parse() {
        parseTop();
        while (const auto text = cursor_.lineWithText()) {
            const auto words = splitWords(*text);
            parseKeyword(lowerCase(words[0]), words);
        }
        if (!haveDims_) damaged("it has no line DIMENSIONS");
        if (rectilinear_ && header_.coordinates.size() != 3)
            damaged("it has not three arrays of coordinates");
        return std::move(header_);
    }

private:
    [[noreturn]] void damaged(const std::string& why) const {
        throw InvalidInput(file_.name(), why, "the file is damaged or incomplete: copy or write it again");
    }

    void parseTop() {
        const auto version = cursor_.line();
        const auto title = cursor_.line();
        const auto encoding = cursor_.lineWithText();
        if (!version || !title || !encoding) damaged("it ends within its header");
        const auto word = lowerCase(trimmed(*encoding));
        if (word != "ascii" && word != "binary")
            damaged("its third line is neither ASCII nor BINARY but '" + printable(*encoding) + "'");
        header_.binary = word == "binary";
    }

    void parseKeyword(const std::string& keyword, const std::vector<std::string_view>& words) {
        if (keyword == "dataset") return parseDataset(words);
        if (keyword == "dimensions") return parseDimensions(words);
        if (keyword == "spacing" || keyword == "aspect_ratio") return parseVector(words, header_.spacing);
        if (keyword == "origin") return parseVector(words, header_.origin);
        if (keyword == "point_data") return startAttributes(words, LegacyAttribute::Point);
        if (keyword == "cell_data") return startAttributes(words, LegacyAttribute::Cell);
        if (keyword == "metadata") return skipMetadata();
        if (keyword == "x_coordinates") return parseCoordinates(words, 0);
        if (keyword == "y_coordinates") return parseCoordinates(words, 1);
        if (keyword == "z_coordinates") return parseCoordinates(words, 2);
        if (keyword == "field") return parseFieldArrays(words);
        parseAttribute(keyword, words);
    }

    void parseDataset(const std::vector<std::string_view>& words) {
        const auto kind = words.size() > 1 ? lowerCase(words[1]) : std::string();
        rectilinear_ = kind == "rectilinear_grid";
        if (rectilinear_ || kind == "structured_points") return;
        throw Unsupported(
            file_.name(), "it holds a VTK data set of the kind '" + printable(kind) + "'",
            "only structured points (images) and rectilinear grids can be read from .vtk files");
    }

    void parseCoordinates(const std::vector<std::string_view>& words, std::size_t axis) {
        const auto count = words.size() > 1 ? parseInteger(words[1]) : std::nullopt;
        if (!rectilinear_ || !haveDims_ || header_.coordinates.size() != axis || words.size() < 3 || !count ||
            *count != header_.dims[static_cast<int>(axis)])
            damaged("the line " + printable(words[0]) + " does not fit its dimensions");
        const auto type = numberType(words[0], words[2]);
        header_.coordinates.push_back(
            {std::string(words[0]), LegacyAttribute::Point, type, 1, false, cursor_.position()});
        components_ = 1;
        skipNumbers(type, static_cast<std::uint64_t>(*count), printable(words[0]));
    }

    void parseDimensions(const std::vector<std::string_view>& words) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto n = words.size() > axis + 1 ? parseInteger(words[axis + 1]) : std::nullopt;
            if (!n || *n < 1 || *n > (1 << 24)) damaged("its dimensions are not three whole numbers above 0");
            header_.dims[static_cast<int>(axis)] = static_cast<int>(*n);
        }
        const auto& n = header_.dims;
        if (double(n.x) * n.y * n.z > 0x1p40) // beyond any grid, and products of it would overflow
            throw LimitExceeded(file_.name(), "its dimensions give more than 2^40 points",
                                "the file is probably damaged");
        haveDims_ = true;
    }

    void parseVector(const std::vector<std::string_view>& words, glm::dvec3& vector) const {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto number = words.size() > axis + 1 ? parseNumber(words[axis + 1]) : std::nullopt;
            if (!number) damaged("the line " + printable(words[0]) + " has not three numbers");
            vector[static_cast<int>(axis)] = *number;
        }
    }

    void startAttributes(const std::vector<std::string_view>& words, LegacyAttribute attribute) {
        const auto count = words.size() > 1 ? parseInteger(words[1]) : std::nullopt;
        const auto dims = attribute == LegacyAttribute::Point ? header_.dims : cellDims(header_.dims);
        const auto expected = static_cast<std::int64_t>(dims.x) * dims.y * dims.z;
        if (!haveDims_ || !count || *count != expected)
            damaged("the line " + printable(words[0]) + " says " +
                    (words.size() > 1 ? printable(words[1]) : "nothing") + " where the dimensions give " +
                    std::to_string(expected));
        attribute_ = attribute;
        tuples_ = static_cast<std::uint64_t>(expected);
    }

    void parseAttribute(const std::string& keyword, const std::vector<std::string_view>& words) {
        const auto word = [&](std::size_t i) { return i < words.size() ? words[i] : std::string_view(); };
        const auto count = [&](std::size_t i, std::int64_t low, std::int64_t high) {
            const auto n = parseInteger(word(i));
            if (!n || *n < low || *n > high)
                damaged("the line " + printable(words[0]) + " has a wrong number");
            return static_cast<int>(*n);
        };
        if (keyword == "lookup_table") { // a table of RGBA, no array of the data
            const auto entries = static_cast<std::uint64_t>(count(2, 0, 1 << 24));
            return skipNumbers(ScalarType::U8, entries * 4, "the lookup table");
        }
        if (!attribute_) damaged("'" + printable(words[0]) + "' stands before POINT_DATA and CELL_DATA");
        const auto name = decodedName(word(1));
        if (keyword == "scalars") {
            const int components = words.size() > 3 ? count(3, 1, 4) : 1;
            const auto table = cursor_.lineWithText();
            if (!table || lowerCase(splitWords(*table)[0]) != "lookup_table")
                damaged("no LOOKUP_TABLE follows the line SCALARS");
            addArray(name, word(2), components);
        } else if (keyword == "color_scalars") {
            addArray(name, header_.binary ? "unsigned_char" : "float", count(2, 1, 1024), true);
        } else if (keyword == "vectors" || keyword == "normals") {
            addArray(name, word(2), 3);
        } else if (keyword == "tensors" || keyword == "tensors6") {
            addArray(name, word(2), keyword == "tensors" ? 9 : 6);
        } else if (keyword == "texture_coordinates") {
            addArray(name, word(3), count(2, 1, 3), true);
        } else if (keyword == "global_ids" || keyword == "pedigree_ids" || keyword == "edge_flags") {
            addArray(name, word(2), 1);
        } else {
            damaged("there is a line that no legacy VTK file has: '" + printable(words[0]) + "'");
        }
    }

    void parseFieldArrays(const std::vector<std::string_view>& words) {
        const auto arrays = words.size() > 2 ? parseInteger(words[2]) : std::nullopt;
        if (!arrays || *arrays < 0 || *arrays > 4096)
            damaged("the line FIELD does not say how many arrays follow");
        for (std::int64_t i = 0; i < *arrays; ++i) {
            auto text = cursor_.lineWithText();
            while (text && lowerCase(trimmed(*text)) == "metadata") {
                skipMetadata();
                text = cursor_.lineWithText();
            }
            const auto parts = text ? splitWords(*text) : std::vector<std::string_view>();
            if (parts.size() < 4) damaged("an array of its FIELD is missing or has no name, size and type");
            const auto components = parseInteger(parts[1]);
            const auto tuples = parseInteger(parts[2]);
            if (!components || !tuples || *components < 1 || *components > 1024 || *tuples < 0 ||
                *tuples > (1LL << 40))
                damaged("the array '" + printable(parts[0]) + "' has impossible sizes");
            if (attribute_ && static_cast<std::uint64_t>(*tuples) == tuples_) {
                addArray(decodedName(parts[0]), parts[3], static_cast<int>(*components));
            } else {
                const auto type = numberType(parts[0], parts[3]);
                components_ = static_cast<int>(*components);
                skipNumbers(type, static_cast<std::uint64_t>(*components * *tuples), printable(parts[0]));
            }
        }
    }

    [[nodiscard]] ScalarType numberType(std::string_view array, std::string_view name) const {
        const auto lower = lowerCase(name);
        for (const auto& type : kTypes)
            if (type.name == lower) return header_.binary ? type.binary : type.text;
        if (lower == "bit" || lower == "string" || lower == "utf8_string" || lower == "variant")
            throw Unsupported(file_.name(),
                              "its array '" + printable(array) + "' holds values of the type " + lower,
                              "write the file without that array");
        damaged("the array '" + printable(array) + "' has the type '" + printable(name) + "', which is none");
    }

    void addArray(const std::string& name, std::string_view typeName, int components, bool colours = false) {
        const auto type = numberType(name, typeName);
        header_.arrays.push_back({name, *attribute_, type, components, colours, cursor_.position()});
        components_ = components;
        skipNumbers(type, tuples_ * static_cast<std::uint64_t>(components), "'" + printable(name) + "'");
    }

    void skipNumbers(ScalarType type, std::uint64_t count, const std::string& what) {
        const bool whole =
            header_.binary ? cursor_.skipBytes(count * scalarBytes(type)) : cursor_.skipWords(count);
        if (!whole)
            damaged("it ends within " + what + ", which has " + std::to_string(count) +
                    " numbers of the type " + scalarName(type));
    }

    /// Of the array before it. Ends at a blank line or the end of the file; a component without a name is a
    /// blank line, too.
    void skipMetadata() {
        while (const auto text = cursor_.line()) {
            const auto word = lowerCase(trimmed(*text));
            if (word.empty()) return;
            if (word != "component_names") continue;
            for (int component = 0; component < components_; ++component)
                (void)cursor_.line();
        }
    }

    const InputFile& file_;
    TextCursor cursor_;
    LegacyVtkHeader header_;
    bool haveDims_ = false;
    bool rectilinear_ = false;
    std::optional<LegacyAttribute> attribute_;
    std::uint64_t tuples_ = 0;
    int components_ = 1; ///< of the last array
};

} // namespace

glm::ivec3 cellDims(const glm::ivec3& pointDims) { return glm::max(pointDims - 1, glm::ivec3(1)); }

LegacyVtkHeader parseLegacyVtk(const InputFile& file) { return LegacyParser(file).parse(); }

} // namespace voxsheet::import
