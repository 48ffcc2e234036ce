#include "import/vtk_legacy/legacy_vtk_reader.h"

#include "base/errors.h"
#include "import/formats/field_names.h"
#include "import/formats/geometry.h"
#include "import/formats/voxel_plan.h"
#include "import/vtk_legacy/image_fields.h"
#include "import/vtk_legacy/legacy_vtk_header.h"

#include <algorithm>

namespace voxsheet::import {

namespace {

struct ArrayPlan {
    int firstField = 0;
    VoxelPlan voxels;
};
using LegacyPlan = std::vector<ArrayPlan>;

VoxelPlan voxelPlan(const std::filesystem::path& file, const LegacyVtkHeader& header,
                    const LegacyArray& array, std::uint64_t tuples) {
    VoxelPlan plan;
    plan.encoding = header.binary ? VoxelEncoding::Raw : VoxelEncoding::Ascii;
    plan.type = array.type;
    plan.bigEndian = true;
    plan.components = array.components;
    DataSegment segment;
    segment.file = file;
    segment.offset = array.offset;
    segment.mayBeLonger = true; // the next array
    segment.voxelBytes = tuples * static_cast<std::uint64_t>(array.components) * scalarBytes(array.type);
    plan.segments.push_back(segment);
    return plan;
}

Grid pointGrid(const std::string& name, const LegacyVtkHeader& header) {
    const auto& s = header.spacing;
    checkSpacing(name, {s.x, s.y, s.z});
    Grid grid;
    grid.dims = header.dims;
    grid.worldFromIndex =
        affine({glm::dvec3(s.x, 0, 0), glm::dvec3(0, s.y, 0), glm::dvec3(0, 0, s.z)}, header.origin);
    validateGrid(grid);
    return grid;
}

class LegacyVtkReader : public SourceReader {
public:
    [[nodiscard]] const char* format() const override { return "vtk"; }
    [[nodiscard]] const char* description() const override { return "legacy VTK structured points (.vtk)"; }

    [[nodiscard]] bool recognises(const FileHead& head, const ImportOptions&) const override {
        return head.bytes.starts_with("# vtk DataFile Version");
    }

    [[nodiscard]] SourceHeader readHeader(const std::filesystem::path& path, const ImportOptions&,
                                          const ImportLimits& limits) const override {
        const InputFile file(path);
        const auto legacy = parseLegacyVtk(file);
        SourceHeader source;
        source.files.push_back(canonicalPath(path));
        source.meta.format = format();
        source.meta.grid = pointGrid(file.name(), legacy);
        source.meta.notes = legacy.notes;

        const auto isPoint = [](const LegacyArray& a) { return a.attribute == LegacyAttribute::Point; };
        const auto pointArrays = std::count_if(legacy.arrays.begin(), legacy.arrays.end(), isPoint);
        if (legacy.arrays.empty())
            throw InvalidInput(file.name(), "it has no array of numbers for its points or cells");
        if (pointArrays == 0)
            source.meta.grid = cellGrid(source.meta.grid);
        else if (pointArrays < static_cast<std::ptrdiff_t>(legacy.arrays.size()))
            source.meta.notes.emplace_back(
                "The arrays of its cells were left out, because it has arrays of points.");

        auto plan = std::make_shared<LegacyPlan>();
        const auto tuples = static_cast<std::uint64_t>(sampleCount(source.meta.grid.dims));
        for (const auto& array : legacy.arrays) {
            if (isPoint(array) != (pointArrays > 0)) continue;
            plan->push_back({static_cast<int>(source.meta.fields.size()),
                             voxelPlan(source.files[0], legacy, array, tuples)});
            appendFields(source.meta.fields, array.name, array.type, array.components, !array.colours);
        }
        checkFieldsAndSteps(file.name(), static_cast<std::int64_t>(source.meta.fields.size()), 1);
        source.meta.sourceType = source.meta.fields.front().storedType;
        if (source.totalBytes() > limits.maxBytes)
            throw LimitExceeded(file.name(), "its arrays need " + std::to_string(source.totalBytes()) +
                                                 " bytes, more than the limit of " +
                                                 std::to_string(limits.maxBytes));
        source.plan = plan;
        return source;
    }

    [[nodiscard]] std::vector<std::string> readData(const SourceHeader& header, const ArraySink& sink,
                                                    const ReadProgress& progress) const override {
        const auto& plan = *static_cast<const LegacyPlan*>(header.plan.get());
        for (std::size_t i = 0; i < plan.size(); ++i)
            readVoxels(
                plan[i].voxels, header.meta.grid.dims,
                [&](int field, int step, std::vector<std::byte>&& voxels) {
                    sink(plan[i].firstField + field, step, std::move(voxels));
                },
                [&](double fraction) {
                    if (progress)
                        progress((static_cast<double>(i) + fraction) / static_cast<double>(plan.size()));
                });
        return {};
    }
};

} // namespace

std::unique_ptr<SourceReader> makeLegacyVtkReader() { return std::make_unique<LegacyVtkReader>(); }

} // namespace voxsheet::import
