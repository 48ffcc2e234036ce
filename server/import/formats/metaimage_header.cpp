#include "import/formats/metaimage_header.h"

#include "base/errors.h"
#include "import/formats/file_pattern.h"
#include "import/formats/geometry.h"
#include "import/formats/number_text.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace voxsheet::import {

namespace {

constexpr std::size_t kLargestHeaderBytes = 1U << 20;

class TagReader {
public:
    TagReader(const InputFile& file, MetaImageHeader& header) : name_(file.name()) {
        const auto text = file.textAt(0, kLargestHeaderBytes);
        std::string_view rest(text);
        while (const auto line = takeLine(rest)) {
            if (trimmed(*line).empty()) continue;
            const auto equals = line->find('=');
            if (equals == std::string_view::npos)
                fail("the header line '" + printable(*line) + "' is no tag");
            const std::string tag(trimmed(line->substr(0, equals)));
            if (!tags_.emplace(tag, trimmed(line->substr(equals + 1))).second)
                fail("the tag '" + printable(tag) + "' is there twice");
            if (tag != "ElementDataFile") continue;
            header.dataOffset = text.size() - rest.size();
            readDataFiles(tags_.at(tag), rest, header);
            return;
        }
        fail(text.size() == kLargestHeaderBytes ? "the header is longer than 1 MiB"
                                                : "the header has no tag 'ElementDataFile'");
    }

    [[noreturn]] void fail(const std::string& why) const { throw InvalidInput(name_, why); }
    [[noreturn]] void failValue(const std::string& tag) const {
        fail("the tag '" + tag + "' cannot be '" + printable(tags_.at(tag)) + "'");
    }
    [[nodiscard]] const std::string& name() const { return name_; }

    /// The first of `names` that is there, or nullptr.
    [[nodiscard]] const std::string* find(std::initializer_list<const char*> names) const {
        for (const auto* name : names)
            if (tags_.contains(name)) return &tags_.at(name);
        return nullptr;
    }
    [[nodiscard]] std::vector<double> numbers(std::initializer_list<const char*> names,
                                              std::vector<double> missing) const {
        for (const auto* name : names) {
            if (!tags_.contains(name)) continue;
            auto values = parseNumbers(tags_.at(name), missing.size());
            if (!values) failValue(name);
            return *values;
        }
        return missing;
    }
    [[nodiscard]] std::optional<std::int64_t> integer(const char* tag) const {
        if (!tags_.contains(tag)) return std::nullopt;
        const auto value = parseInteger(tags_.at(tag));
        if (!value) failValue(tag);
        return value;
    }
    [[nodiscard]] bool truth(std::initializer_list<const char*> names, bool missing) const {
        for (const auto* name : names) {
            if (!tags_.contains(name)) continue;
            const auto word = lowerCase(tags_.at(name));
            if (word == "true" || word == "1" || word == "t") return true;
            if (word == "false" || word == "0" || word == "f") return false;
            failValue(name);
        }
        return missing;
    }

private:
    void readDataFiles(const std::string& value, std::string_view rest, MetaImageHeader& header) const {
        if (value.empty()) failValue("ElementDataFile");
        if (value == "LOCAL" || value == "Local" || value == "local") return;
        if (value.starts_with("LIST")) {
            while (const auto line = takeLine(rest)) {
                if (trimmed(*line).empty()) continue;
                header.dataFiles.emplace_back(trimmed(*line));
                if (header.dataFiles.size() > kMostDataFiles) fail("it lists too many data files");
            }
            if (header.dataFiles.empty()) fail("its list of data files is empty");
        } else if (value.find('%') != std::string::npos && splitWords(value).size() > 1) {
            const auto names = expandFilePattern(value);
            if (!names) failValue("ElementDataFile");
            header.dataFiles = *names;
        } else {
            header.dataFiles = {value};
        }
    }

