#include "sheet/typed_style.h"

#include "base/errors.h"
#include "sheet/number_text.h"
#include "sheet/style.h"

#include <algorithm>
#include <array>
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
        return enumOf<Enum>(words, get<std::string>(key), key);
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
using Words6 = std::array<std::string_view, 6>;

constexpr Words3 kTechniques{"slices", "raycast", "mip"};
constexpr Words2 kProjections{"perspective", "orthographic"};
constexpr Words4 kShapes{"piecewise", "linear", "exponential", "parabolic"};
constexpr Words6 kRangeModes{"auto", "own", "shared", "fixed", "percentile", "symmetric"};
constexpr Words3 kScales{"linear", "log", "symlog"};
constexpr Words4 kQualities{"full", "half", "quarter", "eighth"};
constexpr Words3 kAnnotations{"none", "names", "all"};

CameraStyle cameraOf(const Reader& read) {
    CameraStyle camera;
    camera.azimuthDegrees = read.get<double>("camera.azimuth");
    camera.elevationDegrees = read.get<double>("camera.elevation");
    camera.rollDegrees = read.get<double>("camera.roll");
    camera.distanceRadii = read.get<double>("camera.distance");
    camera.targetRadii = read.get<glm::dvec3>("camera.target");
    camera.fovDegrees = read.get<double>("camera.fov");
    camera.projection = read.choice<Projection>("camera.projection", kProjections);
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
    style.sampleDistanceVoxels = read.get<double>("sampling.distance");
    style.quality = read.choice<Quality>("quality", kQualities);
    style.background = read.get<Colour>("background");
    style.annotations = read.choice<Annotations>("annotations", kAnnotations);
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

} // namespace

void requireConsistent(const TypedStyle& style) {
    if (style.transfer.cut1 >= style.transfer.cut2)
        throw InvalidInput("transfer.cut1",
                           numberText(style.transfer.cut1) + " is not less than transfer.cut2, " +
                               numberText(style.transfer.cut2),
                           "set both together")
            .withField("transfer.cut1");
    requireRangeConsistent(style.range);
}

} // namespace voxsheet::sheet
