#include "engine/cell_resolver.h"

#include "base/errors.h"
#include "engine/axis_ticks.h"
#include "engine/clip_resolver.h"
#include "engine/crosshair.h"
#include "engine/crystal_resolver.h"
#include "engine/lattice_planes.h"
#include "engine/plane_resolver.h"
#include "engine/shading_resolver.h"
#include "sheet/camera.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include <glm/gtc/constants.hpp>

namespace voxsheet::engine {

namespace {

glm::dvec4 opaqueOf(const sheet::Colour& colour) {
    return {colour.red(), colour.green(), colour.blue(), colour.alpha()};
}

ValueWindow fixedWindow(const sheet::RangeStyle& range, const ValueSummary& summary) {
    const ValueWindow own = fullWindow(summary.min, summary.max);
    const ValueWindow window{range.min.value_or(own.low), range.max.value_or(own.high)};
    if (window.low < window.high) return window;
    throw InvalidInput("range of the cell",
                       "range.min is not below range.max once the data's own ends are filled in",
                       "set both, or choose range.mode own")
        .withField(range.min ? "range.min" : "range.max");
}

ValueWindow percentiles(const sheet::RangeStyle& range, const ValueSummary& summary) {
    const double low = summary.quantile(range.min.value_or(0.5) / 100.0);
    const double high = summary.quantile(range.max.value_or(99.5) / 100.0);
    return fullWindow(low, std::max(low, high));
}

bool isSymmetric(const ValueWindow& window) {
    return window.low < 0.0 && std::abs(window.low + window.high) <= 1e-6 * (window.high - window.low);
}

const ColourMap& mapNamed(const ColourMapTable& maps, const std::string& name) {
    if (const ColourMap* map = maps.find(name)) return *map;
    throw InvalidInput("transfer.map", "there is no colour map '" + name + "'",
                       "choose one of the listed maps")
        .withField("transfer.map");
}

/// Puts the neutral colour of a diverging map at the value 0 where the range holds it.
void movePivot(std::vector<ColourPoint>& colours, double pivot, double zero) {
    for (ColourPoint& stop : colours) {
        stop.position = stop.position <= pivot
                            ? stop.position / pivot * zero
                            : zero + (stop.position - pivot) / (1.0 - pivot) * (1.0 - zero);
    }
}

struct RangeChoice {
    ValueWindow window;
    bool diverging = false;
};

RangeChoice rangeByMode(const sheet::RangeStyle& range, const ColourMap* map, const ValueSummary& summary) {
    const bool signedData = opensDiverging(summary);
    switch (range.mode) {
    case sheet::RangeMode::Own: {
        const ValueWindow window = fullWindow(summary.min, summary.max);
        return {window, signedData};
    }
    case sheet::RangeMode::Fixed: {
        const ValueWindow window = fixedWindow(range, summary);
        return {window, signedData && window.low < 0.0 && window.high > 0.0};
    }
    case sheet::RangeMode::Percentile: {
        const ValueWindow window = percentiles(range, summary);
        return {window, signedData && window.low < 0.0 && window.high > 0.0};
    }
    case sheet::RangeMode::Symmetric:
        return {symmetricWindow(fullWindow(summary.min, summary.max)), true};
    case sheet::RangeMode::Auto:
    case sheet::RangeMode::Shared:
        break;
    }
    if (map != nullptr && map->kind == ColourMapKind::Ct)
        return {{map->window.first, map->window.second}, false};
    return {defaultWindow(summary), signedData};
}

RangeChoice chooseRange(const sheet::RangeStyle& range, const ColourMap* map, const ValueSummary& summary) {
    const RangeChoice choice = rangeByMode(range, map, summary);
    if (!range.symmetric || range.mode == sheet::RangeMode::Fixed) return choice;
    return {symmetricWindow(choice.window), true};
}

Technique drawnTechnique(sheet::Technique technique) {
    switch (technique) {
    case sheet::Technique::Slices:
        return Technique::Slices;
    case sheet::Technique::Mip:
        return Technique::Mip;
    case sheet::Technique::Surface:
        return Technique::Surface;
    case sheet::Technique::Isosurface:
        return Technique::Isosurface;
    case sheet::Technique::Plane:
        return Technique::Plane;
    case sheet::Technique::Raycast:
        break;
    }
    return Technique::Raycast;
}

} // namespace

FieldAndStep chooseField(const sheet::FieldChoice& choice, int timeStep, const DatasetMeta& meta) {
    FieldAndStep shown;
    shown.step = std::clamp(timeStep, 0, std::max(0, meta.stepCount() - 1));
    if (const auto* index = std::get_if<std::int64_t>(&choice)) {
        if (*index >= 0 && *index < static_cast<std::int64_t>(meta.fields.size())) {
            shown.field = static_cast<int>(*index);
            return shown;
        }
    } else {
        const std::string& name = std::get<std::string>(choice);
        for (std::size_t i = 0; i < meta.fields.size(); ++i) {
            if (meta.fields[i].name == name) {
                shown.field = static_cast<int>(i);
                return shown;
            }
        }
    }
    std::string names;
    for (const FieldMeta& field : meta.fields)
        names += (names.empty() ? "" : ", ") + field.name;
    const bool byIndex = std::holds_alternative<std::int64_t>(choice);
    const std::string asked = byIndex ? "number " + std::to_string(std::get<std::int64_t>(choice))
                                      : "'" + std::get<std::string>(choice) + "'";
    throw InvalidInput("field " + asked, "this dataset has no such field", "choose one of: " + names)
        .withField("field");
}

ResolvedTransfer resolveTransfer(const sheet::ResolvedStyle& resolved, const ColourMapTable& maps,
                                 const ValueSummary& summary, double boxPathUnitLengths) {
    const sheet::TypedStyle& style = resolved.style;
    const sheet::TransferStyle& transfer = style.transfer;
    const bool automaticMap = transfer.map == "auto";
    ResolvedTransfer result;
    result.map = automaticMap ? nullptr : &mapNamed(maps, transfer.map);
    const RangeChoice range = chooseRange(style.range, result.map, summary);
    result.diverging = range.diverging;
    if (automaticMap) result.map = &mapNamed(maps, range.diverging ? "cool-warm" : "viridis");

    TransferFunction& function = result.function;
    function.low = range.window.low;
    function.high = range.window.high;
    function.scale = style.range.scale;
    if (function.scale == ValueScale::Log && function.high <= 0.0) {
        throw InvalidInput("range.scale",
                           "a logarithmic scale needs values above 0, and the range ends at " +
                               numberLabel(function.high, 0.0),
                           "choose linear or symlog")
            .withField("range.scale");
    }
    function.shape = transfer.shape;
    function.cut1 = transfer.cut1;
    function.cut2 = transfer.cut2;
    // A range that was typed in is window and level: a CT map is stretched over it.
    const bool anchored = style.range.mode != sheet::RangeMode::Fixed;
    function.colours = coloursOverRange(*result.map, function.low, function.high, anchored);
    if (result.map->kind == ColourMapKind::Diverging && function.low < 0.0 && function.high > 0.0 &&
        !isSymmetric(range.window)) {
        movePivot(function.colours, result.map->pivot, transferPosition(function, 0.0));
    }
    if (transfer.points) {
        function.colours.clear();
        for (const auto& stop : *transfer.points) {
            function.colours.push_back({stop.position, glm::dvec3(opaqueOf(stop.colour))});
        }
        result.map = nullptr;
    }
    if (function.shape != TransferShape::Piecewise) result.map = nullptr;

    const sheet::StyleValue& opacity = resolved.values.at("transfer.opacity").value;
    if (const auto* stops = std::get_if<sheet::OpacityStops>(&opacity)) {
        for (const auto& stop : *stops)
            function.opacities.push_back({stop.position, stop.opacity});
    } else if (result.map != nullptr && result.map->kind == ColourMapKind::Ct) {
        function.opacities = opacitiesOverRange(*result.map, function.low, function.high, anchored);
    } else if (style.technique == sheet::Technique::Mip) {
        function.opacities = defaultProjectionOpacity(summary, function, result.diverging);
    } else {
        function.opacities = defaultOpacity(summary, function, result.diverging, boxPathUnitLengths);
    }
    function.nan = opaqueOf(transfer.nan);
    function.hasBelow = transfer.below.has_value();
    function.hasAbove = transfer.above.has_value();
    if (transfer.below) function.below = opaqueOf(*transfer.below);
    if (transfer.above) function.above = opaqueOf(*transfer.above);
    return result;
}

double boxPathUnitLengths(const Grid& grid) {
    const IndexBox box = boxIndex(grid);
    double edges = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        edges += glm::length(glm::dvec3(grid.worldFromIndex[axis])) * (box.high[axis] - box.low[axis]);
    }
    return std::max(edges / 3.0 / meanVoxelEdgeWorld(grid), 1e-6);
}

