#include "engine/colour_bar.h"

#include "engine/axis_ticks.h"

#include <nlohmann/json.hpp>

namespace voxsheet::engine {

namespace {

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

} // namespace

nlohmann::json describeColourBar(const CellLook& look) {
    using nlohmann::json;
    const TransferFunction& function = look.transfer.function;
    const FieldMeta& field = look.meta->fields.at(static_cast<std::size_t>(look.shown.field));
    json stops = json::array();
    for (int i = 0; i < kColourBarStops; ++i) {
        const double position = static_cast<double>(i) / (kColourBarStops - 1);
        const glm::dvec4 colour = evaluateTransfer(function, transferValue(function, position));
        stops.push_back({position, colour.x, colour.y, colour.z, colour.w});
    }
    json opacity = json::array();
    for (const OpacityPoint& point : function.opacities)
        opacity.push_back({point.position, point.opacity});
    json ticks = json::array();
    for (const Tick& tick : axisTicks(function, 5)) {
        ticks.push_back({{"pos", tick.position}, {"value", tick.value}, {"label", tick.label}});
    }
    return {{"stops", std::move(stops)},
            {"opacity", std::move(opacity)},
            {"low", transferValue(function, 0.0)},
            {"high", function.high},
            {"scale", scaleName(function.scale)},
            {"unit", field.unit},
            {"quantity", field.quantity},
            {"field", field.name},
            {"map", look.transfer.map != nullptr ? json(look.transfer.map->name) : json(nullptr)},
            {"diverging", look.transfer.diverging},
            {"shared", look.sharedRange},
            {"ticks", std::move(ticks)}};
}

} // namespace voxsheet::engine
