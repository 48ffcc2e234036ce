#include "import/formats/chgcar_reader.h"

#include "base/errors.h"
#include "import/formats/chgcar_header.h"
#include "import/formats/field_names.h"
#include "import/formats/geometry.h"
#include "import/formats/number_text.h"
#include "import/formats/voxel_plan.h"

#include <cmath>
#include <cstring>

namespace voxsheet::import {

namespace {

struct ChgcarPlan {
    std::filesystem::path file;
    int grids = 0;
};

TextScanner openText(const InputFile& file) {
    return {openStream(file, 0, compressionOf(file.textAt(0, 4))), file.name()};
}

/// VASP writes a grid in lines of equal length. When a look at the first and at lines spread over the grid
/// confirms this, all but the last line is passed over unread: files can be gigabytes, and readData looks at
/// every value anyway. Returns the number of values passed.
std::uint64_t jumpOverEqualLines(const InputFile& file, TextScanner& text, std::uint64_t values) {
    constexpr std::uint64_t worthwhile = 1'000'000;
    constexpr std::uint64_t probes = 64;
    const auto start = text.position();
    const auto first = file.textAt(start, 1024);
    const auto length = first.find('\n') + 1;
    if (values < worthwhile || length == 0) return 0;
    const auto perLine = splitWords(first.substr(0, length)).size();
    if (perLine == 0) return 0;
    const auto lines = values / perLine - 1;
    if (start + lines * length > file.bytes()) return 0;
    for (std::uint64_t probe = 0; probe <= probes; ++probe) {
        const auto line = file.textAt(start + (lines - 1) * probe / probes * length, length);
        if (line.find('\n') + 1 != length || splitWords(line).size() != perLine) return 0;
    }
    text.skipBytes(lines * length);
    return lines * perLine;
}

/// Passes over the values of a grid. Throws InvalidInput when there are too few.
void skipGrid(const InputFile& file, TextScanner& text, std::uint64_t values, int grid) {
    std::uint64_t found = 0;
    if (compressionOf(file.textAt(0, 4)) == Compression::None) found = jumpOverEqualLines(file, text, values);
    constexpr std::uint64_t widestValueBytes = 64;
    constexpr std::uint64_t slackBytes = 1U << 20;
    found += text.skipWords(values - found, (values - found) * widestValueBytes + slackBytes);
    if (found < values)
        throw InvalidInput(file.name(),
                           "grid " + std::to_string(grid) + " needs " + std::to_string(values) +
                               " values, the file ends after " + std::to_string(found),
                           "copy the file again, or let the calculation finish");
}

/// Number of grids; the first grid's dimension line has been read.
int countGrids(const InputFile& file, TextScanner& text, const glm::ivec3& dims,
               const ChgcarStructure& structure, std::vector<std::string>& notes) {
    constexpr int mostGrids = 64;
    const auto values = static_cast<std::uint64_t>(sampleCount(dims));
    int grids = 0;
    bool newFrame = false;
    do {
        skipGrid(file, text, values, ++grids);
        if (grids == mostGrids)
            throw Unsupported(file.name(), "it holds more than " + std::to_string(mostGrids) + " grids");
    } while (findChgcarGrid(text, dims, structure.firstLine, newFrame));
    if (newFrame) notes.emplace_back("The file holds further frames; only the first was read.");
    return grids;
}

std::vector<std::string> fieldNames(const ChgcarKind& kind, int grids) {
    if (grids == 1) return kind.oneGrid;
    if (grids == 2) return kind.twoGrids;
    if (grids == 4 && kind.divideByVolume)
        return {"density", "magnetization x", "magnetization y", "magnetization z"};
    return {};
}

void describeFields(const ChgcarKind& kind, int grids, const ImportOptions& options, double volume,
                    DatasetMeta& meta) {
    const bool divide = options.divideByCellVolume.value_or(kind.divideByVolume);
    meta.sourceType = ScalarType::F64; // text with 11 digits: more than a float holds
    meta.fields = makeFields(grids, ScalarType::F64, fieldNames(kind, grids));
    for (auto& field : meta.fields) {
        field.quantity = kind.quantity;
        field.unit = divide == kind.divideByVolume ? kind.unit : "";
        if (divide) field.valueScale = 1.0 / volume;
    }
    if (!kind.told && !options.divideByCellVolume)
        meta.notes.emplace_back(
            "The file's name does not say what it holds: it is taken as a charge density (CHGCAR), "
            "and its values are divided by the cell volume.");
}

void readGrid(TextScanner& text, const std::string& name, std::span<std::byte> array,
              const std::function<void(double)>& progress) {
    constexpr std::size_t progressEvery = 65536;
    const auto values = array.size() / sizeof(double);
    std::size_t width = 0;
    for (std::size_t index = 0; index < values; ++index) {
        const auto word = text.word();
        if (word.empty())
            throw InvalidInput(name, "it ends after " + std::to_string(index) + " of " +
                                         std::to_string(values) + " values");
        const auto value = parseFortranNumber(word);
        if (!value)
            throw InvalidInput(name, "it holds '" + printable(word) + "' where value " +
                                         std::to_string(index + 1) + " of a grid should be");
        const bool last = index + 1 == values;
        if (last && word.size() < width && text.atEnd()) // VASP ends lines, and its numbers are equally wide
            throw InvalidInput(name, "it ends within the last value of a grid", "copy the file again");
        width = word.size();
        std::memcpy(array.data() + index * sizeof(double), &*value, sizeof(double));
        if (progress && index % progressEvery == 0)
            progress(static_cast<double>(index) / static_cast<double>(values));
    }
}

} // namespace

bool ChgcarReader::recognises(const FileHead& head, const ImportOptions&) const {
    if (looksLikeChgcar(head.inflated)) return true;
    const bool text = head.inflated.find('\0') == std::string::npos;
    return text && namedLikeChgcar(head.path.filename().string());
}

SourceHeader ChgcarReader::readHeader(const std::filesystem::path& path, const ImportOptions& options,
                                      const ImportLimits& limits) const {
    const InputFile file(path);
    const auto name = file.name();
    auto text = openText(file);
    auto structure = readChgcarStructure(name, text);
    bool newFrame = false;
    const auto dims = findChgcarGrid(text, std::nullopt, structure.firstLine, newFrame);
    if (!dims)
        throw InvalidInput(name, "it holds a structure but no grid", "open a CHGCAR, LOCPOT or similar file");
    const auto bytes = checkedBytes(name, {dims->x, dims->y, dims->z}, sizeof(double), limits);
    const auto longest = largestDecompressedBytes(file.bytes(), compressionOf(file.textAt(0, 4)));
    if (bytes / sizeof(double) > longest / 2 + 1) // a digit and a blank each
        throw InvalidInput(name, "its grid of " + std::to_string(bytes / sizeof(double)) +
                                     " values cannot be in a file of " + std::to_string(file.bytes()) +
                                     " bytes");

    SourceHeader source;
    auto& meta = source.meta;
    meta.format = format();
    meta.notes = structure.notes;
    const auto& lattice = structure.crystal.lattice;
    meta.grid.dims = *dims;
    meta.grid.periodic = glm::bvec3(true);
    const glm::dvec3 size(*dims);
    meta.grid.worldFromIndex =
        affine({lattice[0] / size.x, lattice[1] / size.y, lattice[2] / size.z}, glm::dvec3(0.0));
    validateGrid(meta.grid);
    meta.lengthUnit = "Å";

    const int grids = countGrids(file, text, *dims, structure, meta.notes);
    (void)checkedBytes(name, {dims->x, dims->y, dims->z, grids}, sizeof(double), limits);
    describeFields(chgcarKind(path.filename().string()), grids, options, std::abs(glm::determinant(lattice)),
                   meta);
    meta.crystal = std::move(structure.crystal);
    source.files.push_back(canonicalPath(path));
    source.plan = std::make_shared<ChgcarPlan>(ChgcarPlan{source.files[0], grids});
    return source;
}

std::vector<std::string> ChgcarReader::readData(const SourceHeader& header, const ArraySink& sink,
                                                const ReadProgress& progress) const {
    const auto& plan = *static_cast<const ChgcarPlan*>(header.plan.get());
    const InputFile file(plan.file);
    auto text = openText(file);
    const auto structure = readChgcarStructure(file.name(), text);
    std::optional<glm::ivec3> expected;
    bool newFrame = false;
    for (int grid = 0; grid < plan.grids; ++grid) {
        const auto dims = findChgcarGrid(text, expected, structure.firstLine, newFrame);
        if (!dims || *dims != header.meta.grid.dims)
            throw IoError(file.name(), "it changed while it was read");
        expected = dims;
        std::vector<std::byte> array(header.arrayBytes(grid));
        readGrid(text, file.name(), array, [&](double fraction) {
            if (progress) progress((grid + fraction) / plan.grids);
        });
        sink(grid, 0, std::move(array));
    }
    if (progress) progress(1.0);
    return {};
}

} // namespace voxsheet::import
