#include "import/vtk/amr_reader.h"

#include "base/errors.h"
#include "import/formats/field_names.h"
#include "import/formats/input_file.h"
#include "import/formats/patch_resampling.h"
#include "import/formats/voxel_plan.h"
#include "import/vtk/vti_reader.h"
#include "import/vtk_xml/amr_header.h"

#include <algorithm>

namespace voxsheet::import {

namespace {

constexpr const char* kGhosts = "vtkGhostType"; // marks cells that finer patches cover: not for people

struct AmrPlan {
    std::vector<SourceHeader> patches;
    PatchResampling resampling;
};

/// The value of the attribute `type` in the beginning of a VTK XML file.
std::string_view typeOf(std::string_view head) {
    const auto element = head.find("<VTKFile");
    if (element == std::string_view::npos) return {};
    const auto attributes = head.substr(element, head.find('>', element) - element);
    constexpr std::string_view name = " type=";
    const auto at = attributes.find(name);
    if (at == std::string_view::npos || at + name.size() >= attributes.size()) return {};
    const auto quoted = attributes.substr(at + name.size());
    return quoted.substr(1, quoted.find(quoted[0], 1) - 1);
}

CellPatch patchOf(const SourceHeader& header, int level) {
    const auto& grid = header.meta.grid;
    const auto name = header.files.front().string();
    CellPatch patch;
    patch.level = level;
    patch.dims = grid.dims;
    for (int axis = 0; axis < 3; ++axis) {
        for (int other = 0; other < 3; ++other)
            if (other != axis && grid.worldFromIndex[axis][other] != 0.0)
                throw Unsupported(name, "its axes are turned", "write patches along the world's axes");
        patch.cellSize[axis] = grid.worldFromIndex[axis][axis];
        if (!(patch.cellSize[axis] > 0.0))
            throw Unsupported(name, "its spacing is below zero", "write patches with positive spacing");
        patch.low[axis] = grid.worldFromIndex[3][axis] - 0.5 * patch.cellSize[axis];
        patch.flat[axis] = vtiPointDims(header)[axis] == 1;
    }
    return patch;
}

class AmrReader : public SourceReader {
public:
    [[nodiscard]] const char* format() const override { return "amr"; }
    [[nodiscard]] const char* description() const override { return "VTK AMR patches (.vth, .vthb, .vtm)"; }

    [[nodiscard]] bool recognises(const FileHead& head, const ImportOptions&) const override {
        return isAmrType(typeOf(std::string_view(head.bytes).substr(0, 4096)));
    }

    [[nodiscard]] SourceHeader readHeader(const std::filesystem::path& path, const ImportOptions&,
                                          const ImportLimits& limits) const override {
        const InputFile file(path);
        const auto patches = parseAmrHeader(file);
        SourceHeader source;
        source.files.push_back(canonicalPath(path));
        std::vector<SourceHeader> headers;
        std::vector<CellPatch> grids;
        for (const auto& patch : patches) {
            headers.push_back(readVtiHeader(resolveBeside(path, patch.file), limits, VtiData::Cells));
            source.files.push_back(headers.back().files.front());
            grids.push_back(patchOf(headers.back(), patch.level));
            refuseOtherArrays(headers.front(), headers.back());
        }
        auto plan = std::make_shared<AmrPlan>(
            AmrPlan{std::move(headers), PatchResampling(file.name(), std::move(grids))});
        const auto& resampling = plan->resampling;
        auto& meta = source.meta;
        meta.format = format();
        meta.grid = resampling.grid();
        meta.sourceType = plan->patches.front().meta.sourceType;
        meta.notes.push_back(resampling.note());
        for (auto field : plan->patches.front().meta.fields) {
            if (field.name == kGhosts) continue;
            field.storedType = resampling.resultType(field.storedType);
            meta.fields.push_back(std::move(field));
        }
        if (meta.fields.empty()) throw InvalidInput(file.name(), "its patches have no array for their cells");
        checkFieldsAndSteps(file.name(), static_cast<std::int64_t>(meta.fields.size()), 1);
        if (source.totalBytes() > limits.maxBytes)
            throw LimitExceeded(file.name(), "its volumes need " + std::to_string(source.totalBytes()) +
                                                 " bytes, more than the limit of " +
                                                 std::to_string(limits.maxBytes));
        source.plan = std::move(plan);
        return source;
    }

    [[nodiscard]] std::vector<std::string> readData(const SourceHeader& header, const ArraySink& sink,
                                                    const ReadProgress& progress) const override {
        const auto& plan = *static_cast<const AmrPlan*>(header.plan.get());
        const auto& fields = plan.patches.front().meta.fields;
        const auto all = static_cast<double>(header.meta.fields.size() * plan.patches.size());
        double done = 0.0;
        int result = 0;
        for (std::size_t field = 0; field < fields.size(); ++field) {
            if (fields[field].name == kGhosts) continue;
            const auto type = fields[field].storedType;
            auto cells = plan.resampling.blank(type);
            for (std::size_t patch = 0; patch < plan.patches.size(); ++patch) {
                plan.resampling.paint(patch, readVtiField(plan.patches[patch], static_cast<int>(field)), type,
                                      cells);
                if (progress) progress(++done / all);
            }
            sink(result++, 0, std::move(cells));
        }
        return {};
    }

private:
    static void refuseOtherArrays(const SourceHeader& first, const SourceHeader& patch) {
        const auto same = [](const FieldMeta& a, const FieldMeta& b) {
            return a.name == b.name && a.storedType == b.storedType;
        };
        if (!std::equal(first.meta.fields.begin(), first.meta.fields.end(), patch.meta.fields.begin(),
                        patch.meta.fields.end(), same))
            throw InvalidInput(patch.files.front().string(),
                               "its arrays are not those of the first patch, " +
                                   first.files.front().filename().string(),
                               "write all patches with the same arrays");
    }
};

} // namespace

std::unique_ptr<SourceReader> makeAmrReader() { return std::make_unique<AmrReader>(); }

} // namespace voxsheet::import
