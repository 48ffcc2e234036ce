#include "engine/default_look.h"

#include "engine/sorted_values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace voxsheet::engine {

namespace {

constexpr double kBackgroundShare = 0.25;
constexpr double kOpacityPower = 1.5;
constexpr double kMaxOpacity = 0.85;
constexpr std::size_t kRampPoints = 6;

/// How far a position is from the background, in [0, 1], and back.
struct BackgroundDistance {
    double centre = 0.0;
    bool below = false; ///< values under the centre count
    bool above = true;  ///< values over the centre count

    [[nodiscard]] double of(double position) const {
        if (position < centre) return below ? (centre - position) / reach() : 0.0;
        return above ? (position - centre) / reach() : 0.0;
    }
    [[nodiscard]] double reach() const {
        return std::max({below ? centre : 0.0, above ? 1.0 - centre : 0.0, 1e-9});
    }
};

/// Shares of the samples that are clearly under and over a value.
struct Sides {
    double below = 0.0;
    double above = 0.0;

    /// A side with less than a quarter of the other's samples is a flag or noise, not a feature.
    [[nodiscard]] bool belowCounts() const { return below >= 0.25 * above; }
    [[nodiscard]] bool aboveCounts() const { return above >= 0.25 * below; }
};

Sides sidesOf(const ValueSummary& summary, double centre, double margin) {
    Sides sides;
    for (const double value : summary.quantiles) {
        sides.below += value < centre - margin ? 1.0 : 0.0;
        sides.above += value > centre + margin ? 1.0 : 0.0;
    }
    return sides;
}

BackgroundDistance distanceFrom(const ValueSummary& summary, const TransferFunction& function,
                                bool signedData) {
    BackgroundDistance distance;
    const double background = signedData ? 0.0 : backgroundValue(summary);
    distance.centre = std::clamp(transferPosition(function, background), 0.0, 1.0);
    const Sides sides = sidesOf(summary, background, 0.05 * (function.high - function.low));
    distance.below = distance.centre > 0.0 && (signedData || sides.belowCounts());
    distance.above = distance.centre < 1.0 && (signedData || sides.aboveCounts());
    return distance;
}

std::vector<double> sortedDistances(const ValueSummary& summary, const TransferFunction& function,
                                    const BackgroundDistance& distance) {
    std::vector<double> distances;
    distances.reserve(summary.quantiles.size());
    for (const double value : summary.quantiles) {
        distances.push_back(distance.of(std::clamp(transferPosition(function, value), 0.0, 1.0)));
    }
    std::sort(distances.begin(), distances.end());
    return distances;
}

/// Otsu 1979: the split that makes the variance between the two classes largest.
double otsuThreshold(const std::vector<double>& sorted) {
    double total = 0.0;
    for (const double d : sorted)
        total += d;
    const auto count = static_cast<double>(sorted.size());
    double best = -1.0;
    double threshold = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < sorted.size(); ++i) {
        sum += sorted[i];
        const double n = static_cast<double>(i) + 1.0;
        const double low = sum / n;
        const double high = (total - sum) / (count - n);
        const double between = n * (count - n) * (high - low) * (high - low);
        if (between > best) {
            best = between;
            threshold = (low + high) / 2.0;
        }
    }
    return threshold;
}

double atShare(const std::vector<double>& sorted, double share) {
    const auto index = static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1) + 0.5);
    return sorted[std::min(index, sorted.size() - 1)];
}

/// A heavy tail pulls Otsu's threshold far out; at least the outer tenth of the samples should be seen.
double structureBegin(const std::vector<double>& sorted) {
    return std::min(otsuThreshold(sorted), atShare(sorted, 0.9));
}

struct Ramp {
    double begin = 0.0; ///< distance at which opacity leaves 0
    double end = 1.0;   ///< distance at which it is full

    [[nodiscard]] double of(double distance) const {
        return std::pow(std::clamp((distance - begin) / (end - begin), 0.0, 1.0), kOpacityPower);
    }
};

