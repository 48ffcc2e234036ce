#include "import/formats/chgcar_reader.h"

#include "base/errors.h"
#include "import/formats/chgcar_header.h"
#include "import/formats/field_names.h"
#include "import/formats/geometry.h"
#include "import/formats/grid_text.h"
#include "import/formats/voxel_plan.h"

#include <cmath>
#include <cstring>

namespace voxsheet::import {

namespace {

struct ChgcarPlan {
    std::filesystem::path file;
    int grids = 0;
};

/// Number of grids; the first grid's dimension line has been read.
int countGrids(const InputFile& file, TextScanner& text, const glm::ivec3& dims,
               const ChgcarStructure& structure, std::vector<std::string>& notes) {
    constexpr int mostGrids = 64;
    const auto values = static_cast<std::uint64_t>(sampleCount(dims));
    int grids = 0;
    bool newFrame = false;
    do {
        skipGrid(file, text, values, "grid " + std::to_string(++grids));
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
    const auto count = array.size() / sizeof(double);
    GridValues values(text, name, count);
    for (std::size_t index = 0; index < count; ++index) {
        const double value = values.next();
        std::memcpy(array.data() + index * sizeof(double), &value, sizeof(double));
        if (progress && index % progressEvery == 0) progress(values.fraction());
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
    checkTextHolds(file, bytes / sizeof(double));

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
