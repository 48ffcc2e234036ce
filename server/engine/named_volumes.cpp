#include "engine/named_volumes.h"

#include "base/errors.h"
#include "volume/clip_shapes.h"

#include <algorithm>
#include <utility>

namespace voxsheet::engine {

namespace {

constexpr const char* kShapeKey = "clip.shape";

template <typename T>
NamedVolumes::Found<T> found(T volume) {
    return {std::move(volume), std::nullopt};
}

template <typename T>
NamedVolumes::Found<T> missing(MissingVolume why) {
    return {std::nullopt, std::move(why)};
}

InvalidInput wrongName(const std::string& key, const std::string& name, const std::string& why,
                       const std::string& toDo) {
    return InvalidInput(key + ": " + name, why, toDo).withField(key);
}

/// Who wants a threshold. An image request and the pages may look at one cell with different ones.
std::string askerOf(const NamingCell& from) {
    return std::to_string(from.sheetIndex) + "!" + sheet::addressName(from.cell) +
           (from.view.request.empty() ? "" : " request");
}

Comparison comparisonOf(sheet::Comparison comparison) {
    switch (comparison) {
    case sheet::Comparison::GreaterOrEqual:
        return Comparison::GreaterOrEqual;
    case sheet::Comparison::Less:
        return Comparison::Less;
    case sheet::Comparison::LessOrEqual:
        return Comparison::LessOrEqual;
    case sheet::Comparison::Greater:
        break;
    }
    return Comparison::Greater;
}

/// Of a dataset or a computation that is not ready.
MissingVolume unfinished(const JobState& state, const std::string& what, const std::string& doing,
                         const std::string& failureCode) {
    if (state.state == DatasetState::Failed)
        return {failureCode, state.failure ? state.failure->message : what + ": it failed", 0.0};
    const bool queued = state.state == DatasetState::Queued;
    return {{}, (queued ? "Waiting for " : doing + " ") + what, std::min(state.progress, 0.999)};
}

std::string thresholdFailureCode(const JobState& state) {
    return state.failure && state.failure->kind == ErrorKind::LimitExceeded ? "#MEM!" : "#TYPE!";
}

std::shared_ptr<const DatasetMeta> shapeMeta(const std::string& name) {
    const auto shape = clipShapeFromName(name);
    return shape ? std::make_shared<const DatasetMeta>(clipShapeMeta(*shape)) : nullptr;
}

} // namespace

NamedVolumes::Found<FormulaInput> NamedVolumes::find(const sheet::VolumeName& name, const NamingCell& from,
                                                     const std::string& key) const {
    if (const auto* cell = std::get_if<sheet::SheetAddress>(&name)) return ofCell(*cell, from, key);
    return ofDataset(std::get<std::string>(name), from, key);
}

NamedVolumes::Found<FormulaInput> NamedVolumes::ofCell(const sheet::SheetAddress& name,
                                                       const NamingCell& from, const std::string& key) const {
    const std::string shown = sheet::addressName(name);
    std::size_t index = from.sheetIndex;
    if (!name.sheet.empty()) {
        try {
            index = sheet::sheetIndex(from.workbook, name.sheet);
        } catch (const NotFound& error) {
            throw wrongName(key, shown, error.why(), "name a sheet of this workbook");
        }
    }
    const sheet::Sheet& sheet = from.workbook.sheets.at(index);
    const CellContent& content = contentAt(from.contents, {index, name.cell});
    switch (content.state) {
    case CellState::Empty:
        throw wrongName(key, shown, "the cell holds no volume", "name a cell that does");
    case CellState::Error:
        return missing<FormulaInput>(
            {content.code, key + " needs " + shown + ", which is in error. " + content.message, 0.0});
    case CellState::Pending:
        return missing<FormulaInput>(
            {{}, "Waiting for " + shown + ": " + content.message, sources_.progress(content)});
    case CellState::Ready:
        break;
    }
    const auto style =
        sheet::resolveStyle(keys_, sheet, name.cell, {from.view.all, from.view.cells, from.view.request})
            .style;
    try {
        const FieldAndStep read = chooseField(style.field, style.timeStep, *content.meta);
        return found(FormulaInput{content.meta, read.field, read.step});
    } catch (const InvalidInput& error) {
        return missing<FormulaInput>({"#REF!", key + " needs " + shown + ". " + error.what(), 0.0});
    }
}

NamedVolumes::Found<FormulaInput> NamedVolumes::ofDataset(const std::string& name, const NamingCell& from,
                                                          const std::string& key) const {
    const auto source = from.workbook.datasets.find(name);
    if (source == from.workbook.datasets.end()) {
        const bool shape = key == kShapeKey;
        throw wrongName(key, "'" + name + "'",
                        shape ? "there is no such shape, and no such dataset in the workbook"
                              : "there is no such cell, and no such dataset in the workbook",
                        shape ? "choose sphere, ellipsoid, box, cylinder or torus, open the mesh's file, or "
                                "compare a cell as in B1 > 0.4"
                              : "name a cell such as B1, or a dataset of the list");
    }
    const JobState state = sources_.import(source->second);
    if (!state.meta)
        return missing<FormulaInput>(unfinished(state, "'" + name + "'", "Importing", "#IMPORT!"));
    const FieldAndStep read = chooseField(std::int64_t{0}, from.timeStep, *state.meta);
    return found(FormulaInput{state.meta, read.field, read.step});
}

NamedVolumes::Found<ClipObjectVolume> NamedVolumes::clipObject(const std::string& shape,
                                                               const NamingCell& from) const {
    const sheet::ClipShape parsed = sheet::parseClipShape(shape);
    if (const auto* comparison = std::get_if<sheet::ComparisonShape>(&parsed))
        return threshold(*comparison, shape, from);
    releaseClipObject(from);
    if (const auto* analytic = std::get_if<sheet::AnalyticShape>(&parsed))
        return found(ClipObjectVolume{clipShapeKey(analytic->name), std::nullopt, shapeMeta(analytic->name)});
    return mesh(std::get<sheet::DatasetShape>(parsed), from);
}

void NamedVolumes::releaseClipObject(const NamingCell& from) const { sources_.release(askerOf(from)); }

NamedVolumes::Found<ClipObjectVolume> NamedVolumes::mesh(const sheet::DatasetShape& shape,
                                                         const NamingCell& from) const {
    const auto dataset = ofDataset(shape.dataset, from, kShapeKey);
    if (!dataset.volume) return missing<ClipObjectVolume>(*dataset.missing);
    const DatasetMeta& meta = *dataset.volume->meta;
    if (!holdsSignedDistances(meta)) {
        const std::string& quantity = meta.fields.front().quantity;
        throw wrongName(kShapeKey, "'" + shape.dataset + "'",
                        "it holds " + (quantity.empty() ? std::string("values") : quantity) +
                            ", and not the distances of a mesh",
                        "say where it begins and ends, as in '" + shape.dataset + "' > 0.4");
    }
    return found(ClipObjectVolume{meta.key, meta.grid, dataset.volume->meta});
}

NamedVolumes::Found<ClipObjectVolume> NamedVolumes::threshold(const sheet::ComparisonShape& shape,
                                                              const std::string& text,
                                                              const NamingCell& from) const {
    auto operand = find(shape.operand, from, kShapeKey);
    if (!operand.volume) return missing<ClipObjectVolume>(*operand.missing);
    const Grid compared = operand.volume->meta->grid;
    const ThresholdTask task{std::move(*operand.volume), {comparisonOf(shape.comparison), shape.value}, text};
    const JobState state = sources_.threshold(askerOf(from), task);
    if (!state.meta) {
        return missing<ClipObjectVolume>(
            unfinished(state, "the clip object " + text, "Computing", thresholdFailureCode(state)));
    }
    return found(ClipObjectVolume{state.meta->key, compared, state.meta});
}

} // namespace voxsheet::engine
