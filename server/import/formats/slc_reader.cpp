#include "import/formats/slc_reader.h"

#include "base/errors.h"
#include "import/formats/field_names.h"
#include "import/formats/geometry.h"
#include "import/formats/input_file.h"
#include "import/formats/number_text.h"
#include "import/formats/voxel_plan.h"

#include <algorithm>
#include <cstring>

namespace voxsheet::import {

namespace {

constexpr std::string_view kMagic = "11111";
constexpr const char* kCopyAgain = "copy or write the file again";

struct SlcPlan {
    std::filesystem::path file;
    std::uint64_t firstSlice = 0; ///< offset
    bool runLength = false;
};

/// The words of the file's text parts, from an offset on.
class SlcText {
public:
    SlcText(const InputFile& file, std::uint64_t offset) : file_(file), offset_(offset) {
        text_ = file.textAt(offset, 4096);
    }

    std::string_view word(const char* what) {
        constexpr std::string_view blanks = " \t\r\n";
        const auto begin = text_.find_first_not_of(blanks, at_);
        const auto end = begin == std::string::npos ? begin : text_.find_first_of(" \t\r\nX", begin);
        if (end == std::string::npos) // every word is followed by a blank or an X
            throw InvalidInput(file_.name(), std::string("its header ends before the ") + what, kCopyAgain);
        at_ = end;
        return std::string_view(text_).substr(begin, end - begin);
    }

    std::int64_t integer(const char* what, std::int64_t least, std::int64_t most) {
        const auto text = word(what);
        const auto value = parseInteger(text);
        if (!value || *value < least || *value > most)
            throw InvalidInput(file_.name(), std::string("its ") + what + " is '" + printable(text) + "'",
                               "it must be a whole number from " + std::to_string(least) + " to " +
                                   std::to_string(most));
        return *value;
    }

    double number(const char* what) {
        const auto text = word(what);
        const auto value = parseNumber(text);
        if (!value)
            throw InvalidInput(file_.name(),
                               std::string("its ") + what + " is '" + printable(text) + "', not a number");
        return *value;
    }

    /// Offset in the file of what follows the X that ends a text part.
    std::uint64_t afterX(const char* what) {
        const auto begin = text_.find_first_not_of(" \t\r\n", at_);
        if (begin == std::string::npos || text_[begin] != 'X')
            throw InvalidInput(file_.name(), std::string("there is no 'X' after the ") + what, kCopyAgain);
        return offset_ + begin + 1;
    }

private:
    const InputFile& file_;
    std::uint64_t offset_;
    std::string text_;
    std::size_t at_ = 0;
};

/// Decodes the runs of one slice. A control byte's low 7 bits count voxels, 0 ends the slice; with the top
/// bit that many bytes follow, without it one byte that repeats.
void decodeRuns(const std::string& name, const std::string& coded, std::span<std::byte> slice, int index) {
    const auto refuse = [&](const std::string& why) {
        throw InvalidInput(name, "slice " + std::to_string(index) + " " + why, kCopyAgain);
    };
    std::size_t filled = 0;
    std::size_t at = 0;
    while (at < coded.size()) {
        const auto control = static_cast<unsigned char>(coded[at++]);
        const std::size_t count = control & 0x7FU;
        if (count == 0) break;
        const bool literal = (control & 0x80U) != 0;
        const std::size_t needed = literal ? count : 1;
        if (needed > coded.size() - at) refuse("ends within a run");
        if (count > slice.size() - filled)
            refuse("holds more than its " + std::to_string(slice.size()) + " voxels");
        if (literal)
            std::memcpy(slice.data() + filled, coded.data() + at, count);
        else
            std::memset(slice.data() + filled, static_cast<unsigned char>(coded[at]), count);
        at += needed;
        filled += count;
    }
    if (filled != slice.size())
        refuse("holds " + std::to_string(filled) + " of its " + std::to_string(slice.size()) + " voxels");
}

/// Reads the slice at `offset`; returns the offset after it.
std::uint64_t readSlice(const InputFile& file, const SlcPlan& plan, std::uint64_t offset,
                        std::span<std::byte> slice, int index) {
    if (!plan.runLength) {
        const auto got = file.readAt(offset, slice);
        if (got < slice.size())
            throw InvalidInput(file.name(), "it ends within slice " + std::to_string(index), kCopyAgain);
        return offset + got;
    }
    SlcText text(file, offset);
    const auto left = static_cast<std::int64_t>(file.bytes() - std::min(offset, file.bytes()));
    const auto bytes = text.integer(("length of slice " + std::to_string(index)).c_str(), 1, left);
    const auto start = text.afterX("length of a slice");
    const auto coded = file.textAt(start, static_cast<std::size_t>(bytes));
    if (coded.size() < static_cast<std::size_t>(bytes))
        throw InvalidInput(file.name(), "it ends within slice " + std::to_string(index), kCopyAgain);
    decodeRuns(file.name(), coded, slice, index);
    return start + coded.size();
}

/// Fewest bytes that a slice takes in the file: a run of at most 127 voxels is two bytes.
std::uint64_t fewestSliceBytes(std::uint64_t voxels, bool runLength) {
    return runLength ? (voxels + 126) / 127 * 2 : voxels;
}

SlcPlan parseHeader(const InputFile& file, const ImportLimits& limits, SourceHeader& source) {
    SlcText text(file, 0);
    if (text.word("magic number") != kMagic) throw InvalidInput(file.name(), "it does not begin with 11111");
    constexpr std::int64_t longest = 2147483647;
    glm::ivec3 dims;
    for (int axis = 0; axis < 3; ++axis)
        dims[axis] = static_cast<int>(text.integer("size", 1, longest));
    const auto bits = text.integer("number of bits per voxel", 1, 64);
    if (bits != 8)
        throw Unsupported(file.name(), "it has " + std::to_string(bits) + " bits per voxel",
                          "only volumes of 8 bits can be read");
    std::vector<double> spacing;
    for (int axis = 0; axis < 3; ++axis)
        spacing.push_back(text.number("unit length"));
    checkSpacing(file.name(), spacing);
    const auto unit = text.integer("unit type", 0, longest);
    (void)text.integer("data origin", 0, longest);
    (void)text.integer("data modification", 0, longest);
    SlcPlan plan;
    plan.runLength = text.integer("data compression", 0, 1) == 1;
    const auto width = text.integer("icon width", 0, 65535);
    const auto height = text.integer("icon height", 0, 65535);
    constexpr std::uint64_t planes = 3; // red, green, blue
    plan.firstSlice = text.afterX("size of the icon") +
                      planes * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);