/// Height of the ramp at which the mean optical depth over the path is the target.
double heightFor(const std::vector<double>& distances, const Ramp& ramp, double pathUnitLengths) {
    std::vector<double> visible; // Values of the ramp that are not 0: this runs for every tile of a frame.
    for (const double d : distances) {
        if (d > ramp.begin) visible.push_back(ramp.of(d));
    }
    const auto depth = [&](double height) {
        double sum = 0.0;
        for (const double value : visible)
            sum -= std::log1p(-height * value);
        return sum / static_cast<double>(distances.size()) * pathUnitLengths;
    };
    double low = 0.0;
    double high = kMaxOpacity;
    if (depth(high) <= kTargetDepth) return high;
    for (int step = 0; step < 20; ++step) {
        const double middle = (low + high) / 2.0;
        (depth(middle) < kTargetDepth ? low : high) = middle;
    }
    return high;
}

/// The ramp on each side of the centre that counts, as sorted points over positions.
std::vector<OpacityPoint> rampPoints(const BackgroundDistance& distance, const Ramp& ramp, double height) {
    std::vector<double> steps;
    for (std::size_t i = 0; i <= kRampPoints; ++i) {
        const double w = static_cast<double>(i) / kRampPoints;
        steps.push_back(ramp.begin + w * (ramp.end - ramp.begin));
    }
    std::vector<OpacityPoint> points;
    const double reach = distance.reach();
    if (distance.below) {
        for (auto d = steps.rbegin(); d != steps.rend(); ++d) {
            points.push_back({distance.centre - *d * reach, height * ramp.of(*d)});
        }
    }
    if (distance.above) {
        for (const double d : steps)
            points.push_back({distance.centre + d * reach, height * ramp.of(d)});
    }
    std::vector<OpacityPoint> inside;
    for (OpacityPoint point : points) {
        if (point.position < -1e-9 || point.position > 1.0 + 1e-9) continue;
        point.position = std::clamp(point.position, 0.0, 1.0);
        inside.push_back(point);
    }
    const auto at = [&](double position) {
        return OpacityPoint{position, height * ramp.of(distance.of(position))};
    };
    if (inside.empty() || inside.front().position > 0.0) inside.insert(inside.begin(), at(0.0));
    if (inside.back().position < 1.0) inside.push_back(at(1.0));
    return inside;
}

ValueWindow widened(double low, double high) {
    if (high > low) return {low, high};
    const double half = low == 0.0 ? 0.5 : std::abs(low) * 0.5;
    return {low - half, low + half};
}

} // namespace

double ValueSummary::quantile(double probability) const {
    if (quantiles.empty()) return 0.0;
    const double at = std::clamp(probability, 0.0, 1.0) * static_cast<double>(quantiles.size() - 1);
    const auto index = static_cast<std::size_t>(at);
    if (index + 1 >= quantiles.size()) return quantiles.back();
    const double w = at - static_cast<double>(index);
    return quantiles[index] + w * (quantiles[index + 1] - quantiles[index]);
}

ValueSummary summariseValues(std::vector<float>& values, double min, double max) {
    sortFinite(values);
    ValueSummary summary{min, max, false, {}};
    if (values.empty()) return summary;
    summary.quantiles.reserve(ValueSummary::kQuantiles);
    for (int i = 0; i < ValueSummary::kQuantiles; ++i) {
        const double at =
            static_cast<double>(i) / (ValueSummary::kQuantiles - 1) * static_cast<double>(values.size() - 1);
        summary.quantiles.push_back(static_cast<double>(values[static_cast<std::size_t>(at)]));
    }
    return summary;
}

double backgroundValue(const ValueSummary& summary) {
    const auto& q = summary.quantiles;
    if (q.size() < 8) return summary.min;
    const auto span = static_cast<std::size_t>(kBackgroundShare * static_cast<double>(q.size()));
    std::size_t best = 0;
    for (std::size_t i = 0; i + span < q.size(); ++i) {
        if (q[i + span] - q[i] < q[best + span] - q[best]) best = i;
    }
    return (q[best] + q[best + span]) / 2.0;
}