ValueSummary mergeSummaries(const std::vector<ValueSummary>& summaries) {
    ValueSummary merged;
    bool integers = !summaries.empty();
    bool first = true;
    std::vector<float> values;
    for (const ValueSummary& each : summaries) {
        merged.min = first ? each.min : std::min(merged.min, each.min);
        merged.max = first ? each.max : std::max(merged.max, each.max);
        first = false;
        integers = integers && each.integers;
        for (const double value : each.quantiles)
            values.push_back(static_cast<float>(value));
    }
    merged = summariseValues(values, merged.min, merged.max);
    merged.integers = integers;
    return merged;
}

CameraSpec resolveCamera(const sheet::CameraStyle& camera, const CameraFrame& frame, glm::ivec2 sizePixels) {
    const sheet::CameraPose pose = sheet::cameraPose(camera, frame.centreWorld, frame.radiusWorld);
    const double aspect = static_cast<double>(sizePixels.x) / static_cast<double>(sizePixels.y);
    const double narrow = std::min(1.0, aspect);
    CameraSpec spec;
    spec.viewFromWorld = pose.viewFromWorld;
    spec.projection = camera.projection == sheet::Projection::Orthographic ? Projection::Orthographic
                                                                           : Projection::Perspective;
    const double half = glm::radians(camera.fovDegrees) / 2.0;
    spec.fovYDegrees = glm::degrees(2.0 * std::atan(std::tan(half) / narrow));
    spec.heightWorld = pose.orthographicHeightWorld / narrow;
    return spec;
}

