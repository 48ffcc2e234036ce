#include "import/vtk_legacy/legacy_vtk_reader.h"

#include "base/errors.h"
#include "import/formats/field_names.h"
#include "import/formats/geometry.h"
#include "import/formats/rectilinear_axes.h"
#include "import/formats/voxel_plan.h"
#include "import/vtk_legacy/image_fields.h"
#include "import/vtk_legacy/legacy_vtk_header.h"

#include <algorithm>
#include <cstring>
#include <optional>

namespace voxsheet::import {

namespace {

struct ArrayPlan {
    int firstField = 0;
    VoxelPlan voxels;
};

struct LegacyPlan {
    glm::ivec3 dims{1}; ///< of the arrays in the file
    std::vector<ArrayPlan> arrays;
    std::optional<UniformResampling> resampling;
};

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

AxisCoordinates coordinatesOf(const std::filesystem::path& file, const LegacyVtkHeader& header) {
    AxisCoordinates points;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto& array = header.coordinates[axis];
        const int count = header.dims[static_cast<int>(axis)];
        const auto plan = voxelPlan(file, header, array, static_cast<std::uint64_t>(count));
        readVoxels(
            plan, {count, 1, 1},
            [&](int, int, std::vector<std::byte>&& bytes) {
                visitScalar(array.type, [&]<typename T>() {
                    std::vector<T> values(bytes.size() / sizeof(T));
                    std::memcpy(values.data(), bytes.data(), bytes.size());
                    for (const T value : values)
                        points[axis].push_back(static_cast<double>(value));
                });
            },
            [](double) {});
    }
    return points;
}

class LegacyVtkReader : public SourceReader {
public:
    [[nodiscard]] const char* format() const override { return "vtk"; }
    [[nodiscard]] const char* description() const override {
        return "legacy VTK structured points and rectilinear grids (.vtk)";
    }

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
        source.meta.notes = legacy.notes;
        auto plan = std::make_shared<LegacyPlan>();

        const auto isPoint = [](const LegacyArray& a) { return a.attribute == LegacyAttribute::Point; };
        const auto pointArrays = std::count_if(legacy.arrays.begin(), legacy.arrays.end(), isPoint);
        if (legacy.arrays.empty())
            throw InvalidInput(file.name(), "it has no array of numbers for its points or cells");
        placeGrid(file.name(), legacy, pointArrays == 0, source, *plan);
        if (pointArrays > 0 && pointArrays < static_cast<std::ptrdiff_t>(legacy.arrays.size()))
            source.meta.notes.emplace_back(
                "The arrays of its cells were left out, because it has arrays of points.");

        const auto tuples = static_cast<std::uint64_t>(sampleCount(plan->dims));
        for (const auto& array : legacy.arrays) {
            if (isPoint(array) != (pointArrays > 0)) continue;
            plan->arrays.push_back({static_cast<int>(source.meta.fields.size()),
                                    voxelPlan(source.files[0], legacy, array, tuples)});
            appendFields(source.meta.fields, array.name, array.type, array.components, !array.colours);
        }
        source.meta.sourceType = plan->arrays.front().voxels.type;
        finishFields(file.name(), plan->resampling, limits, source);
        source.plan = plan;
        return source;
    }

    [[nodiscard]] std::vector<std::string> readData(const SourceHeader& header, const ArraySink& sink,
                                                    const ReadProgress& progress) const override {
        const auto& plan = *static_cast<const LegacyPlan*>(header.plan.get());
        for (std::size_t i = 0; i < plan.arrays.size(); ++i) {
            const auto& [firstField, voxels] = plan.arrays[i];
            readVoxels(
                voxels, plan.dims,
                [&, first = firstField, type = voxels.type](int field, int step,
                                                            std::vector<std::byte>&& values) {
                    sink(first + field, step,
                         plan.resampling ? plan.resampling->apply(values, type) : std::move(values));
                },
                [&](double fraction) {
                    if (progress)
                        progress((static_cast<double>(i) + fraction) /
                                 static_cast<double>(plan.arrays.size()));
                });
        }
        return {};
    }

private:
    static void placeGrid(const std::string& name, const LegacyVtkHeader& legacy, bool ofCells,
                          SourceHeader& source, LegacyPlan& plan) {
        auto& grid = source.meta.grid;
        if (legacy.coordinates.empty()) {
            grid = pointGrid(name, legacy);
            if (ofCells) grid = cellGrid(grid);
            plan.dims = grid.dims;
            return;
        }
        const UniformResampling resampling(name, coordinatesOf(source.files[0], legacy), ofCells);
        grid = resampling.grid();
        plan.dims = resampling.sourceDims();
        if (resampling.isIdentity()) return;
        plan.resampling = resampling;
        source.meta.notes.push_back(resampling.note());
    }
};

} // namespace

std::unique_ptr<SourceReader> makeLegacyVtkReader() { return std::make_unique<LegacyVtkReader>(); }

} // namespace voxsheet::import
