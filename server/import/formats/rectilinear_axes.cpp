#include "import/formats/rectilinear_axes.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace voxsheet::import {

namespace {

constexpr double kMostSamples = 0x1p27;
constexpr int kFinest = 4; // times as many samples as the file has

struct AxisShape {
    int intervals = 0;    ///< between the file's points
    double length = 0.0;  ///< > 0, or 0 for a single point
    double closest = 0.0; ///< distance of neighbours
    bool uniform = true;
};

AxisShape shapeOf(const std::string& name, const std::vector<double>& points) {
    AxisShape shape;
    if (points.empty()) throw InvalidInput(name, "an axis of it has no coordinates");
    shape.intervals = static_cast<int>(points.size()) - 1;
    shape.length = std::abs(points.back() - points.front());
    if (!std::isfinite(points.front()) || !std::isfinite(shape.length))
        throw InvalidInput(name, "its coordinates are not finite");
    if (shape.intervals == 0) return shape;
    const bool rises = points.back() > points.front();
    const double mean = shape.length / shape.intervals;
    shape.closest = shape.length;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double step = rises ? points[i] - points[i - 1] : points[i - 1] - points[i];
        if (!(step > 0.0))
            throw InvalidInput(name, "the coordinates along an axis of it neither rise nor fall throughout",
                               "the file is probably damaged");
        shape.closest = std::min(shape.closest, step);
        if (std::abs(step - mean) > 1e-5 * mean) shape.uniform = false;
    }
    return shape;
}

/// Intervals of the uniform axis.
int wantedIntervals(const AxisShape& shape, double finest) {
    if (shape.uniform) return shape.intervals;
    const double wanted = std::ceil(shape.length / shape.closest - 1e-6);
    return std::max(shape.intervals, static_cast<int>(std::min(wanted, finest * shape.intervals)));
}

} // namespace

UniformResampling::UniformResampling(const std::string& name, const AxisCoordinates& points, bool ofCells)
    : ofCells_(ofCells) {
    std::array<AxisShape, 3> shapes;
    for (std::size_t axis = 0; axis < 3; ++axis)
        shapes[axis] = shapeOf(name, points[axis]);
    std::array<int, 3> intervals{};
    for (double finest = kFinest; finest >= 1.0; finest /= 2.0) {
        double samples = 1.0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            intervals[axis] = wantedIntervals(shapes[axis], finest);
            samples *= intervals[axis] + 1;
        }
        if (samples <= kMostSamples) break;
    }
    grid_.centring = ofCells ? Centring::Cell : Centring::Point;
    for (int axis = 0; axis < 3; ++axis) {
        const auto& shape = shapes[static_cast<std::size_t>(axis)];
        identity_ = identity_ && shape.uniform;
        sourceDims_[axis] = ofCells ? std::max(1, shape.intervals) : shape.intervals + 1;
        const int count = intervals[static_cast<std::size_t>(axis)];
        placeAxis(axis, points[static_cast<std::size_t>(axis)], ofCells ? std::max(1, count) : count + 1);
    }
    validateGrid(grid_);
}

void UniformResampling::placeAxis(int axis, const std::vector<double>& points, int samples) {
    grid_.dims[axis] = samples;
    auto& taps = taps_[static_cast<std::size_t>(axis)];
    taps.resize(static_cast<std::size_t>(samples));
    const double first = points.front();
    if (points.size() == 1) { // one voxel thick
        grid_.worldFromIndex[3][axis] = first;
        return;
    }
    const double length = points.back() - first;
    const double spacing = length / (ofCells_ ? samples : samples - 1);
    const double start = ofCells_ ? 0.5 : 0.0;
    grid_.worldFromIndex[axis] = glm::dvec4(0.0);
    grid_.worldFromIndex[axis][axis] = spacing;
    grid_.worldFromIndex[3][axis] = first + start * spacing;
    std::size_t interval = 0;
    const auto beyond = [&](double x, std::size_t point) {
        return length > 0.0 ? x > points[point] : x < points[point];
    };
    for (int i = 0; i < samples; ++i) {
        const double x = first + (i + start) * spacing;
        while (interval + 2 < points.size() && beyond(x, interval + 1))
            ++interval;
        double within =
            std::clamp((x - points[interval]) / (points[interval + 1] - points[interval]), 0.0, 1.0);
        // What stands on a point takes its value alone, whatever the rounding.
        if (ofCells_ || within < 1e-6) within = 0.0;
        if (within > 1.0 - 1e-6) within = 1.0;
        taps[static_cast<std::size_t>(i)] = {interval, within};
    }
}

