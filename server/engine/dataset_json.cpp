#include "engine/dataset_json.h"

#include "base/errors.h"
#include "volume/elements.h"

namespace voxsheet::engine {

namespace {

using nlohmann::json;

json vectorJson(const glm::dvec3& v) { return json::array({v.x, v.y, v.z}); }

json rangeJson(const ValueStatistics& statistics) {
    if (statistics.finiteCount == 0) return nullptr;
    return json::array({statistics.min, statistics.max});
}

/// Back from values to the numbers that stand in the source.
json rawRangeJson(const FieldMeta& field) {
    const auto& statistics = field.steps.at(0).statistics;
    if (statistics.finiteCount == 0) return nullptr;
    const auto raw = [&](double value) { return (value - field.valueOffset) / field.valueScale; };
    const double low = raw(statistics.min);
    const double high = raw(statistics.max);
    return low <= high ? json::array({low, high}) : json::array({high, low});
}

json fieldJson(const FieldMeta& field) {
    json result{{"name", field.name},
                {"quantity", field.quantity},
                {"unit", field.unit},
                {"type", scalarName(field.storedType)}};
    if (field.steps.empty()) return result; // header only: not read yet
    const auto& statistics = field.steps.front().statistics;
    result["range"] = rangeJson(statistics);
    result["mean"] = statistics.mean;
    result["stddev"] = statistics.standardDeviation;
    result["nan"] = statistics.nanCount;
    return result;
}

void addGeometry(json& result, const Grid& grid) {
    const auto spacing = spacingWorld(grid);
    const glm::dmat3 axes(grid.worldFromIndex);
    json direction = json::array();
    for (int row = 0; row < 3; ++row) {
        json line = json::array();
        for (int column = 0; column < 3; ++column)
            line.push_back(axes[column][row] / spacing[column]);
        direction.push_back(line);
    }
    result["dims"] = json::array({grid.dims.x, grid.dims.y, grid.dims.z});
    result["spacing"] = vectorJson(spacing);
    result["origin"] = vectorJson(glm::dvec3(grid.worldFromIndex[3]));
    result["direction"] = direction;
    result["periodic"] = grid.periodic.x || grid.periodic.y || grid.periodic.z;
    result["periodic_axes"] = json::array({grid.periodic.x, grid.periodic.y, grid.periodic.z});
    result["centring"] = grid.centring == Centring::Cell ? "cell" : "point";
    result["box"] = describeBox(grid);
}

void addCrystal(json& result, const Crystal& crystal) {
    result["lattice"] = describeLattice(crystal.lattice);
    json atoms = json::array();
    for (const auto& atom : crystal.atoms)
        atoms.push_back({{"element", elementOf(atom.atomicNumber).symbol},
                         {"number", atom.atomicNumber},
                         {"position", vectorJson(atom.positionWorld)}});
    result["atoms"] = atoms;
    result["comment"] = crystal.comment;
}

json labelsJson(const std::vector<LabelMeta>& labels) {
    json list = json::array();
    for (const auto& label : labels)
        list.push_back({{"value", label.value},
                        {"name", label.name},
                        {"rgb", label.rgb ? vectorJson(*label.rgb) : json(nullptr)}});
    return list;
}

} // namespace

json describeDataset(const DatasetMeta& meta) {
    json result{{"kind", "grid"},
                {"format", meta.format},
                {"type", scalarName(meta.sourceType)},
                {"anatomical", meta.anatomical},
                {"steps", meta.stepCount()},
                {"times", meta.times},
                {"levels", meta.levels()},
                {"notes", meta.notes}};
    addGeometry(result, meta.grid);
    const auto& first = meta.fields.at(0);
    if (!first.steps.empty()) result["range"] = rawRangeJson(first);
    result["value_scale"] = first.valueScale;
    result["value_offset"] = first.valueOffset;
    result["units"] = {{"length", meta.lengthUnit}, {"value", first.unit}};
    result["fields"] = json::array();
    for (const auto& field : meta.fields)
        result["fields"].push_back(fieldJson(field));
    if (meta.crystal) addCrystal(result, *meta.crystal);
    if (!meta.labels.empty()) result["labels"] = labelsJson(meta.labels);
    return result;
}

json describeBox(const Grid& grid) {
    const IndexBox box = boxIndex(grid);
    json edges = json::array();
    for (int axis = 0; axis < 3; ++axis)
        edges.push_back(vectorJson(glm::dvec3(grid.worldFromIndex[axis]) * (box.high[axis] - box.low[axis])));
    return {{"origin", vectorJson(glm::dvec3(grid.worldFromIndex * glm::dvec4(box.low, 1.0)))},
            {"edges", edges},
            {"voxels", vectorJson(box.high - box.low)},
            {"firstSample", vectorJson(glm::dvec3(0.0) - box.low)}};
}

json describeLattice(const glm::dmat3& lattice) {
    return json::array({vectorJson(lattice[0]), vectorJson(lattice[1]), vectorJson(lattice[2])});
}

json describeFrame(const CameraFrame& frame) {
    return {{"centre", vectorJson(frame.centreWorld)},
            {"radius", frame.radiusWorld},
            {"size", frame.sizeWorld ? vectorJson(*frame.sizeWorld) : json(nullptr)}};
}

json describeHistogram(const DatasetMeta& meta, int field, int step) {
    const bool known =
        field >= 0 && static_cast<std::size_t>(field) < meta.fields.size() && step >= 0 &&
        static_cast<std::size_t>(step) < meta.fields[static_cast<std::size_t>(field)].steps.size();
    if (!known)
        throw NotFound("field " + std::to_string(field) + ", step " + std::to_string(step),
                       "the dataset has " + std::to_string(meta.fields.size()) + " fields and " +
                           std::to_string(meta.stepCount()) + " steps");
    const auto& data = meta.fields[static_cast<std::size_t>(field)].steps[static_cast<std::size_t>(step)];
    return {{"low", data.histogram.low},
            {"high", data.histogram.high},
            {"counts", data.histogram.counts},
            {"mean", data.statistics.mean},
            {"min", data.statistics.min},
            {"max", data.statistics.max},
            {"stddev", data.statistics.standardDeviation},
            {"nan", data.statistics.nanCount}};
}

} // namespace voxsheet::engine
