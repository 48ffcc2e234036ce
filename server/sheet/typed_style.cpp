#include "sheet/typed_style.h"

#include "base/errors.h"
#include "sheet/label_names.h"
#include "sheet/number_text.h"
#include "sheet/style.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace voxsheet::sheet {

namespace {

/// Words of a choice in the order of the enum: the key table and this list must agree, which a test checks.
template <typename Enum, std::size_t N>
Enum enumOf(const std::array<std::string_view, N>& words, const std::string& word, const char* key) {
    const auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end()) throw InternalError(key, "has no meaning for \"" + word + "\"");
    return static_cast<Enum>(found - words.begin());
}

class Reader {
public:
    explicit Reader(const ResolvedValues& values) : values_(values) {}

    template <typename T>
    [[nodiscard]] const T& get(const char* key) const {
        const T* value = std::get_if<T>(&value_(key));
        if (!value) throw InternalError(key, "has a value of another type");
        return *value;
    }
    /// Not set for "none" and "auto".
    template <typename T>
    [[nodiscard]] std::optional<T> find(const char* key) const {
        const StyleValue& value = value_(key);
        if (std::holds_alternative<None>(value) || std::holds_alternative<Automatic>(value))
            return std::nullopt;
        return get<T>(key);
    }
    template <typename Enum, std::size_t N>
    [[nodiscard]] Enum choice(const char* key, const std::array<std::string_view, N>& words) const {
        if (std::holds_alternative<Automatic>(value_(key))) return enumOf<Enum>(words, "auto", key);
        return enumOf<Enum>(words, get<std::string>(key), key);
    }
    /// Empty for "none" and "auto".
    [[nodiscard]] std::vector<std::vector<double>> rows(const char* key) const {
        return find<NumberTable>(key).value_or(NumberTable{}).rows;
    }
    [[nodiscard]] FieldChoice field(const char* key) const {
        if (const auto* name = std::get_if<std::string>(&value_(key))) return *name;
        return get<std::int64_t>(key);
    }

private:
    [[nodiscard]] const StyleValue& value_(const char* key) const {
        const auto found = values_.find(key);
        if (found == values_.end()) throw InternalError(key, "has no value");
        return found->second.value;
    }
    const ResolvedValues& values_;
};

using Words2 = std::array<std::string_view, 2>;
using Words3 = std::array<std::string_view, 3>;
using Words4 = std::array<std::string_view, 4>;
using Words5 = std::array<std::string_view, 5>;
using Words6 = std::array<std::string_view, 6>;

constexpr Words6 kTechniques{"slices", "raycast", "mip", "surface", "isosurface", "plane"};
constexpr Words2 kProjections{"perspective", "orthographic"};
constexpr Words4 kShapes{"piecewise", "linear", "exponential", "parabolic"};
constexpr Words6 kRangeModes{"auto", "own", "shared", "fixed", "percentile", "symmetric"};
constexpr Words3 kScales{"linear", "log", "symlog"};
constexpr Words4 kQualities{"full", "half", "quarter", "eighth"};
constexpr Words3 kAnnotations{"none", "names", "all"};
constexpr Words2 kTransferSampling{"samples", "mean"};
constexpr Words2 kSwitch{"off", "on"};
constexpr Words3 kBondReaches{"none", "inside", "across"};
constexpr Words2 kClipUnits{"fraction", "world"};
constexpr Words2 kClipModes{"probe", "clip"};
constexpr Words2 kClipRepresentations{"distance", "binary"};
constexpr Words2 kIsosurfaceMethods{"refined", "alphatest"};
constexpr Words3 kShadingModels{"auto", "none", "phong"};
constexpr Words3 kGradients{"auto", "texture", "onthefly"};
constexpr Words2 kLightFrames{"view", "world"};
constexpr Words2 kTextureFormats{"auto", "half"};
constexpr Words5 kPlaneAxes{"axial", "coronal", "sagittal", "custom", "hkl"};
constexpr Words3 kFrames{"fit", "centre", "world"};
constexpr Words2 kPlaneUnits{"fraction", "world"};
constexpr Words2 kPlaneInterpolations{"linear", "nearest"};

