#include "import/formats/nifti_reader.h"

#include "base/errors.h"
#include "import/formats/field_names.h"
#include "import/formats/nifti_header.h"
#include "import/formats/nifti_labels.h"
#include "import/formats/number_text.h"
#include "import/formats/voxel_plan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace voxsheet::import {

namespace fs = std::filesystem;

namespace {

struct Voxel {
    ScalarType type;
    std::vector<std::string> components; ///< empty for scalars
};

Voxel voxelOf(const std::string& name, int datatype) {
    switch (datatype) { // DT_ codes of nifti1.h
    case 2:
        return {ScalarType::U8, {}};
    case 4:
        return {ScalarType::I16, {}};
    case 8:
        return {ScalarType::I32, {}};
    case 16:
        return {ScalarType::F32, {}};
    case 32:
        return {ScalarType::F32, {"real", "imaginary"}};
    case 64:
        return {ScalarType::F64, {}};
    case 128:
        return {ScalarType::U8, {"red", "green", "blue"}};
    case 256:
        return {ScalarType::I8, {}};
    case 512:
        return {ScalarType::U16, {}};
    case 768:
        return {ScalarType::U32, {}};
    case 1024:
        return {ScalarType::I64, {}};
    case 1280:
        return {ScalarType::U64, {}};
    case 1792:
        return {ScalarType::F64, {"real", "imaginary"}};
    case 2304:
        return {ScalarType::U8, {"red", "green", "blue", "alpha"}};
    case 1:
    case 1536:
    case 2048:
        throw Unsupported(name, "its values are single bits or 128-bit numbers", "convert it to float");
    default:
        throw InvalidInput(name, "its datatype " + std::to_string(datatype) + " is none of NIfTI's");
    }
}

/// The other file of a pair: the same name with one of `endings`, if there is one. Throws as resolveBeside.
std::optional<fs::path> partner(const fs::path& path, std::initializer_list<const char*> endings) {
    auto stem = path.filename().string();
    if (lowerCase(stem).ends_with(".gz")) stem.resize(stem.size() - 3);
    if (stem.size() < 4) return std::nullopt;
    stem.resize(stem.size() - 4);
    for (const auto* ending : endings) {
        auto candidate = path.parent_path() / (stem + ending);
        std::error_code code;
        if (!fs::exists(candidate, code)) continue;
        (void)resolveBeside(path, candidate.filename().string()); // refuses links that lead elsewhere
        return candidate;
    }
    return std::nullopt;
}

bool nameEndsWith(const fs::path& path, const std::string& ending) {
    const auto name = lowerCase(path.filename().string());
    return name.ends_with(ending) || name.ends_with(ending + ".gz");
}

bool hasPartner(const fs::path& image) {
    try {
        return partner(image, {".hdr", ".hdr.gz"}).has_value();
    } catch (const Error&) {
        return true; // there is one, but it cannot be used: readHeader says why
    }
}

struct OpenHeader {
    std::string bytes;
    Compression compression;
};

OpenHeader readStart(const InputFile& file) {
    OpenHeader start{std::string(kNifti2Bytes, '\0'), compressionOf(file.textAt(0, 4))};
    if (start.compression == Compression::Bzip2) start.compression = Compression::None;
    start.bytes.resize(
        openStream(file, 0, start.compression)->read(std::as_writable_bytes(std::span(start.bytes))));
    return start;
}

std::vector<std::int64_t> extents(const std::string& name, const NiftiHeader& header) {
    const auto axes = header.dim[0];
    if (axes < 1 || axes > 7)
        throw InvalidInput(name, "its number of axes, " + std::to_string(axes) + ", is not between 1 and 7");
    std::vector<std::int64_t> result(7, 1);
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(axes); ++axis)
        result[axis] = header.dim[axis + 1];
    return result;
}

/// Bytes before the voxels.
std::uint64_t voxelOffset(const std::string& name, const NiftiHeader& header) {
    const double least = !header.singleFile ? 0.0 : header.version == 1 ? 352.0 : 544.0;
    const double offset = header.voxOffset;
    if (!(offset >= least) || offset > 0x1p40 || offset != std::floor(offset))
        throw InvalidInput(name, "the offset of its voxels, " + std::to_string(offset) + ", is not possible");
    return static_cast<std::uint64_t>(offset);
}

void setUnitsAndTimes(const NiftiHeader& header, int steps, DatasetMeta& meta) {
    const int length = header.unitsCode & 7;
    const double millimetres = length == 1 ? 1000.0 : length == 3 ? 0.001 : 1.0;
    meta.grid.worldFromIndex =
        glm::scale(glm::dmat4(1.0), glm::dvec3(millimetres)) * meta.grid.worldFromIndex;
    meta.lengthUnit = length != 0 || meta.anatomical ? "mm" : "";
    const int time = header.unitsCode & 0x38;
    const double seconds = time == 16 ? 1e-3 : time == 24 ? 1e-6 : 1.0;
    const bool spaced = std::isfinite(header.pixdim[4]) && header.pixdim[4] > 0.0;
    const double start = std::isfinite(header.timeOffset) ? header.timeOffset : 0.0;
    meta.times.clear();
    for (int step = 0; step < steps; ++step)
        meta.times.push_back((start + step * (spaced ? header.pixdim[4] : 1.0)) * seconds);
}