bool opensDiverging(const ValueSummary& summary) {
    if (summary.integers) return false;
    const double low = summary.quantile(0.005);
    const double high = summary.quantile(0.995);
    const double larger = std::max(-low, high);
    if (low >= 0.0 || high <= 0.0 || std::min(-low, high) <= 0.1 * larger) return false;
    // A tenth of all samples within a twentieth of the range of one end: a filling value, no tail.
    const double margin = 0.05 * (high - low);
    if (summary.quantile(0.1) < low + margin || summary.quantile(0.9) > high - margin) return false;
    return std::abs(backgroundValue(summary)) < 0.25 * larger;
}

ValueWindow defaultWindow(const ValueSummary& summary) {
    if (summary.quantiles.empty()) return fullWindow(summary.min, summary.max);
    const double low = summary.quantile(0.002);
    const double high = summary.quantile(0.998);
    const bool robust = high > low && high - low < 0.6 * (summary.max - summary.min);
    ValueWindow window = robust ? ValueWindow{low, high} : fullWindow(summary.min, summary.max);
    if (opensDiverging(summary)) return symmetricWindow(window);
    // A side of the background that holds no feature does not stretch the window.
    const double background = backgroundValue(summary);
    const Sides sides = sidesOf(summary, background, 0.05 * (window.high - window.low));
    if (!sides.belowCounts()) window.low = std::max(window.low, 2.0 * background - window.high);
    if (!sides.aboveCounts()) window.high = std::min(window.high, 2.0 * background - window.low);
    return window;
}

ValueWindow fullWindow(double min, double max) { return widened(min, max); }

ValueWindow symmetricWindow(const ValueWindow& window) {
    const double magnitude = std::max(std::abs(window.low), std::abs(window.high));
    return magnitude > 0.0 ? ValueWindow{-magnitude, magnitude} : ValueWindow{-0.5, 0.5};
}

ValueWindow percentileWindow(const ValueSummary& summary) {
    return widened(summary.quantile(0.01), summary.quantile(0.99));
}

std::vector<OpacityPoint> defaultOpacity(const ValueSummary& summary, const TransferFunction& function,
                                         bool signedData, double pathUnitLengths) {
    if (summary.quantiles.empty()) return {{0.0, 0.0}, {1.0, 0.0}};
    const BackgroundDistance distance = distanceFrom(summary, function, signedData);
    const std::vector<double> distances = sortedDistances(summary, function, distance);
    Ramp ramp;
    ramp.begin = structureBegin(distances);
    ramp.end = std::max(atShare(distances, 0.99), ramp.begin + 0.02);
    return rampPoints(distance, ramp, heightFor(distances, ramp, pathUnitLengths));
}

std::vector<OpacityPoint> defaultProjectionOpacity(const ValueSummary& summary,
                                                   const TransferFunction& function, bool signedData) {
    if (summary.quantiles.empty()) return {{0.0, 0.0}, {1.0, 0.0}};
    const BackgroundDistance distance = distanceFrom(summary, function, signedData);
    return rampPoints(distance, Ramp{0.02, 0.4}, 1.0);
}

std::vector<double> defaultIsovalues(const ValueSummary& summary, const ValueWindow& shown) {
    const ValueWindow window = defaultWindow(summary);
    if (opensDiverging(summary)) {
        const bool bothSigns = shown.low < 0.0 && shown.high > 0.0;
        const double quarter = 0.25 * symmetricWindow(bothSigns ? shown : window).high;
        return {quarter, -quarter};
    }
    if (summary.quantiles.empty()) return {(window.low + window.high) / 2.0};
    TransferFunction function;
    function.low = window.low;
    function.high = window.high;
    const BackgroundDistance distance = distanceFrom(summary, function, false);
    const std::vector<double> distances = sortedDistances(summary, function, distance);
    // Nothing but background among nine tenths of the samples: halfway to the largest distance there is.
    double begin = structureBegin(distances);
    if (begin <= 0.0) begin = distances.back() > 0.0 ? distances.back() / 2.0 : 0.5;
    const double side = distance.above ? 1.0 : -1.0;
    return {transferValue(function, distance.centre + side * begin * distance.reach())};
}

} // namespace voxsheet::engine