CameraStyle cameraOf(const Reader& read) {
    CameraStyle camera;
    camera.azimuthDegrees = read.get<double>("camera.azimuth");
    camera.elevationDegrees = read.get<double>("camera.elevation");
    camera.rollDegrees = read.get<double>("camera.roll");
    camera.distanceRadii = read.get<double>("camera.distance");
    camera.targetRadii = read.get<glm::dvec3>("camera.target");
    camera.fovDegrees = read.get<double>("camera.fov");
    camera.projection = read.choice<Projection>("camera.projection", kProjections);
    camera.frame = read.choice<FrameMode>("camera.frame", kFrames);
    return camera;
}

TransferStyle transferOf(const Reader& read) {
    TransferStyle transfer;
    transfer.map = read.get<std::string>("transfer.map");
    transfer.opacity = read.find<OpacityStops>("transfer.opacity");
    transfer.points = read.find<ColourStops>("transfer.points");
    transfer.cut1 = read.get<double>("transfer.cut1");
    transfer.cut2 = read.get<double>("transfer.cut2");
    transfer.shape = read.choice<TransferShape>("transfer.shape", kShapes);
    transfer.unitLengthWorld = read.find<double>("transfer.unitLength");
    transfer.nan = read.get<Colour>("transfer.nanColor");
    transfer.below = read.find<Colour>("transfer.belowColor");
    transfer.above = read.find<Colour>("transfer.aboveColor");
    return transfer;
}

glm::dvec3 vectorAt(const std::vector<double>& row, std::size_t first) {
    return {row.at(first), row.at(first + 1), row.at(first + 2)};
}

ClipStyle clipOf(const Reader& read) {
    ClipStyle clip;
    clip.units = read.choice<ClipUnits>("clip.units", kClipUnits);
    for (const auto& row : read.rows("clip.planes"))
        clip.planes.push_back({vectorAt(row, 0), row.at(3)});
    if (const auto rows = read.rows("clip.box"); !rows.empty()) {
        const auto& b = rows.front();
        clip.box = ClipStyle::Box{{b.at(0), b.at(2), b.at(4)}, {b.at(1), b.at(3), b.at(5)}};
    }
    clip.shape = read.find<std::string>("clip.shape").value_or("");
    clip.mode = read.choice<ClipMode>("clip.mode", kClipModes);
    clip.representation = read.choice<ClipRepresentation>("clip.representation", kClipRepresentations);
    const auto transform = read.rows("clip.transform").at(0);
    clip.transform = {vectorAt(transform, 0), vectorAt(transform, 3), vectorAt(transform, 6)};
    return clip;
}

std::vector<double> columnOf(const std::vector<std::vector<double>>& rows) {
    std::vector<double> column;
    for (const auto& row : rows)
        column.push_back(row.at(0));
    return column;
}

IsosurfaceStyle isosurfaceOf(const Reader& read) {
    IsosurfaceStyle isosurface;
    isosurface.values = columnOf(read.rows("isovalue"));
    isosurface.mirror = read.choice<int>("isosurface.mirror", kSwitch) == 1;
    isosurface.colours = read.find<ColourList>("isosurface.colors").value_or(ColourList{});
    isosurface.opacities = columnOf(read.rows("isosurface.opacity"));
    isosurface.colourBy = read.find<std::string>("isosurface.colorBy").value_or("");
    isosurface.caps = read.choice<int>("isosurface.caps", kSwitch) == 1;
    isosurface.method = read.choice<IsosurfaceMethod>("isosurface.method", kIsosurfaceMethods);
    return isosurface;
}

LayersStyle layersOf(const Reader& read) {
    return {read.find<std::string>("layers").value_or(""), columnOf(read.rows("layers.weights"))};
}

LabelsStyle labelsOf(const Reader& read) {
    LabelsStyle labels;
    labels.show = read.choice<int>("labels.show", kSwitch) == 1;
    labels.names = read.find<std::string>("labels.names").value_or("");
    for (const double value : columnOf(read.rows("labels.hide")))
        labels.hidden.insert(static_cast<std::int64_t>(std::clamp(std::round(value), -9e15, 9e15)));
    labels.opacity = read.get<double>("labels.opacity");
    return labels;
}

OverlayStyle overlayOf(const Reader& read) {
    OverlayStyle overlay;
    overlay.volume = read.find<std::string>("overlay.dataset").value_or("");
    overlay.map = read.get<std::string>("overlay.map");
    overlay.opacity = read.get<double>("overlay.opacity");
    overlay.threshold = read.find<double>("overlay.threshold");
    overlay.min = read.find<double>("overlay.min");
    overlay.max = read.find<double>("overlay.max");
    return overlay;
}