std::string UniformResampling::note() const {
    if (identity_) return {};
    const auto text = [](const glm::ivec3& dims) {
        return std::to_string(dims.x) + " x " + std::to_string(dims.y) + " x " + std::to_string(dims.z);
    };
    return "Resampled: its rectilinear grid of " + text(sourceDims_) + (ofCells_ ? " cells" : " points") +
           " became a uniform one of " + text(grid_.dims) +
           (ofCells_ ? ", each with the value of the cell that holds its centre."
                     : ", linear between the values of the file.");
}

ScalarType UniformResampling::resultType(ScalarType source) const {
    if (identity_ || ofCells_ || isFloat(source)) return source;
    return scalarBytes(source) <= 2 ? ScalarType::F32 : ScalarType::F64;
}

template <typename In, typename Out>
void UniformResampling::interpolate(std::span<const In> in, std::span<Out> out) const {
    const auto nx = static_cast<std::size_t>(sourceDims_.x);
    const auto ny = static_cast<std::size_t>(sourceDims_.y);
    const auto line = [&](std::size_t from, const Tap& x) {
        const double low = static_cast<double>(in[from + x.index]);
        // A neighbour without weight does not count, not even as NaN.
        if (x.weight == 0.0) return low;
        const double high = static_cast<double>(in[from + x.index + 1]);
        return x.weight == 1.0 ? high : (1.0 - x.weight) * low + x.weight * high;
    };
    const auto between = [](const Tap& tap, const auto& at) {
        if (tap.weight == 0.0) return at(tap.index);
        if (tap.weight == 1.0) return at(tap.index + 1);
        return (1.0 - tap.weight) * at(tap.index) + tap.weight * at(tap.index + 1);
    };
    std::size_t index = 0;
    for (const auto& z : taps_[2])
        for (const auto& y : taps_[1])
            for (const auto& x : taps_[0])
                out[index++] = static_cast<Out>(between(z, [&](std::size_t k) {
                    return between(y, [&](std::size_t j) { return line((k * ny + j) * nx, x); });
                }));
}

std::vector<std::byte> UniformResampling::apply(std::span<const std::byte> values, ScalarType type) const {
    const auto result = resultType(type);
    const auto samples = static_cast<std::size_t>(sampleCount(grid_.dims));
    std::vector<std::byte> out(samples * scalarBytes(result));
    visitScalar(type, [&]<typename In>() {
        const std::span<const In> in(reinterpret_cast<const In*>(values.data()), values.size() / sizeof(In));
        if (in.size() != static_cast<std::size_t>(sampleCount(sourceDims_)))
            throw InternalError("rectilinear grid", "an array is not as large as its header said");
        if (ofCells_) { // copied, so that no integer passes through a float
            std::size_t index = 0;
            for (const auto& z : taps_[2])
                for (const auto& y : taps_[1])
                    for (const auto& x : taps_[0]) {
                        const auto from = (z.index * static_cast<std::size_t>(sourceDims_.y) + y.index) *
                                              static_cast<std::size_t>(sourceDims_.x) +
                                          x.index;
                        std::memcpy(out.data() + sizeof(In) * index++, &in[from], sizeof(In));
                    }
        } else {
            const auto interpolated = [&]<typename Out>(Out) {
                interpolate<In, Out>(in, {reinterpret_cast<Out*>(out.data()), samples});
            };
            if (result == type)
                interpolated(In{});
            else if (result == ScalarType::F32)
                interpolated(float{});
            else
                interpolated(double{});
        }
    });
    return out;
}

} // namespace voxsheet::import
