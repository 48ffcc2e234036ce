#include "import/vtk/amr_reader.h"

#include "base/errors.h"
#include "import/formats/field_names.h"
#include "import/formats/input_file.h"
#include "import/formats/patch_resampling.h"
#include "import/formats/point_resampling.h"
#include "import/formats/voxel_plan.h"
#include "import/vtk/vti_reader.h"
#include "import/vtk_legacy/image_fields.h"
#include "import/vtk_xml/amr_header.h"

#include <algorithm>
#include <memory>
#include <numeric>

namespace voxsheet::import {

namespace {

struct AmrPlan {
    std::vector<SourceHeader> patches;
    std::unique_ptr<const Resampling> resampling;
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
        patch.low[axis] = grid.worldFromIndex[3][axis];
        if (grid.centring == Centring::Cell) patch.low[axis] -= 0.5 * patch.cellSize[axis];
        patch.flat[axis] = vtiPointDims(header)[axis] == 1;
    }
    return patch;
}

struct Patches {
    std::vector<SourceHeader> headers;
    std::vector<CellPatch> grids;
};

/// Blocks have no levels: the smaller their cells, the higher theirs. Within a level, as before.
void orderByCellSize(Patches& patches) {
    std::vector<std::size_t> order(patches.grids.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto cellVolume = [&](std::size_t i) {
        const auto& size = patches.grids[i].cellSize;
        return size.x * size.y * size.z;
    };
    constexpr double rounding = 1e-4;
    std::stable_sort(order.begin(), order.end(),
                     [&](auto a, auto b) { return cellVolume(a) > cellVolume(b); });
    Patches sorted;
    for (const auto i : order) {
        auto& grid = patches.grids[i];
        if (!sorted.grids.empty()) {
            const auto& before = sorted.grids.back();
            const auto change = glm::abs(grid.cellSize / before.cellSize - 1.0);
            grid.level = before.level + (glm::any(glm::greaterThan(change, glm::dvec3(rounding))) ? 1 : 0);
        }
        sorted.grids.push_back(grid);
        sorted.headers.push_back(std::move(patches.headers[i]));
    }
    patches = std::move(sorted);
}

class AmrReader : public SourceReader {
public:
    [[nodiscard]] const char* format() const override { return "amr"; }
    [[nodiscard]] const char* description() const override {
        return "VTK AMR patches and blocks of images (.vth, .vthb, .vtm)";
    }

    [[nodiscard]] bool recognises(const FileHead& head, const ImportOptions&) const override {
        const auto type = typeOf(std::string_view(head.bytes).substr(0, kHeadBytes));
        return isAmrType(type) || isMultiBlockType(type);
    }

    [[nodiscard]] SourceHeader readHeader(const std::filesystem::path& path, const ImportOptions&,
                                          const ImportLimits& limits) const override {
        const InputFile file(path);
        const bool blocks = isMultiBlockType(typeOf(file.textAt(0, kHeadBytes)));
        SourceHeader source;
        source.files.push_back(canonicalPath(path));
        auto patches = readPatches(file, blocks, limits, source);
        if (blocks) orderByCellSize(patches);
        const auto& first = patches.headers.front().meta;
        auto& meta = source.meta;
        meta.format = format();
        meta.sourceType = first.sourceType;
        auto plan = std::make_shared<AmrPlan>();
        if (first.grid.centring == Centring::Cell)
            plan->resampling = std::make_unique<PatchResampling>(file.name(), std::move(patches.grids));
        else
            plan->resampling = std::make_unique<PointResampling>(file.name(), std::move(patches.grids));
        meta.grid = plan->resampling->grid();
        meta.notes.push_back(plan->resampling->note());
        meta.notes.insert(meta.notes.end(), first.notes.begin(), first.notes.end());
        for (auto field : first.fields) {
            if (field.name == kVtkGhosts) continue;
            field.storedType = plan->resampling->resultType(field.storedType);
            meta.fields.push_back(std::move(field));
        }
        if (meta.fields.empty()) throw InvalidInput(file.name(), "its patches have no array of numbers");
        checkTotalBytes(file.name(), limits, source);
        plan->patches = std::move(patches.headers);
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
            if (fields[field].name == kVtkGhosts) continue;
            const auto type = fields[field].storedType;
            auto cells = plan.resampling->blank(type);
            for (std::size_t patch = 0; patch < plan.patches.size(); ++patch) {
                plan.resampling->paint(patch, readVtiField(plan.patches[patch], static_cast<int>(field)),
                                       type, cells);
                if (progress) progress(++done / all);
            }
            sink(result++, 0, std::move(cells));
        }
        return {};
    }

private:
    static constexpr std::size_t kHeadBytes = 4096; // of which the kind of data set is known

    /// Their files join those of `source`.
    static Patches readPatches(const InputFile& file, bool blocks, const ImportLimits& limits,
                               SourceHeader& source) {
        Patches patches;
        auto wanted = blocks ? VtiData::PointsFirst : VtiData::CellsFirst;
        for (const auto& patch : parseAmrHeader(file)) {
            patches.headers.push_back(readVtiHeader(resolveBeside(file.path(), patch.file), limits, wanted));
            const auto& header = patches.headers.back();
            wanted = header.meta.grid.centring == Centring::Cell ? VtiData::Cells : VtiData::Points;
            source.files.push_back(header.files.front());
            patches.grids.push_back(patchOf(header, patch.level));
            refuseOtherArrays(patches.headers.front(), header);
        }
        return patches;
    }

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