void setScaling(const NiftiHeader& header, DatasetMeta& meta) {
    if (header.datatype == 128 || header.datatype == 2304) return; // colours are not scaled
    if (header.slope == 0.0) return;                               // "no scaling" (nifti1.h, scl_slope)
    if (!std::isfinite(header.slope) || !std::isfinite(header.intercept)) {
        meta.notes.emplace_back(
            "The header's slope or intercept is not finite; the values were left as stored.");
        return;
    }
    for (auto& field : meta.fields) {
        field.valueScale = header.slope;
        field.valueOffset = header.intercept;
    }
}

} // namespace

bool NiftiReader::recognises(const FileHead& head, const ImportOptions&) const {
    if (niftiKind(head.inflated) == NiftiKind::Nifti) return true;
    if (nameEndsWith(head.path, ".nii")) return true;
    if (niftiKind(head.inflated) == NiftiKind::Analyze) return nameEndsWith(head.path, ".hdr");
    return nameEndsWith(head.path, ".img") && hasPartner(head.path);
}

SourceHeader NiftiReader::readHeader(const fs::path& path, const ImportOptions&,
                                     const ImportLimits& limits) const {
    auto headerPath = path;
    if (nameEndsWith(path, ".img"))
        if (const auto found = partner(path, {".hdr", ".hdr.gz"})) headerPath = *found;
    const InputFile file(headerPath);
    const auto start = readStart(file);
    const auto header = parseNiftiHeader(file.name(), start.bytes);
    const auto voxel = voxelOf(file.name(), header.datatype);
    const auto sizes = extents(file.name(), header);
    if (sizes[5] > 1 || sizes[6] > 1) throw Unsupported(file.name(), "it has more than five axes");
    const auto components = std::max<std::size_t>(1, voxel.components.size());
    const auto voxelBytes = checkedBytes(file.name(), sizes, scalarBytes(voxel.type) * components, limits);
    checkFieldsAndSteps(file.name(), sizes[4] * static_cast<std::int64_t>(components), sizes[3]);

    auto plan = std::make_shared<VoxelPlan>();
    plan->type = voxel.type;
    plan->bigEndian = header.bigEndian;
    plan->components = static_cast<int>(components);
    plan->steps = static_cast<int>(sizes[3]);
    plan->outerFields = static_cast<int>(sizes[4]);
    plan->stepsFastest = true;

    SourceHeader source;
    auto& meta = source.meta;
    meta.format = format();
    meta.sourceType = voxel.type;
    meta.grid.dims =
        glm::ivec3(static_cast<int>(sizes[0]), static_cast<int>(sizes[1]), static_cast<int>(sizes[2]));
    const auto placement = niftiPlacement(file.name(), header);
    meta.grid.worldFromIndex = placement.worldFromIndex;
    meta.anatomical = placement.anatomical;
    if (!placement.note.empty()) meta.notes.push_back(placement.note);
    setUnitsAndTimes(header, plan->steps, meta);
    meta.fields = makeFields(plan->components * plan->outerFields, voxel.type, voxel.components);
    setScaling(header, meta);
    validateGrid(meta.grid);
    meta.labels = niftiLabels(file, start.compression, header, meta.notes);

    DataSegment segment;
    segment.file = canonicalPath(path);
    source.files.push_back(segment.file);
    plan->compression = start.compression;
    if (!header.singleFile) {
        const auto data =
            nameEndsWith(path, ".img") ? std::optional(path) : partner(path, {".img", ".img.gz"});
        if (!data)
            throw NotFound(file.name(),
                           "its voxels should be in a file of the same name ending in .img, which is missing",
                           "put both files into one folder");
        segment.file = canonicalPath(*data);
        source.files.push_back(*data == path ? canonicalPath(headerPath) : segment.file);
        // By name: raw voxels may happen to start like gzip.
        plan->compression =
            lowerCase(data->extension().string()) == ".gz" ? Compression::Gzip : Compression::None;
    }
    const auto offset = voxelOffset(file.name(), header);
    (plan->compression == Compression::None ? segment.offset : segment.skipDecoded) = offset;
    segment.voxelBytes = voxelBytes;
    segment.mayBeLonger = true;
    plan->segments.push_back(segment);
    checkSegments(*plan);
    source.plan = std::move(plan);
    return source;
}

std::vector<std::string> NiftiReader::readData(const SourceHeader& header, const ArraySink& sink,
                                               const ReadProgress& progress) const {
    readVoxels(*static_cast<const VoxelPlan*>(header.plan.get()), header.meta.grid.dims, sink, progress);
    return {};
}

} // namespace voxsheet::import