    std::string name_;
    std::map<std::string, std::string> tags_;
};

ScalarType metaType(const TagReader& tags) {
    static const std::map<std::string, ScalarType> types{
        {"MET_CHAR", ScalarType::I8},       {"MET_UCHAR", ScalarType::U8},
        {"MET_SHORT", ScalarType::I16},     {"MET_USHORT", ScalarType::U16},
        {"MET_INT", ScalarType::I32},       {"MET_UINT", ScalarType::U32},
        {"MET_LONG", ScalarType::I32},      {"MET_ULONG", ScalarType::U32}, // 4 bytes whatever the platform
        {"MET_LONG_LONG", ScalarType::I64}, {"MET_ULONG_LONG", ScalarType::U64},
        {"MET_FLOAT", ScalarType::F32},     {"MET_DOUBLE", ScalarType::F64}};
    const auto* name = tags.find({"ElementType"});
    if (!name) tags.fail("the header has no tag 'ElementType'");
    const auto it = types.find(*name);
    if (it == types.end()) tags.failValue("ElementType");
    return it->second;
}

/// The axis of LPS space that runs from `side`, and its sign there; nullopt: no side.
std::optional<std::pair<std::size_t, double>> directionFrom(char side) {
    static constexpr std::string_view from = "RLAPIS"; // where LPS axes begin, and where they end
    const auto place = from.find(side);
    if (place == std::string_view::npos) return std::nullopt;
    return std::pair(place / 2, place % 2 == 0 ? 1.0 : -1.0);
}

/// Turns the first three axes as the letters say, each the side that an axis comes from ("RAI": along LPS).
/// False, and nothing changed, where they do not name three axes ("???").
bool turnAxes(const std::string& letters, std::size_t axes, std::vector<double>& transform) {
    if (axes < 3 || letters.size() != 3) return false;
    auto turned = transform;
    std::array<bool, 3> taken{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto direction = directionFrom(letters[axis]);
        if (!direction || std::exchange(taken[direction->first], true)) return false;
        turned[axis * axes + axis] = 0.0;
        turned[axis * axes + direction->first] = direction->second;
    }
    transform = std::move(turned);
    return true;
}

/// Where there are both a matrix and letters the matrix counts: it says more.
void readOrientation(const TagReader& tags, MetaImageHeader& header) {
    const auto axes = header.dims.size();
    std::vector<double> identity(axes * axes, 0.0);
    for (std::size_t axis = 0; axis < axes; ++axis)
        identity[axis * axes + axis] = 1.0;
    header.oriented = tags.find({"TransformMatrix", "Rotation", "Orientation"}) != nullptr;
    header.transform = tags.numbers({"TransformMatrix", "Rotation", "Orientation"}, std::move(identity));
    const auto* letters = tags.find({"AnatomicalOrientation"});
    if (!header.oriented && letters) header.oriented = turnAxes(*letters, axes, header.transform);
}

void readShape(const TagReader& tags, MetaImageHeader& header) {
    const auto count = tags.integer("NDims");
    if (!count) tags.fail("the header has no tag 'NDims'");
    if (*count < 1) tags.failValue("NDims");
    if (*count > 4)
        throw Unsupported(tags.name(),
                          "it has " + std::to_string(*count) + " axes, more than space and time");
    const auto axes = static_cast<std::size_t>(*count);
    const auto* sizes = tags.find({"DimSize"});
    if (!sizes) tags.fail("the header has no tag 'DimSize'");
    const auto dims = parseIntegers(*sizes, axes);
    if (!dims) tags.failValue("DimSize");
    header.dims = *dims;

    header.spacing = tags.numbers({"ElementSpacing", "ElementSize"}, std::vector<double>(axes, 1.0));
    checkSpacing(tags.name(), header.spacing);
    if (std::any_of(header.spacing.begin(), header.spacing.end(), [](double length) { return length < 0.0; }))
        tags.fail("its spacing is negative");
    header.offset = tags.numbers({"Offset", "Position", "Origin"}, std::vector<double>(axes, 0.0));
    readOrientation(tags, header);
}

} // namespace

MetaImageHeader parseMetaImageHeader(const InputFile& file) {
    MetaImageHeader header;
    const TagReader tags(file, header);
    if (const auto* object = tags.find({"ObjectType"}); object && *object != "Image")
        throw Unsupported(file.name(), "it holds a '" + printable(*object) + "', not an image");
    readShape(tags, header);
    header.type = metaType(tags);
    const auto channels = tags.integer("ElementNumberOfChannels").value_or(1);
    if (channels < 1 || channels > 4096) tags.failValue("ElementNumberOfChannels");
    header.channels = static_cast<int>(channels);
    header.bigEndian = tags.truth({"ElementByteOrderMSB", "BinaryDataByteOrderMSB"}, false);
    header.binary = tags.truth({"BinaryData"}, true);
    header.compressed = tags.truth({"CompressedData"}, false);
    header.compressedBytes = tags.integer("CompressedDataSize");
    header.headerSize = tags.integer("HeaderSize").value_or(0);
    if (header.headerSize < -1) tags.failValue("HeaderSize");
    return header;
}

} // namespace voxsheet::import
