#include "volume/signed_distance.h"

#include "base/errors.h"
#include "volume/nearest_seed.h"
#include "volume/parallel_for.h"
#include "volume/surface_net.h"
#include "volume/thresholded_solid.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

namespace voxsheet {

namespace {

struct WorldBox {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
};

WorldBox drawnBox(const Grid& grid) {
    const auto box = boxIndex(grid);
    WorldBox world;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 index((corner & 1) ? box.high.x : box.low.x, (corner & 2) ? box.high.y : box.low.y,
                               (corner & 4) ? box.high.z : box.low.z, 1.0);
        const glm::dvec3 position(grid.worldFromIndex * index);
        world.low = glm::min(world.low, position);
        world.high = glm::max(world.high, position);
    }
    return world;
}

/// Samples per axis for a spacing: the box, rounded up to whole spacings, and the margins.
glm::dvec3 samplesFor(const glm::dvec3& extent, double spacing) {
    // A box that is a whole number of spacings long up to rounding must not get one more.
    return glm::ceil(extent / spacing - 1e-6) + 1.0 + 2.0 * kDistanceMarginSamples;
}

double product(const glm::dvec3& v) { return v.x * v.y * v.z; }

/// From each sample of the output grid to the net: the vertex that is nearest, then the quadrilaterals there.
class NetDistances {
public:
    NetDistances(const SurfaceNet& net, const glm::ivec3& dims)
        : net_(net), dims_(dims), stride_{1, dims.x, static_cast<long>(dims.x) * dims.y},
          nearest_(static_cast<std::size_t>(sampleCount(dims)), kNoSeed) {}

    /// The transform starts from whole cells; within its cell's neighbours a sample then finds the nearest
    /// vertex, and neighbours exchange what they found.
    void findNearestVertices() {
        for (std::size_t cell = 0; cell < nearest_.size(); ++cell)
            if (net_.hasVertex(cell)) nearest_[cell] = static_cast<std::uint32_t>(cell);
        findNearestSeeds(dims_, nearest_);
        eachSample([&](std::size_t sample, const glm::ivec3& at) { walk(sample, glm::vec3(at)); });
        for (int round = 0; round < 4 && compareNeighbours(); ++round) {
        }
    }

    /// In units of samples, not negative. Never too small, and exact up to one.
    void measure(std::span<float> distances) const {
        eachSample([&](std::size_t sample, const glm::ivec3& at) {
            const glm::vec3 position(at);
            float squared = std::numeric_limits<float>::max();
            // A point of the net within one sample has its vertices within that and a block of 2 x 2 x 1
            // cells.
            if (squaredToVertex(nearest_[sample], position) < 16.0F)
                squared = squaredDistanceBeside(sample, position);
            if (squared > 1.0F) squared = std::min(squared, squaredDistanceAt(nearest_[sample], position));
            distances[sample] = std::sqrt(squared);
        });
    }

private:
    template <typename Body>
    void eachSample(const Body& body) const {
        parallelFor(static_cast<long>(dims_.y) * dims_.z, 16, [&](long begin, long end) {
            for (long row = begin; row < end; ++row)
                for (int x = 0; x < dims_.x; ++x)
                    body(static_cast<std::size_t>(row * dims_.x + x),
                         glm::ivec3(x, static_cast<int>(row % dims_.y), static_cast<int>(row / dims_.y)));
        });
    }

    [[nodiscard]] float squaredToVertex(std::size_t cell, const glm::vec3& position) const {
        const auto offset = net_.vertex(cell) - position;
        return glm::dot(offset, offset);
    }

    /// From vertex to vertex of adjoining cells, as long as they come nearer.
    void walk(std::size_t sample, const glm::vec3& position) {
        auto best = static_cast<long>(nearest_[sample]);
        float squared = squaredToVertex(static_cast<std::size_t>(best), position);
        for (long centre = -1; centre != best;) {
            centre = best;
            for (long z = -1; z <= 1; ++z)
                for (long y = -1; y <= 1; ++y)
                    for (long x = -1; x <= 1; ++x) {
                        const auto cell =
                            static_cast<std::size_t>(centre + z * stride_[2] + y * stride_[1] + x);
                        if (!net_.hasVertex(cell)) continue;
                        const float candidate = squaredToVertex(cell, position);
                        if (candidate >= squared) continue;
                        squared = candidate;
                        best = static_cast<long>(cell);
                    }
        }
        nearest_[sample] = static_cast<std::uint32_t>(best);
    }

    bool compareNeighbours() {
        const auto before = nearest_;
        std::atomic<bool> changed = false;
        eachSample([&](std::size_t sample, const glm::ivec3& at) {
            const glm::vec3 position(at);
            for (int axis = 0; axis < 3; ++axis)
                for (const int step : {-1, 1}) {
                    if (at[axis] + step < 0 || at[axis] + step >= dims_[axis]) continue;
                    const auto neighbour =
                        static_cast<long>(sample) + step * stride_[static_cast<std::size_t>(axis)];
                    const auto theirs = before[static_cast<std::size_t>(neighbour)];
                    if (theirs == before[sample] ||
                        squaredToVertex(theirs, position) >= squaredToVertex(nearest_[sample], position))
                        continue;
                    nearest_[sample] = theirs;
                    walk(sample, position);
                    changed.store(true, std::memory_order_relaxed);
                }
        });
        return changed;
    }

