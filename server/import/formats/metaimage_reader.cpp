#include "import/formats/metaimage_reader.h"

#include "base/errors.h"
#include "import/formats/field_names.h"
#include "import/formats/geometry.h"
#include "import/formats/metaimage_header.h"
#include "import/formats/number_text.h"
#include "import/formats/voxel_plan.h"

#include <algorithm>

namespace voxsheet::import {

namespace {

/// ITK's world is LPS+; ours RAS+. A file that says no orientation has no sides: its axes are the world's.
void placeGrid(const MetaImageHeader& header, DatasetMeta& meta) {
    const auto axes = header.dims.size();
    const auto spatial = std::min<std::size_t>(axes, 3);
    AxisColumns columns{};
    glm::dvec3 origin(0.0);
    for (std::size_t axis = 0; axis < spatial; ++axis) {
        const auto index = static_cast<glm::length_t>(axis);
        meta.grid.dims[index] = static_cast<int>(header.dims[axis]);
        origin[index] = header.offset[axis];
        for (std::size_t row = 0; row < spatial; ++row)
            columns[axis][static_cast<glm::length_t>(row)] =
                header.transform[axis * axes + row] * header.spacing[axis];
    }
    completeAxes(columns, static_cast<int>(spatial));
    if (spatial < 3)
        meta.notes.push_back("The file has " + std::to_string(spatial) + (spatial == 1 ? " axis" : " axes") +
                             "; it is shown one voxel thick.");
    meta.grid.worldFromIndex = affine(columns, origin);
    if (header.oriented) meta.grid.worldFromIndex = rasFromLps() * meta.grid.worldFromIndex;
    meta.anatomical = header.oriented;
    meta.lengthUnit = "mm";
}

void addSegments(const InputFile& file, const MetaImageHeader& header, std::uint64_t voxelBytes,
                 SourceHeader& source, VoxelPlan& plan) {
    std::vector<std::filesystem::path> paths;
    for (const auto& name : header.dataFiles)
        paths.push_back(resolveBeside(file.path(), name));
    source.files.insert(source.files.end(), paths.begin(), paths.end());
    const bool local = paths.empty();
    if (local) paths.push_back(source.files[0]);
    if (voxelBytes % paths.size() != 0)
        throw InvalidInput(file.name(), std::to_string(voxelBytes) +
                                            " bytes of voxels cannot be spread evenly over " +
                                            std::to_string(paths.size()) + " files");
    for (const auto& path : paths) {
        DataSegment segment;
        segment.file = path;
        segment.voxelBytes = voxelBytes / paths.size();
        if (local)
            segment.offset = header.dataOffset;
        else if (header.headerSize > 0)
            segment.offset = static_cast<std::uint64_t>(header.headerSize);
        segment.atEnd = !local && header.headerSize == -1;
        plan.segments.push_back(segment);
    }
    if (header.compressed && header.compressedBytes && paths.size() == 1) {
        const auto held =
            InputFile(paths[0]).bytes() - std::min(InputFile(paths[0]).bytes(), plan.segments[0].offset);
        if (*header.compressedBytes < 0 || held < static_cast<std::uint64_t>(*header.compressedBytes))
            throw InvalidInput(paths[0].string(),
                               "the header says " + std::to_string(*header.compressedBytes) +
                                   " bytes of compressed data, the file holds " + std::to_string(held),
                               "copy the file again");
    }
    checkSegments(plan);
}

} // namespace

bool MetaImageReader::recognises(const FileHead& head, const ImportOptions&) const {
    const std::string_view text(head.bytes);
    const auto has = [&](std::string_view tag) {
        return text.starts_with(tag) || text.find("\n" + std::string(tag)) != std::string_view::npos;
    };
    if (has("ElementDataFile") && (has("NDims") || has("DimSize"))) return true;
    const auto extension = lowerCase(head.path.extension().string());
    return extension == ".mha" || extension == ".mhd";
}

SourceHeader MetaImageReader::readHeader(const std::filesystem::path& path, const ImportOptions&,
                                         const ImportLimits& limits) const {
    const InputFile file(path);
    const auto header = parseMetaImageHeader(file);
    auto extents = header.dims;
    extents.push_back(header.channels);
    const auto voxelBytes = checkedBytes(file.name(), extents, scalarBytes(header.type), limits);

    auto plan = std::make_shared<VoxelPlan>();
    plan->type = header.type;
    plan->bigEndian = header.bigEndian;
    plan->compression = header.compressed ? Compression::Gzip : Compression::None;
    plan->encoding = header.binary ? VoxelEncoding::Raw : VoxelEncoding::Ascii;
    plan->components = header.channels;

    SourceHeader source;
    source.files.push_back(canonicalPath(path));
    auto& meta = source.meta;
    meta.format = format();
    meta.sourceType = header.type;
    meta.fields = makeFields(header.channels, header.type);
    placeGrid(header, meta);
    if (header.dims.size() == 4) {
        checkFieldsAndSteps(file.name(), header.channels, header.dims[3]);
        plan->steps = static_cast<int>(header.dims[3]);
        meta.times.clear();
        for (int step = 0; step < plan->steps; ++step)
            meta.times.push_back(header.offset[3] + step * header.spacing[3]);
    }
    validateGrid(meta.grid);
    addSegments(file, header, voxelBytes, source, *plan);
    source.plan = std::move(plan);
    return source;
}

std::vector<std::string> MetaImageReader::readData(const SourceHeader& header, const ArraySink& sink,
                                                   const ReadProgress& progress) const {
    readVoxels(*static_cast<const VoxelPlan*>(header.plan.get()), header.meta.grid.dims, sink, progress);
    return {};
}

} // namespace voxsheet::import