    const auto bytes = checkedBytes(file.name(), {dims.x, dims.y, dims.z}, 1, limits);
    const auto slices = static_cast<std::uint64_t>(dims.z);
    const auto needed = slices * fewestSliceBytes(bytes / slices, plan.runLength);
    const auto held = file.bytes() - std::min(file.bytes(), plan.firstSlice);
    if (held < needed)
        throw InvalidInput(file.name(),
                           "its voxels need at least " + std::to_string(needed) +
                               " bytes after header and icon, the file holds " + std::to_string(held),
                           kCopyAgain);
    auto& meta = source.meta;
    meta.grid.dims = dims;
    meta.grid.worldFromIndex =
        affine({glm::dvec3(spacing[0], 0, 0), {0, spacing[1], 0}, {0, 0, spacing[2]}}, glm::dvec3(0.0));
    validateGrid(meta.grid);
    meta.notes.push_back("The unit of its lengths is a bare number, " + std::to_string(unit) +
                         ", in the header: lengths are shown without a unit.");
    return plan;
}

} // namespace

bool SlcReader::recognises(const FileHead& head, const ImportOptions&) const {
    const std::string_view text(head.bytes);
    if (!text.starts_with(kMagic)) return false;
    auto start = std::string(text.substr(0, 256));
    std::replace_if(
        start.begin(), start.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    const auto words = splitWords(start);
    if (words.size() < 5 || words[0] != kMagic) return false;
    return std::all_of(words.begin() + 1, words.begin() + 5, [](auto word) { return parseInteger(word); });
}

SourceHeader SlcReader::readHeader(const std::filesystem::path& path, const ImportOptions&,
                                   const ImportLimits& limits) const {
    const InputFile file(path);
    SourceHeader source;
    source.files.push_back(canonicalPath(path));
    source.meta.format = format();
    source.meta.sourceType = ScalarType::U8;
    source.meta.fields = makeFields(1, ScalarType::U8);
    auto plan = std::make_shared<SlcPlan>(parseHeader(file, limits, source));
    plan->file = source.files[0];
    source.plan = std::move(plan);
    return source;
}

std::vector<std::string> SlcReader::readData(const SourceHeader& header, const ArraySink& sink,
                                             const ReadProgress& progress) const {
    const auto& plan = *static_cast<const SlcPlan*>(header.plan.get());
    const InputFile file(plan.file);
    std::vector<std::byte> voxels(header.arrayBytes(0));
    const int slices = header.meta.grid.dims.z;
    const auto sliceBytes = voxels.size() / static_cast<std::size_t>(slices);
    auto offset = plan.firstSlice;
    for (int slice = 0; slice < slices; ++slice) {
        const auto out = std::span(voxels).subspan(static_cast<std::size_t>(slice) * sliceBytes, sliceBytes);
        offset = readSlice(file, plan, offset, out, slice);
        if (progress) progress(static_cast<double>(slice + 1) / slices);
    }
    sink(0, 0, std::move(voxels));
    return {};
}

} // namespace voxsheet::import