    /// To the quadrilaterals that meet in the cell's vertex: those of its twelve edges.
    [[nodiscard]] float squaredDistanceAt(std::size_t cell, const glm::vec3& position) const {
        float squared = std::numeric_limits<float>::max();
        for (int axis = 0; axis < 3; ++axis)
            for (const long u : {0L, strideOf(axis + 1)})
                for (const long v : {0L, strideOf(axis + 2)})
                    tryEdge(static_cast<long>(cell) + u + v, axis, position, squared);
        return squared;
    }

    /// To those of all edges of the eight cells about the sample: whatever is within one sample is among
    /// them.
    [[nodiscard]] float squaredDistanceBeside(std::size_t sample, const glm::vec3& position) const {
        float squared = std::numeric_limits<float>::max();
        const auto& at = position;
        if (glm::any(glm::lessThan(at, glm::vec3(1.0F))) ||
            glm::any(glm::greaterThan(at, glm::vec3(dims_ - 2))))
            return squared; // at the border of the grid nothing crosses
        for (int axis = 0; axis < 3; ++axis)
            for (const long along : {-strideOf(axis), 0L})
                for (const long u : {-strideOf(axis + 1), 0L, strideOf(axis + 1)})
                    for (const long v : {-strideOf(axis + 2), 0L, strideOf(axis + 2)})
                        tryEdge(static_cast<long>(sample) + along + u + v, axis, position, squared);
        return squared;
    }

    void tryEdge(long from, int axis, const glm::vec3& position, float& squared) const {
        const auto edge = static_cast<SurfaceNet::Edge>(3 * from + axis);
        if (net_.crosses(edge)) squared = std::min(squared, net_.squaredDistance(edge, position));
    }

    [[nodiscard]] long strideOf(int axis) const { return stride_[static_cast<std::size_t>(axis % 3)]; }

    const SurfaceNet& net_;
    glm::ivec3 dims_;
    std::array<long, 3> stride_;
    std::vector<std::uint32_t> nearest_; ///< per sample: the cell whose vertex is nearest
};

/// No sample may be further than a neighbour and the step to it; a distance that is only a bound from above
/// is corrected. The minimum over all samples of distance + steps (an L1 norm) is taken axis by axis.
void limitSteps(const glm::ivec3& dims, std::span<float> distances) {
    const std::array<long, 3> strides{1, dims.x, static_cast<long>(dims.x) * dims.y};
    for (int axis = 0; axis < 3; ++axis) {
        const long stride = strides[static_cast<std::size_t>(axis)];
        const long length = dims[axis];
        parallelFor(static_cast<long>(distances.size()) / length, 256, [&](long begin, long end) {
            for (long line = begin; line < end; ++line) {
                const long first = line / stride * stride * length + line % stride;
                const auto at = [&](long i) -> float& {
                    return distances[static_cast<std::size_t>(first + i * stride)];
                };
                for (long i = 1; i < length; ++i)
                    at(i) = std::min(at(i), at(i - 1) + 1.0F);
                for (long i = length - 2; i >= 0; --i)
                    at(i) = std::min(at(i), at(i + 1) + 1.0F);
            }
        });
    }
}

} // namespace

Grid distanceGrid(const Grid& field, long maxSamples) {
    validateGrid(field);
    if (maxSamples < 1000)
        throw InvalidInput("signed distances",
                           "a limit of " + std::to_string(maxSamples) + " samples is too low",
                           "allow at least 1000");
    const auto box = drawnBox(field);
    const auto extent = box.high - box.low;
    const auto edges = spacingWorld(field);
    double spacing = std::min({edges.x, edges.y, edges.z});
    const auto limit = static_cast<double>(maxSamples);
    // The margins do not shrink with the spacing, so the step to a fitting spacing is taken until it fits.
    while (product(samplesFor(extent, spacing)) > limit)
        spacing *= std::max(1.0005, 0.999 * std::cbrt(product(samplesFor(extent, spacing)) / limit));
    Grid grid;
    grid.dims = glm::ivec3(samplesFor(extent, spacing));
    grid.centring = Centring::Point;
    grid.worldFromIndex = glm::dmat4(spacing);
    grid.worldFromIndex[3] = glm::dvec4(box.low - spacing * kDistanceMarginSamples, 1.0);
    validateGrid(grid);
    return grid;
}

DistanceVolume signedDistance(const Grid& field, std::span<const float> values, const Threshold& threshold,
                              long maxSamples) {
    if (std::isnan(threshold.value)) throw InvalidInput("threshold", "it is not a number", "give a number");
    DistanceVolume result{distanceGrid(field, maxSamples), {}};
    if (values.size() != static_cast<std::size_t>(sampleCount(field.dims)))
        throw InvalidInput("signed distances", "the field has " + std::to_string(values.size()) +
                                                   " values for its " +
                                                   std::to_string(sampleCount(field.dims)) + " samples");
    const auto& dims = result.grid.dims;
    const double spacing = result.grid.worldFromIndex[0][0];
    const glm::dvec3 origin(result.grid.worldFromIndex[3]);
    result.distances.resize(static_cast<std::size_t>(sampleCount(dims)));

    const ThresholdedSolid solid(field, values, threshold);
    const SurfaceNet net(dims,
                         [&](const glm::dvec3& index) { return solid.contains(origin + spacing * index); });
    if (net.empty()) {
        std::fill(result.distances.begin(), result.distances.end(),
                  static_cast<float>(spacing * glm::length(glm::dvec3(dims - 1))));
        return result;
    }
    NetDistances distances(net, dims);
    distances.findNearestVertices();
    distances.measure(result.distances);
    limitSteps(dims, result.distances);
    for (std::size_t s = 0; s < result.distances.size(); ++s)
        result.distances[s] *= static_cast<float>(net.inside(s) ? -spacing : spacing);
    return result;
}

} // namespace voxsheet
