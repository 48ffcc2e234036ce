#include "volume/transfer_function.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxsheet {
namespace {

/// Share of `high` at which a logarithmic range starts when its low end is not positive: six decades.
constexpr double kLogFloor = 1e-6;
/// SymLog's linear part as a share of the largest magnitude in the range, when none is asked for.
constexpr double kSymLogFloor = 1e-3;
constexpr double kExponentialRate = 3.0;

/// The monotone map whose differences are equal steps of the range: g in the header.
struct ScaleMap {
    ValueScale scale;
    double threshold;

    [[nodiscard]] double forward(double value) const {
        switch (scale) {
        case ValueScale::Linear:
            return value;
        case ValueScale::Log:
            return value > 0.0 ? std::log(value) : -std::numeric_limits<double>::infinity();
        case ValueScale::SymLog:
            break;
        }
        const double magnitude = std::abs(value) / threshold;
        return magnitude <= 1.0 ? value / threshold : std::copysign(1.0 + std::log(magnitude), value);
    }

    [[nodiscard]] double inverse(double mapped) const {
        switch (scale) {
        case ValueScale::Linear:
            return mapped;
        case ValueScale::Log:
            return std::exp(mapped);
        case ValueScale::SymLog:
            break;
        }
        const double magnitude = std::abs(mapped);
        return magnitude <= 1.0 ? mapped * threshold
                                : std::copysign(threshold * std::exp(magnitude - 1.0), mapped);
    }
};

struct Range {
    double low;
    double high;
    ScaleMap map;

    [[nodiscard]] double position(double value) const {
        const double start = map.forward(low);
        return (map.forward(value) - start) / (map.forward(high) - start);
    }
    [[nodiscard]] double value(double position) const {
        const double start = map.forward(low);
        return map.inverse(start + position * (map.forward(high) - start));
    }
};

Range rangeOf(const TransferFunction& function) {
    Range range{function.low, function.high, {function.scale, function.symLogThreshold}};
    if (function.scale == ValueScale::Log && range.low <= 0.0) range.low = function.high * kLogFloor;
    if (function.scale == ValueScale::SymLog && range.map.threshold <= 0.0)
        range.map.threshold = kSymLogFloor * std::max(std::abs(function.low), std::abs(function.high));
    return range;
}

Range rangeOf(const TransferTable& table) {
    return {table.low, table.high, {table.scale, table.symLogThreshold}};
}

double shapeRamp(TransferShape shape, double u) {
    const double clamped = std::clamp(u, 0.0, 1.0);
    if (shape == TransferShape::Exponential)
        return std::expm1(kExponentialRate * clamped) / std::expm1(kExponentialRate);
    if (shape == TransferShape::Parabolic) return clamped * clamped;
    return clamped;
}

glm::dvec3 shapedColour(const TransferFunction& function, double position) {
    const double middle = 0.5 * (function.cut1 + function.cut2);
    const double rise1 = shapeRamp(function.shape, (position - function.cut1) / (middle - function.cut1));
    const double rise2 = shapeRamp(function.shape, (position - middle) / (function.cut2 - middle));
    return {rise2, rise1 - rise2, 1.0 - rise1};
}

/// Linear between sorted points; of points at one position the last one holds from there on.
template <typename Point, typename Member>
auto piecewise(const std::vector<Point>& points, double position, Member member) {
    const auto next = std::upper_bound(points.begin(), points.end(), position,
                                       [](double p, const Point& point) { return p < point.position; });
    if (next == points.begin()) return points.front().*member;
    if (next == points.end()) return points.back().*member;
    const auto& before = *(next - 1);
    const double weight = (position - before.position) / (next->position - before.position);
    return before.*member + weight * ((*next).*member - before.*member);
}

glm::dvec4 colourAt(const TransferFunction& function, double position) {
    const auto rgb = function.shape == TransferShape::Piecewise
                         ? piecewise(function.colours, position, &ColourPoint::rgb)
                         : shapedColour(function, position);
    return {rgb, piecewise(function.opacities, position, &OpacityPoint::opacity)};
}

bool isUnit(double value) { return value >= 0.0 && value <= 1.0; }

bool isUnit(const glm::dvec4& rgba) {
    return isUnit(rgba.x) && isUnit(rgba.y) && isUnit(rgba.z) && isUnit(rgba.w);
}

template <typename Point>
void validatePositions(const std::vector<Point>& points, const char* what, const char* field) {
    if (points.empty())
        throw InvalidInput(what, "there is no control point", "give at least one point").withField(field);
    double previous = 0.0;
    for (const auto& point : points) {
        if (!isUnit(point.position))
            throw InvalidInput(what, "a position is outside [0, 1]", "positions are fractions of the range")
                .withField(field);
        if (point.position < previous)
            throw InvalidInput(what, "the points are not sorted by position", "sort them").withField(field);
        previous = point.position;
    }
}

void validateRange(const TransferFunction& function) {
    if (!std::isfinite(function.low) || !std::isfinite(function.high))
        throw InvalidInput("value range", "an end is not a finite number").withField("range.min");
    if (!(function.low < function.high))
        throw InvalidInput("value range", "its low end is not below its high end", "give min < max")
            .withField("range.min");
    if (function.scale == ValueScale::Log && function.high <= 0.0)
        throw InvalidInput("logarithmic scale", "the range holds no positive value", "use linear or symlog")
            .withField("range.scale");
    if (!(function.symLogThreshold >= 0.0) || !std::isfinite(function.symLogThreshold))
        throw InvalidInput("symlog threshold", "it is negative or not finite").withField("range.scale");
}

void validate(const TransferFunction& function, int entries) {
    if (entries < 2) throw InvalidInput("transfer table", "it needs at least two entries");
    validateRange(function);
    validatePositions(function.opacities, "opacity points", "transfer.opacity");
    for (const auto& point : function.opacities)
        if (!isUnit(point.opacity))
            throw InvalidInput("opacity points", "an opacity is outside [0, 1]")
                .withField("transfer.opacity");
    if (function.shape == TransferShape::Piecewise) {
        validatePositions(function.colours, "colour points", "transfer.points");
        for (const auto& point : function.colours)
            if (!isUnit(glm::dvec4(point.rgb, 0.0)))
                throw InvalidInput("colour points", "a colour is outside [0, 1]")
                    .withField("transfer.points");
    } else if (!isUnit(function.cut1) || !isUnit(function.cut2) || !(function.cut1 < function.cut2)) {
        throw InvalidInput("cuts of the transfer function", "0 <= cut1 < cut2 <= 1 does not hold",
                           "move one of them")
            .withField("transfer.cut1");
    }
    if (function.hasBelow && !isUnit(function.below))
        throw InvalidInput("colour below the range", "a component is outside [0, 1]")
            .withField("transfer.belowColor");
    if (function.hasAbove && !isUnit(function.above))
        throw InvalidInput("colour above the range", "a component is outside [0, 1]")
            .withField("transfer.aboveColor");
    if (!isUnit(function.nan))
        throw InvalidInput("colour of NaN", "a component is outside [0, 1]").withField("transfer.nanColor");
}

} // namespace

