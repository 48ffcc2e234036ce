#include "engine/colour_bar.h"

#include "engine/axis_ticks.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace voxsheet::engine {

namespace {

using nlohmann::json;

} // namespace

const char* scaleName(ValueScale scale) {
    switch (scale) {
    case ValueScale::Log:
        return "log";
    case ValueScale::SymLog:
        return "symlog";
    case ValueScale::Linear:
        break;
    }
    return "linear";
}

bool hasGaps(const FieldMeta& field) {
    return std::any_of(field.steps.begin(), field.steps.end(),
                       [](const FieldStep& step) { return step.statistics.nanCount > 0; });
}

namespace {

json stopsJson(const TransferFunction& function) {
    json stops = json::array();
    for (int i = 0; i < kColourBarStops; ++i) {
        const double position = static_cast<double>(i) / (kColourBarStops - 1);
        const glm::dvec4 colour = evaluateTransfer(function, transferValue(function, position));
        stops.push_back({position, colour.x, colour.y, colour.z, colour.w});
    }
    return stops;
}

json ticksJson(const TransferFunction& function) {
    json ticks = json::array();
    for (const Tick& tick : axisTicks(function, 5))
        ticks.push_back({{"pos", tick.position}, {"value", tick.value}, {"label", tick.label}});
    return ticks;
}

json colourJson(const glm::dvec4& colour) { return {colour.x, colour.y, colour.z, colour.w}; }

/// What a bar of any volume has.
json barJson(const ResolvedTransfer& transfer, const FieldMeta& field) {
    const TransferFunction& function = transfer.function;
    return {{"nan", hasGaps(field) ? colourJson(function.nan) : json(nullptr)},
            {"below", function.hasBelow ? colourJson(function.below) : json(nullptr)},
            {"above", function.hasAbove ? colourJson(function.above) : json(nullptr)},
            {"stops", stopsJson(function)},
            {"low", transferValue(function, 0.0)},
            {"high", function.high},
            {"scale", scaleName(function.scale)},
            {"unit", field.unit},
            {"quantity", field.quantity},
            {"field", field.name},
            {"map", transfer.map != nullptr ? json(transfer.map->name) : json(nullptr)},
            {"ticks", ticksJson(function)}};
}

json isovaluesJson(const IsosurfaceSpec& isosurface, const TransferFunction& function) {
    json isovalues = json::array();
    for (const Isosurface& surface : isosurface.surfaces) {
        const auto position = barPosition(function, surface.value);
        const glm::dvec4 colour(surface.colour);
        isovalues.push_back({{"value", surface.value},
                             {"position", position ? json(*position) : json(nullptr)},
                             {"colour", {colour.x, colour.y, colour.z}},
                             {"opacity", colour.w}});
    }
    return isovalues;
}

const FieldMeta& fieldOf(const DatasetMeta& meta, const FieldAndStep& shown) {
    return meta.fields.at(static_cast<std::size_t>(shown.field));
}

} // namespace

std::optional<double> barPosition(const TransferFunction& function, double value) {
    const double position = transferPosition(function, value);
    if (!(position >= 0.0 && position <= 1.0)) return std::nullopt;
    return position;
}

namespace {

/// Null: no label map.
json labelsJson(const std::optional<LabelTable>& table) {
    if (!table) return nullptr;
    json labels = json::array();
    for (const Label& label : table->labels)
        labels.push_back({{"value", label.value},
                          {"name", label.name},
                          {"colour", {label.rgb.x, label.rgb.y, label.rgb.z}},
                          {"hidden", label.hidden}});
    return labels;
}

} // namespace

nlohmann::json describeColourBar(const CellLook& look) {
    json bar = barJson(look.transfer, fieldOf(*look.meta, look.shown));
    json opacity = json::array();
    for (const OpacityPoint& point : look.transfer.function.opacities)
        opacity.push_back({point.position, point.opacity});
    bar["opacity"] = std::move(opacity);
    bar["diverging"] = look.transfer.diverging;
    bar["shared"] = look.sharedRange;
    bar["isovalues"] = isovaluesJson(look.isosurface, look.transfer.function);
    bar["colouredBy"] = nullptr;
    if (const auto& by = look.colouredBy)
        bar["colouredBy"] = barJson(by->transfer, fieldOf(*by->meta, by->shown));
    bar["labels"] = labelsJson(look.labels);
    bar["layers"] = json::array();
    for (const LayerLook& layer : look.layers) {
        json each = barJson(layer.transfer, fieldOf(*layer.meta, layer.shown));
        each["name"] = layer.name;
        each["weight"] = layer.weight;
        each["labels"] = labelsJson(layer.labels);
        bar["layers"].push_back(std::move(each));
    }
    return bar;
}

} // namespace voxsheet::engine