CrystalStyle crystalOf(const Reader& read) {
    CrystalStyle crystal;
    crystal.cell = read.choice<int>("crystal.cell", kSwitch) == 1;
    crystal.atoms = read.choice<int>("crystal.atoms", kSwitch) == 1;
    crystal.bonds = read.choice<BondReach>("crystal.bonds", kBondReaches);
    crystal.radius = read.get<double>("crystal.radius");
    return crystal;
}

PlaneStyle planeOf(const Reader& read) {
    PlaneStyle plane;
    plane.axis = read.choice<PlaneAxis>("plane.axis", kPlaneAxes);
    plane.normal = read.get<glm::dvec3>("plane.normal");
    plane.hkl = read.get<glm::dvec3>("plane.hkl");
    plane.position = read.get<double>("plane.position");
    plane.interpolation = read.choice<PlaneInterpolation>("plane.interpolation", kPlaneInterpolations);
    plane.crosshair = read.find<glm::dvec3>("plane.crosshair");
    plane.units = read.choice<PlaneUnits>("plane.units", kPlaneUnits);
    return plane;
}

ShadingStyle shadingOf(const Reader& read) {
    ShadingStyle shading;
    shading.model = read.choice<ShadingModel>("shading.model", kShadingModels);
    shading.gradient = read.choice<GradientSource>("shading.gradient", kGradients);
    shading.ambient = read.get<double>("shading.ambient");
    shading.diffuse = read.get<double>("shading.diffuse");
    shading.specular = read.get<double>("shading.specular");
    shading.shininess = read.get<double>("shading.shininess");
    return shading;
}

LightStyle lightOf(const Reader& read) {
    LightStyle light;
    light.head = read.get<double>("light.head");
    for (const auto& row : read.rows("light.direction"))
        light.directions.push_back(vectorAt(row, 0));
    light.frame = read.choice<LightFrame>("light.frame", kLightFrames);
    light.intensity = read.get<double>("light.intensity");
    return light;
}

} // namespace

TypedStyle typedStyle(const ResolvedValues& values) {
    const Reader read(values);
    TypedStyle style;
    style.technique = read.choice<Technique>("technique", kTechniques);
    style.camera = cameraOf(read);
    style.transfer = transferOf(read);
    style.range.mode = read.choice<RangeMode>("range.mode", kRangeModes);
    style.range.min = read.find<double>("range.min");
    style.range.max = read.find<double>("range.max");
    style.range.scale = read.choice<ValueScale>("range.scale", kScales);
    style.range.symmetric = read.choice<int>("range.symmetric", kSwitch) == 1;
    style.sampleDistanceVoxels = read.get<double>("sampling.distance");
    style.preIntegrated = read.choice<int>("sampling.transfer", kTransferSampling) == 1;
    style.adaptiveSampling = read.choice<int>("sampling.adaptive", kSwitch) == 1;
    style.quality = read.choice<Quality>("quality", kQualities);
    if (const auto level = read.find<std::int64_t>("level")) style.level = static_cast<int>(*level);
    style.background = read.get<Colour>("background");
    style.annotations = read.choice<Annotations>("annotations", kAnnotations);
    style.periodic = {read.get<glm::dvec3>("periodic.shift"), read.get<glm::dvec3>("periodic.replicate")};
    style.crystal = crystalOf(read);
    style.clip = clipOf(read);
    style.isosurface = isosurfaceOf(read);
    style.labels = labelsOf(read);
    style.layers = layersOf(read);
    style.overlay = overlayOf(read);
    style.plane = planeOf(read);
    style.shading = shadingOf(read);
    style.light = lightOf(read);
    style.textureFormat = read.choice<TextureFormat>("texture.format", kTextureFormats);
    style.probeOpacity = read.find<double>("probe.opacity");
    style.field = read.field("field");
    style.timeStep = static_cast<int>(read.get<std::int64_t>("time"));
    return style;
}

OpacityStops opacityRamp() { return {{0.0, 0.0}, {0.1, 0.0}, {1.0, 0.25}}; }