double transferPosition(const TransferFunction& function, double value) {
    return rangeOf(function).position(value);
}

double transferValue(const TransferFunction& function, double position) {
    return rangeOf(function).value(position);
}

glm::dvec4 evaluateTransfer(const TransferFunction& function, double value) {
    if (std::isnan(value)) return function.nan;
    const double position = transferPosition(function, value);
    if (position < 0.0 && function.hasBelow) return function.below;
    if (position > 1.0 && function.hasAbove) return function.above;
    return colourAt(function, std::clamp(position, 0.0, 1.0));
}

std::shared_ptr<const TransferTable> buildTransferTable(const TransferFunction& function, int entries) {
    validate(function, entries);
    const auto range = rangeOf(function);
    auto table = std::make_shared<TransferTable>();
    table->low = range.low;
    table->high = range.high;
    table->scale = function.scale;
    table->symLogThreshold = function.scale == ValueScale::SymLog ? range.map.threshold : 1.0;
    table->entries.resize(static_cast<std::size_t>(entries));
    for (int i = 0; i < entries; ++i)
        table->entries[static_cast<std::size_t>(i)] =
            glm::vec4(colourAt(function, double(i) / (entries - 1)));
    table->below = function.hasBelow ? glm::vec4(function.below) : table->entries.front();
    table->above = function.hasAbove ? glm::vec4(function.above) : table->entries.back();
    table->nan = glm::vec4(function.nan);
    return table;
}

double tablePosition(const TransferTable& table, double value) { return rangeOf(table).position(value); }

double tableValue(const TransferTable& table, double position) { return rangeOf(table).value(position); }

glm::dvec4 classify(const TransferTable& table, double value) {
    if (std::isnan(value)) return glm::dvec4(table.nan);
    const double position = tablePosition(table, value);
    if (position < 0.0) return glm::dvec4(table.below);
    if (position > 1.0) return glm::dvec4(table.above);
    const double scaled = position * static_cast<double>(table.entries.size() - 1);
    const auto first = std::min(static_cast<std::size_t>(scaled), table.entries.size() - 2);
    const double weight = scaled - static_cast<double>(first);
    return (1.0 - weight) * glm::dvec4(table.entries[first]) + weight * glm::dvec4(table.entries[first + 1]);
}

float maxOpacity(const TransferTable& table, double low, double high) {
    if (std::isnan(low) || std::isnan(high)) return 1.0F;
    if (low > high) return 0.0F;
    const double last = static_cast<double>(table.entries.size() - 1);
    const double from = tablePosition(table, low) * last - 1.0;
    const double to = tablePosition(table, high) * last + 1.0;
    float result = 0.0F;
    if (from < 0.0) result = std::max(result, table.below.w);
    if (to > last) result = std::max(result, table.above.w);
    const auto begin = static_cast<std::size_t>(std::clamp(std::floor(from), 0.0, last));
    const auto end = static_cast<std::size_t>(std::clamp(std::ceil(to), 0.0, last));
    for (auto i = begin; i <= end; ++i)
        result = std::max(result, table.entries[i].w);
    return result;
}

float largestOpacity(const TransferTable& table) {
    float result = std::max(table.below.w, table.above.w);
    for (const auto& entry : table.entries)
        result = std::max(result, entry.w);
    return result;
}

} // namespace voxsheet