namespace {

bool isLinked(const sheet::ResolvedStyle& resolved, const char* key) {
    const auto found = resolved.values.find(key);
    if (found == resolved.values.end()) return false;
    switch (found->second.origin.kind) {
    case sheet::LayerKind::Sheet:
    case sheet::LayerKind::PageView:
    case sheet::LayerKind::Column:
    case sheet::LayerKind::Row:
        return true;
    default:
        return false;
    }
}

/// Sets `value` to `neutral` where the grid is not periodic; true if that changed anything.
bool neutralWhereNotPeriodic(glm::dvec3& value, double neutral, const Grid& grid) {
    bool changed = false;
    for (int axis = 0; axis < 3; ++axis) {
        if (grid.periodic[axis] || value[axis] == neutral) continue;
        value[axis] = neutral;
        changed = true;
    }
    return changed;
}

} // namespace

std::string dropLinkedPeriods(sheet::ResolvedStyle& resolved, const Grid& grid) {
    auto& periodic = resolved.style.periodic;
    std::string keys;
    if (isLinked(resolved, "periodic.shift") && neutralWhereNotPeriodic(periodic.shift, 0.0, grid))
        keys = "periodic.shift";
    if (isLinked(resolved, "periodic.replicate") && neutralWhereNotPeriodic(periodic.replicate, 1.0, grid))
        keys += (keys.empty() ? "" : " and ") + std::string("periodic.replicate");
    if (keys.empty()) return {};
    const bool some = grid.periodic.x || grid.periodic.y || grid.periodic.z;
    return keys + (some ? " of the linked cells applies to the periodic axes of these data only"
                        : " of the linked cells does not apply here: these data are not periodic");
}

PeriodicWindow periodicWindow(const sheet::PeriodicStyle& style) {
    return {style.shift, glm::ivec3(glm::round(style.replicate))};
}

PeriodicWindow resolvePeriodicWindow(const sheet::PeriodicStyle& style, const Grid& grid) {
    PeriodicWindow window = periodicWindow(style);
    validatePeriodicWindow(window, grid);
    window.shift = wrappedShift(window);
    return window;
}

TileSpec resolveTile(const sheet::TypedStyle& style, const DatasetMeta& meta, const FieldAndStep& shown,
                     std::shared_ptr<const TransferTable> table, glm::ivec2 sizePixels, int level,
                     double sampleDistanceFactor, const std::optional<CameraFrame>& linked) {
    TileSpec spec;
    spec.dataset = meta.key;
    spec.field = shown.field;
    spec.step = shown.step;
    const int wanted = style.level.value_or(std::max(level, static_cast<int>(style.quality)));
    spec.level = std::clamp(wanted, 0, meta.levels() - 1);
    spec.technique = drawnTechnique(style.technique);
    spec.periodic = resolvePeriodicWindow(style.periodic, meta.grid);
    spec.crystal = resolveCrystal(style.crystal, meta);
    const Grid drawn = drawnGrid(meta.grid, spec.periodic);
    const bool flat = style.technique == sheet::Technique::Plane;
    const CameraFrame frame = linked.value_or(ownFrame(drawn));
    const sheet::PlaneStyle plane = flat ? withLatticeNormal(style.plane, meta) : style.plane;
    if (!flat) spec.crosshairWorld = crosshairWorld(style.plane, drawn);
    spec.camera = flat ? resolvePlaneCamera(plane, style.camera, drawn, meta.anatomical, sizePixels, frame)
                       : resolveCamera(style.camera, frame, sizePixels);
    spec.transfer = std::move(table);
    spec.unitLengthWorld = style.transfer.unitLengthWorld.value_or(meanVoxelEdgeWorld(meta.grid));
    spec.sampleDistanceVoxels = std::clamp(style.sampleDistanceVoxels * sampleDistanceFactor, 0.01, 64.0);
    spec.adaptiveSampling = style.adaptiveSampling;
    if (style.preIntegrated) spec.classification = Classification::PreIntegrated;
    spec.background = glm::vec4(opaqueOf(style.background));
    spec.sizePixels = sizePixels;
    if (flat)
        spec.plane = resolvePlane(plane, drawn);
    else
        spec.clip.planes = resolveClipPlanes(style.clip, drawn);
    spec.shading = resolveShading(style, spec.camera);
    spec.floatTexels =
        style.textureFormat == sheet::TextureFormat::Half ? FloatTexels::Half : FloatTexels::Full;
    return spec;
}

} // namespace voxsheet::engine