namespace {

void requireRangeConsistent(const RangeStyle& range) {
    if (range.mode == RangeMode::Percentile) {
        for (const auto& [name, end] : {std::pair{"range.min", range.min}, std::pair{"range.max", range.max}})
            if (end && (*end < 0.0 || *end > 100.0))
                throw InvalidInput(name, "the value " + numberText(*end) + " is no percentile",
                                   "give a number from 0 to 100, or set range.mode to fixed")
                    .withField(name);
    }
    const bool bounded = range.mode == RangeMode::Fixed || range.mode == RangeMode::Percentile;
    if (!bounded || (!range.min && !range.max)) return;
    const bool percentile = range.mode == RangeMode::Percentile;
    const std::optional<double> low = range.min || !percentile ? range.min : 0.5;
    const std::optional<double> high = range.max || !percentile ? range.max : 99.5;
    if (low && high && *low >= *high)
        throw InvalidInput("range.min",
                           numberText(*low) + " is not less than range.max, " + numberText(*high),
                           "set both together")
            .withField("range.min");
}

bool isZero(const glm::dvec3& v) { return !(glm::length(v) > 0.0) || !std::isfinite(glm::length(v)); }

void requireClipConsistent(const ClipStyle& clip) {
    for (const auto& plane : clip.planes)
        if (isZero(plane.normal))
            throw InvalidInput("clip.planes", "a normal has no length, or one beyond all bounds",
                               "give a direction such as 1,0,0")
                .withField("clip.planes");
    if (clip.box)
        for (int axis = 0; axis < 3; ++axis)
            if (!(clip.box->low[axis] < clip.box->high[axis]))
                throw InvalidInput("clip.box",
                                   numberText(clip.box->low[axis]) + " is not less than " +
                                       numberText(clip.box->high[axis]) + " on axis " + "xyz"[axis],
                                   "give x0,x1,y0,y1,z0,z1 with the lower end first")
                    .withField("clip.box");
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(clip.transform.scale[axis]) > 1e-9))
            throw InvalidInput("clip.transform", "a scale of 0 leaves no object", "give scales other than 0")
                .withField("clip.transform");
}

void requirePlaneConsistent(const PlaneStyle& plane) {
    if (plane.axis == PlaneAxis::Custom && isZero(plane.normal))
        throw InvalidInput("plane.normal", "it has no length", "give a direction such as 1,0,1")
            .withField("plane.normal");
    if (plane.axis == PlaneAxis::Hkl && (isZero(plane.hkl) || plane.hkl != glm::round(plane.hkl)))
        throw InvalidInput("plane.hkl", "Miller indices are whole numbers and not all zero",
                           "give three from -99 to 99 such as 1,1,0")
            .withField("plane.hkl");
}

void requirePeriodicConsistent(const PeriodicStyle& periodic) {
    if (periodic.replicate != glm::round(periodic.replicate))
        throw InvalidInput("periodic.replicate", "a number of periods is not whole",
                           "give three whole numbers such as 2,2,1")
            .withField("periodic.replicate");
}

void requireLightConsistent(const LightStyle& light) {
    for (const auto& direction : light.directions)
        if (isZero(direction))
            throw InvalidInput("light.direction", "a direction has no length, or one beyond all bounds",
                               "give a direction such as 0,1,1")
                .withField("light.direction");
}

} // namespace

void requireConsistent(const TypedStyle& style) {
    if (style.transfer.cut1 >= style.transfer.cut2)
        throw InvalidInput("transfer.cut1",
                           numberText(style.transfer.cut1) + " is not less than transfer.cut2, " +
                               numberText(style.transfer.cut2),
                           "set both together")
            .withField("transfer.cut1");
    requireRangeConsistent(style.range);
    requirePeriodicConsistent(style.periodic);
    requireClipConsistent(style.clip);
    requirePlaneConsistent(style.plane);
    if (!style.labels.names.empty()) static_cast<void>(parseLabelNames(style.labels.names));
    if (style.overlay.min && style.overlay.max && *style.overlay.min >= *style.overlay.max)
        throw InvalidInput("overlay.min",
                           numberText(*style.overlay.min) + " is not less than overlay.max, " +
                               numberText(*style.overlay.max),
                           "set both together")
            .withField("overlay.min");
    requireLightConsistent(style.light);
}

} // namespace voxsheet::sheet
