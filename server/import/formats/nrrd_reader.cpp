#include "import/formats/nrrd_reader.h"

#include "base/errors.h"
#include "import/formats/field_names.h"
#include "import/formats/label_names.h"
#include "import/formats/nrrd_axes.h"
#include "import/formats/number_text.h"
#include "import/formats/voxel_plan.h"

#include <cmath>

namespace voxsheet::import {

namespace {

Compression compressionFor(NrrdEncoding encoding) {
    if (encoding == NrrdEncoding::Gzip) return Compression::Gzip;
    if (encoding == NrrdEncoding::Bzip2) return Compression::Bzip2;
    return Compression::None;
}

VoxelEncoding voxelEncodingFor(NrrdEncoding encoding) {
    if (encoding == NrrdEncoding::Ascii) return VoxelEncoding::Ascii;
    if (encoding == NrrdEncoding::Hex) return VoxelEncoding::Hex;
    return VoxelEncoding::Raw;
}

/// Offset after `lines` line ends from `offset`. Lines are counted before decompression (format.html, "line
/// skip").
std::uint64_t skipLines(const InputFile& file, std::uint64_t offset, std::int64_t lines) {
    constexpr std::size_t block = 64 * 1024;
    while (lines > 0) {
        const auto text = file.textAt(offset, block);
        if (text.empty())
            throw InvalidInput(file.name(), "it has fewer lines than the line skip of the header");
        std::size_t at = 0;
        for (; lines > 0 && at < text.size(); ++at)
            if (text[at] == '\n') --lines;
        offset += at;
    }
    return offset;
}

int extent(const NrrdHeader& header, const std::vector<std::size_t>& axes, const std::string& name) {
    std::int64_t product = 1;
    for (const auto axis : axes) {
        checkFieldsAndSteps(name, header.axes[axis].size, 1);
        product *= header.axes[axis].size;
        checkFieldsAndSteps(name, product, 1);
    }
    return static_cast<int>(product);
}

std::vector<double> stepTimes(const NrrdAxis& axis) {
    const bool spaced = axis.spacing && std::isfinite(*axis.spacing) && *axis.spacing != 0.0;
    const double start = axis.min && std::isfinite(*axis.min) ? *axis.min : 0.0;
    std::vector<double> times;
    for (std::int64_t step = 0; step < axis.size; ++step)
        times.push_back(start + static_cast<double>(step) * (spaced ? *axis.spacing : 1.0));
    return times;
}

/// The files of voxels, in order, and where their voxels start. The header itself when they are attached.
void addSegments(const InputFile& file, const NrrdHeader& header, std::uint64_t voxelBytes,
                 SourceHeader& source, VoxelPlan& plan) {
    std::vector<std::filesystem::path> paths;
    for (const auto& name : header.dataFiles)
        paths.push_back(resolveBeside(file.path(), name));
    source.files.insert(source.files.end(), paths.begin(), paths.end());
    if (paths.empty()) paths.push_back(source.files[0]);
    if (voxelBytes % paths.size() != 0)
        throw InvalidInput(file.name(), std::to_string(voxelBytes) +
                                            " bytes of voxels cannot be spread evenly over " +
                                            std::to_string(paths.size()) + " files");
    const bool compressed = plan.compression != Compression::None;
    for (const auto& path : paths) {
        DataSegment segment;
        segment.file = path;
        const InputFile data(path);
        segment.offset = skipLines(data, header.dataFiles.empty() ? header.dataOffset : 0, header.lineSkip);
        segment.atEnd = header.byteSkip == -1;
        if (header.byteSkip > 0) {
            if (compressed)
                segment.skipDecoded = static_cast<std::uint64_t>(header.byteSkip);
            else
                segment.offset += static_cast<std::uint64_t>(header.byteSkip);
        }
        segment.voxelBytes = voxelBytes / paths.size();
        plan.segments.push_back(segment);
    }
    checkSegments(plan);
}

} // namespace

bool NrrdReader::recognises(const FileHead& head, const ImportOptions&) const {
    return head.bytes.starts_with("NRRD000");
}

SourceHeader NrrdReader::readHeader(const std::filesystem::path& path, const ImportOptions&,
                                    const ImportLimits& limits) const {
    const InputFile file(path);
    const auto header = parseNrrdHeader(file);
    std::vector<std::int64_t> sizes;
    for (const auto& axis : header.axes)
        sizes.push_back(axis.size);
    const auto voxelBytes = checkedBytes(file.name(), sizes, scalarBytes(header.type), limits);

    const auto roles = nrrdRoles(file.name(), header);
    auto plan = std::make_shared<VoxelPlan>();
    plan->type = header.type;
    plan->bigEndian = header.bigEndian;
    plan->compression = compressionFor(header.encoding);
    plan->encoding = voxelEncodingFor(header.encoding);
    plan->components = extent(header, roles.inner, file.name());
    plan->outerFields = extent(header, roles.outerFields, file.name());
    plan->stepsFastest = roles.timeFastest;

    SourceHeader source;
    source.files.push_back(canonicalPath(path));
    auto& meta = source.meta;
    meta.format = format();
    meta.sourceType = header.type;
    placeNrrdGrid(file.name(), header, roles, meta);
    if (!roles.time.empty()) {
        const auto& time = header.axes[roles.time[0]];
        checkFieldsAndSteps(file.name(), 1, time.size);
        plan->steps = static_cast<int>(time.size);
        meta.times = stepTimes(time);
    }
    const auto fields = std::int64_t{plan->components} * plan->outerFields;
    checkFieldsAndSteps(file.name(), fields, 1);
    const auto& named = roles.inner.empty() ? roles.outerFields : roles.inner;
    meta.fields = makeFields(static_cast<int>(fields), header.type,
                             named.size() == 1 ? nrrdComponentNames(header.axes[named[0]])
                                               : std::vector<std::string>{});
    for (auto& field : meta.fields)
        field.unit = header.sampleUnit;
    meta.labels = segmentLabels(header.keyValues, meta.notes);
    validateGrid(meta.grid);

    addSegments(file, header, voxelBytes, source, *plan);
    source.plan = std::move(plan);
    return source;
}

std::vector<std::string> NrrdReader::readData(const SourceHeader& header, const ArraySink& sink,
                                              const ReadProgress& progress) const {
    readVoxels(*static_cast<const VoxelPlan*>(header.plan.get()), header.meta.grid.dims, sink, progress);
    return {};
}

} // namespace voxsheet::import
