#include "store/meta_json.h"

#include "base/errors.h"
#include "volume/statistics.h"

#include <climits>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace voxsheet::store {

namespace {

using nlohmann::json;

double finite(double number, const char* what) {
    if (!std::isfinite(number)) throw InvalidInput(what, "it is not a finite number");
    return number;
}

std::int64_t wholeFromJson(const json& j, const char* what, std::int64_t low, std::int64_t high) {
    const bool beyond = j.is_number_unsigned() && j.get<std::uint64_t>() > static_cast<std::uint64_t>(high);
    if (!j.is_number_integer() || beyond || j.get<std::int64_t>() < low || j.get<std::int64_t>() > high) {
        throw InvalidInput(what, "it must be a whole number from " + std::to_string(low) + " to " +
                                     std::to_string(high));
    }
    return j.get<std::int64_t>();
}

json vectorToJson(const glm::dvec3& v, const char* what) {
    return json::array({finite(v.x, what), finite(v.y, what), finite(v.z, what)});
}

glm::dvec3 vectorFromJson(const json& j) {
    return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

json gridToJson(const Grid& grid) {
    json matrix = json::array();
    for (int column = 0; column < 4; ++column)
        matrix.push_back(vectorToJson(glm::dvec3(grid.worldFromIndex[column]), "grid geometry"));
    return {{"dims", {grid.dims.x, grid.dims.y, grid.dims.z}},
            {"world_from_index_columns", matrix},
            {"centring", grid.centring == Centring::Cell ? "cell" : "point"},
            {"periodic", {grid.periodic.x, grid.periodic.y, grid.periodic.z}}};
}

Grid gridFromJson(const json& j) {
    Grid grid;
    for (int axis = 0; axis < 3; ++axis) {
        const auto& size = j.at("dims").at(static_cast<std::size_t>(axis));
        grid.dims[axis] = static_cast<int>(wholeFromJson(size, "dims", 1, 1 << 24));
        grid.periodic[axis] = j.at("periodic").at(static_cast<std::size_t>(axis)).get<bool>();
    }
    for (int column = 0; column < 4; ++column)
        grid.worldFromIndex[column] =
            glm::dvec4(vectorFromJson(j.at("world_from_index_columns").at(static_cast<std::size_t>(column))),
                       column == 3 ? 1.0 : 0.0);
    grid.centring = j.at("centring").get<std::string>() == "cell" ? Centring::Cell : Centring::Point;
    validateGrid(grid);
    return grid;
}

ScalarType typeFromJson(const json& j) {
    const auto type = scalarFromName(j.get<std::string>());
    if (!type) throw InvalidInput("scalar type", "unknown name");
    return *type;
}

json stepToJson(const FieldStep& step) {
    const auto& s = step.statistics;
    return {{"min", finite(s.min, "statistics")},
            {"max", finite(s.max, "statistics")},
            {"mean", finite(s.mean, "statistics")},
            {"standard_deviation", finite(s.standardDeviation, "statistics")},
            {"finite_count", s.finiteCount},
            {"nan_count", s.nanCount},
            {"histogram",
             {{"low", finite(step.histogram.low, "histogram")},
              {"high", finite(step.histogram.high, "histogram")},
              {"counts", step.histogram.counts}}}};
}

FieldStep stepFromJson(const json& j) {
    FieldStep step;
    step.statistics.min = j.at("min").get<double>();
    step.statistics.max = j.at("max").get<double>();
    step.statistics.mean = j.at("mean").get<double>();
    step.statistics.standardDeviation = j.at("standard_deviation").get<double>();
    step.statistics.finiteCount = countFromJson(j.at("finite_count"), "finite_count");
    step.statistics.nanCount = countFromJson(j.at("nan_count"), "nan_count");
    const auto& histogram = j.at("histogram");
    step.histogram.low = histogram.at("low").get<double>();
    step.histogram.high = histogram.at("high").get<double>();
    for (const auto& count : histogram.at("counts").get_ref<const json::array_t&>()) // throws for no list
        step.histogram.counts.push_back(countFromJson(count, "histogram"));
    if (step.histogram.counts.size() != static_cast<std::size_t>(kHistogramBins))
        throw InvalidInput("histogram", "it has not " + std::to_string(kHistogramBins) + " bins");
    return step;
}

json fieldToJson(const FieldMeta& field) {
    json steps = json::array();
    for (const auto& step : field.steps)
        steps.push_back(stepToJson(step));
    return {{"name", field.name},
            {"quantity", field.quantity},
            {"unit", field.unit},
            {"stored_type", scalarName(field.storedType)},
            {"value_scale", finite(field.valueScale, "value scale")},
            {"value_offset", finite(field.valueOffset, "value offset")},
            {"steps", steps}};
}

FieldMeta fieldFromJson(const json& j) {
    FieldMeta field;
    field.name = j.at("name").get<std::string>();
    field.quantity = j.at("quantity").get<std::string>();
    field.unit = j.at("unit").get<std::string>();
    field.storedType = typeFromJson(j.at("stored_type"));
    field.valueScale = j.at("value_scale").get<double>();
    field.valueOffset = j.at("value_offset").get<double>();
    for (const auto& step : j.at("steps"))
        field.steps.push_back(stepFromJson(step));
    return field;
}

json crystalToJson(const Crystal& crystal) {
    json atoms = json::array();
    for (const auto& atom : crystal.atoms)
        atoms.push_back(
            {{"atomic_number", atom.atomicNumber}, {"position", vectorToJson(atom.positionWorld, "atom")}});
    json lattice = json::array();
    for (int column = 0; column < 3; ++column)
        lattice.push_back(vectorToJson(crystal.lattice[column], "lattice"));
    return {{"lattice", lattice}, {"atoms", atoms}, {"comment", crystal.comment}};
}

Crystal crystalFromJson(const json& j) {
    Crystal crystal;
    for (int column = 0; column < 3; ++column)
        crystal.lattice[column] = vectorFromJson(j.at("lattice").at(static_cast<std::size_t>(column)));
    for (const auto& atom : j.at("atoms")) {
        const auto number = wholeFromJson(atom.at("atomic_number"), "atomic_number", INT_MIN, INT_MAX);
        crystal.atoms.push_back({static_cast<int>(number), vectorFromJson(atom.at("position"))});
    }
    crystal.comment = j.at("comment").get<std::string>();
    return crystal;
}

json labelToJson(const LabelMeta& label) {
    json j{{"value", label.value}, {"name", label.name}};
    if (label.rgb) j["rgb"] = vectorToJson(*label.rgb, "colour of a label");
    return j;
}

LabelMeta labelFromJson(const json& j) {
    LabelMeta label{wholeFromJson(j.at("value"), "value of a label", INT64_MIN, INT64_MAX),
                    j.at("name").get<std::string>(), std::nullopt};
    if (j.contains("rgb")) label.rgb = vectorFromJson(j.at("rgb"));
    return label;
}

DatasetMeta parseMeta(const json& j) {
    DatasetMeta meta;
    meta.sourcePath = j.at("source_path").get<std::string>();
    meta.format = j.at("format").get<std::string>();
    meta.grid = gridFromJson(j.at("grid"));
    meta.sourceType = typeFromJson(j.at("source_type"));
    meta.lengthUnit = j.at("length_unit").get<std::string>();
    meta.anatomical = j.at("anatomical").get<bool>();
    for (const auto& field : j.at("fields"))
        meta.fields.push_back(fieldFromJson(field));
    meta.times = j.at("times").get<std::vector<double>>();
    meta.notes = j.at("notes").get<std::vector<std::string>>();
    if (j.contains("crystal")) meta.crystal = crystalFromJson(j.at("crystal"));
    if (j.contains("labels"))
        for (const auto& label : j.at("labels").get<json::array_t>()) // throws for what is no list
            meta.labels.push_back(labelFromJson(label));
    if (meta.fields.empty() || meta.times.empty())
        throw InvalidInput("dataset", "it has no field or no time step");
    return meta;
}

} // namespace

nlohmann::json metaToJson(const DatasetMeta& meta) {
    json fields = json::array();
    for (const auto& field : meta.fields)
        fields.push_back(fieldToJson(field));
    for (const double time : meta.times)
        finite(time, "time");
    json j{{"source_path", meta.sourcePath},
           {"format", meta.format},
           {"grid", gridToJson(meta.grid)},
           {"source_type", scalarName(meta.sourceType)},
           {"length_unit", meta.lengthUnit},
           {"anatomical", meta.anatomical},
           {"fields", fields},
           {"times", meta.times},
           {"notes", meta.notes}};
    if (meta.crystal) j["crystal"] = crystalToJson(*meta.crystal);
    for (const auto& label : meta.labels)
        j["labels"].push_back(labelToJson(label));
    return j;
}

DatasetMeta metaFromJson(const nlohmann::json& j) {
    try {
        return parseMeta(j);
    } catch (const json::exception& error) {
        throw InvalidInput("description of a dataset", error.what());
    }
}

std::uint64_t countFromJson(const nlohmann::json& j, const char* what) {
    if (j.is_number_unsigned()) return j.get<std::uint64_t>();
    return static_cast<std::uint64_t>(wholeFromJson(j, what, 0, INT64_MAX));
}

nlohmann::json parseJson(std::string_view text, std::string_view what) {
    constexpr int deepest = 32;
    const auto checkDepth = [&](int depth, json::parse_event_t, const json&) {
        if (depth > deepest) throw InvalidInput(std::string(what), "it is nested too deeply");
        return true;
    };
    try {
        return json::parse(text.begin(), text.end(), checkDepth);
    } catch (const json::exception& error) {
        throw InvalidInput(std::string(what), std::string("it is not valid JSON: ") + error.what());
    }
}

} // namespace voxsheet::store
