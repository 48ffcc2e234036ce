#include "import/formats/raw_reader.h"

#include "base/errors.h"
#include "import/formats/field_names.h"
#include "import/formats/number_text.h"
#include "import/formats/raw_sidecar.h"
#include "import/formats/voxel_plan.h"

namespace voxsheet::import {

namespace fs = std::filesystem;

namespace {

bool hasExtension(const fs::path& path, std::string_view extension) {
    return lowerCase(path.extension().string()) == extension;
}

bool isFile(const fs::path& path) {
    std::error_code code;
    return fs::is_regular_file(path, code);
}

std::optional<fs::path> sidecarOf(const fs::path& data) {
    auto appended = data;
    appended += ".json";
    for (const auto& candidate : {appended, fs::path(data).replace_extension(".json")})
        if (isFile(candidate)) return candidate;
    return std::nullopt;
}

RawDescription fromOptions(const ImportOptions& options) {
    RawDescription description;
    description.dims = {options.rawDims->x, options.rawDims->y, options.rawDims->z};
    description.type = *options.rawType;
    description.bigEndian = options.rawBigEndian;
    constexpr std::uint64_t farthest = 1ULL << 62;
    description.skip = static_cast<std::int64_t>(std::min(options.rawSkipBytes, farthest));
    description.components = options.rawComponents;
    return description;
}

fs::path dataFileOf(const fs::path& sidecar, const RawDescription& description) {
    if (!description.file.empty()) return resolveBeside(sidecar, description.file);
    const auto bare = fs::path(sidecar).replace_extension();
    for (const auto& candidate : {bare, fs::path(sidecar).replace_extension(".raw")})
        if (isFile(candidate)) return resolveBeside(sidecar, candidate.filename().string());
    throw NotFound(sidecar.string(), "the voxels that it describes are missing",
                   "put them beside it, or name them in its member 'file'");
}

/// A raw file is often the second half of a pair with a header.
std::string headerHint(const fs::path& data) {
    for (const auto* extension : {".mhd", ".nhdr"}) {
        const auto header = fs::path(data).replace_extension(extension);
        if (isFile(header)) return "open its header " + header.filename().string();
    }
    return "give dimensions and type as options, or in " +
           fs::path(data).replace_extension(".json").filename().string() + " beside it";
}

bool looksLikeSidecar(const FileHead& head) {
    const auto text = trimmed(head.bytes);
    return text.starts_with('{') && text.find("\"dims\"") != std::string_view::npos &&
           text.find("\"type\"") != std::string_view::npos;
}

} // namespace

bool RawReader::recognises(const FileHead& head, const ImportOptions& options) const {
    if (options.rawDims && options.rawType) return true;
    if (hasExtension(head.path, ".json")) return looksLikeSidecar(head);
    return hasExtension(head.path, ".raw") || (hasExtension(head.path, ".bin") && sidecarOf(head.path));
}

SourceHeader RawReader::readHeader(const fs::path& path, const ImportOptions& options,
                                   const ImportLimits& limits) const {
    RawDescription description;
    SourceHeader source;
    source.files.push_back(canonicalPath(path));
    auto data = source.files[0];
    if (options.rawDims && options.rawType) {
        description = fromOptions(options);
    } else if (hasExtension(path, ".json")) {
        description = parseRawSidecar(InputFile(path));
        data = dataFileOf(path, description);
        source.files.push_back(data);
    } else {
        const InputFile openable(path); // a folder or LFS pointer is named as such before a sidecar is missed
        const auto sidecar = sidecarOf(path);
        if (!sidecar) throw InvalidInput(openable.name(), "raw voxels have no header", headerHint(path));
        source.files.push_back(resolveBeside(path, sidecar->filename().string()));
        description = parseRawSidecar(InputFile(*sidecar));
    }
    const auto name = path.string();
    auto extents = description.dims;
    extents.push_back(description.components);
    extents.push_back(description.steps);
    const auto voxelBytes = checkedBytes(name, extents, scalarBytes(description.type), limits);
    checkFieldsAndSteps(name, description.components, description.steps);

    auto plan = std::make_shared<VoxelPlan>();
    plan->type = description.type;
    plan->bigEndian = description.bigEndian;
    plan->components = static_cast<int>(description.components);
    plan->steps = static_cast<int>(description.steps);
    DataSegment segment;
    segment.file = data;
    segment.offset = static_cast<std::uint64_t>(description.skip);
    segment.voxelBytes = voxelBytes;
    plan->segments.push_back(segment);
    checkSegments(*plan);

    auto& meta = source.meta;
    meta.format = format();
    meta.sourceType = description.type;
    meta.grid = {glm::ivec3(static_cast<int>(description.dims[0]), static_cast<int>(description.dims[1]),
                            static_cast<int>(description.dims[2])),
                 description.worldFromIndex, description.centring, description.periodic};
    validateGrid(meta.grid);
    meta.lengthUnit = description.units;
    meta.anatomical = description.anatomical;
    meta.fields = makeFields(plan->components, description.type, description.fields);
    for (auto& field : meta.fields) {
        field.valueScale = description.valueScale;
        field.valueOffset = description.valueOffset;
    }
    meta.times = description.times;
    for (int step = static_cast<int>(meta.times.size()); step < plan->steps; ++step)
        meta.times.push_back(step);
    for (const auto& member : description.unknownMembers)
        meta.notes.push_back("The sidecar's member '" + printable(member) +
                             "' is not known and was left out.");
    source.plan = std::move(plan);
    return source;
}

std::vector<std::string> RawReader::readData(const SourceHeader& header, const ArraySink& sink,
                                             const ReadProgress& progress) const {
    readVoxels(*static_cast<const VoxelPlan*>(header.plan.get()), header.meta.grid.dims, sink, progress);
    return {};
}

} // namespace voxsheet::import
