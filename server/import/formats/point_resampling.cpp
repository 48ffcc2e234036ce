#include "import/formats/point_resampling.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>

namespace voxsheet::import {

namespace {

constexpr double kRounding = 1e-4; // of a spacing

/// Where a point of the grid lies among the points of a patch, along one axis.
struct Between {
    std::size_t low = 0;
    std::size_t high = 0;
    double weight = 0.0; ///< of the higher one; 0: the lower one alone
    int to = 0;          ///< of the grid
};

std::vector<Between> between(const Grid& grid, const CellPatch& patch, int axis) {
    std::vector<Between> list;
    if (grid.dims[axis] == 1) return {{}};
    const double step = grid.worldFromIndex[axis][axis];
    const double start = patch.low[axis] - grid.worldFromIndex[3][axis];
    const double spacing = patch.cellSize[axis];
    const int last = patch.dims[axis] - 1;
    const double tolerance = kRounding * std::min(step, spacing);
    const double begin = std::ceil((start - tolerance) / step);
    for (int to = std::max(0, static_cast<int>(begin)); to < grid.dims[axis]; ++to) {
        const double place = (to * step - start) / spacing;
        if (place > last + tolerance / spacing) break;
        const double inside = std::clamp(place, 0.0, static_cast<double>(last));
        const double nearest = std::round(inside);
        const bool onPoint = std::abs(inside - nearest) < kRounding;
        const auto low = static_cast<std::size_t>(onPoint ? nearest : std::floor(inside));
        list.push_back({low, onPoint ? low : low + 1, onPoint ? 0.0 : inside - std::floor(inside), to});
    }
    return list;
}

/// Trilinear value; corners without weight are not looked at, so that no-values beside it do not spread.
template <typename In>
double valueAt(const CellPatch& patch, std::span<const In> in, const Between& x, const Between& y,
               const Between& z) {
    const auto width = static_cast<std::size_t>(patch.dims.x);
    const auto height = static_cast<std::size_t>(patch.dims.y);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const bool right = corner & 1;
        const bool back = corner & 2;
        const bool top = corner & 4;
        const double weight = (right ? x.weight : 1.0 - x.weight) * (back ? y.weight : 1.0 - y.weight) *
                              (top ? z.weight : 1.0 - z.weight);
        if (weight == 0.0) continue;
        const auto at =
            ((top ? z.high : z.low) * height + (back ? y.high : y.low)) * width + (right ? x.high : x.low);
        sum += weight * static_cast<double>(in[at]);
    }
    return sum;
}

template <typename In, typename Out>
void paintAs(const Grid& grid, const CellPatch& patch, std::span<const In> in, std::span<Out> out) {
    const auto xs = between(grid, patch, 0);
    const auto ys = between(grid, patch, 1);
    const auto zs = between(grid, patch, 2);
    for (const auto& z : zs)
        for (const auto& y : ys) {
            const auto row = (static_cast<std::size_t>(z.to) * static_cast<std::size_t>(grid.dims.y) +
                              static_cast<std::size_t>(y.to)) *
                             static_cast<std::size_t>(grid.dims.x);
            for (const auto& x : xs)
                out[row + static_cast<std::size_t>(x.to)] = static_cast<Out>(valueAt(patch, in, x, y, z));
        }
}

} // namespace

PointResampling::PointResampling(const std::string& name, std::vector<CellPatch> patches)
    : patches_(std::move(patches)) {
    checkLevels(name, patches_);
    glm::dvec3 low = patches_.front().low;
    glm::dvec3 high = low;
    for (const auto& patch : patches_) {
        low = glm::min(low, patch.low);
        high = glm::max(high, patch.low + patch.cellSize * glm::dvec3(patch.dims - 1));
    }
    const double most = mostSamples(patches_);
    for (auto patch = patches_.rbegin();; ++patch) { // from the finest level on
        if (patch == patches_.rend()) failTooMany(name, "points");
        const auto counts = glm::round((high - low) / patch->cellSize) + 1.0;
        if (!(counts.x * counts.y * counts.z <= most)) continue;
        level_ = patch->level;
        grid_.dims = glm::ivec3(counts);
        for (int axis = 0; axis < 3; ++axis) {
            const double step = grid_.dims[axis] > 1 ? (high[axis] - low[axis]) / (counts[axis] - 1.0)
                                                     : patch->cellSize[axis];
            grid_.worldFromIndex[axis] = glm::dvec4(0.0);
            grid_.worldFromIndex[axis][axis] = step;
        }
        break;
    }
    grid_.worldFromIndex[3] = glm::dvec4(low, 1.0);
    grid_.centring = Centring::Point;
    validateGrid(grid_);
}

std::string PointResampling::note() const {
    return "Resampled: " + describePatches(patches_, grid_.dims, "points") + " with the spacing of level " +
           std::to_string(level_) +
           ", each with the value of the finest patch there, between its points by linear interpolation. "
           "Places without a patch have no value.";
}

ScalarType PointResampling::resultType(ScalarType source) const {
    if (isFloat(source)) return source;
    return scalarBytes(source) <= 2 ? ScalarType::F32 : ScalarType::F64;
}

void PointResampling::paint(std::size_t patch, std::span<const std::byte> values, ScalarType type,
                            std::vector<std::byte>& points) const {
    paintTyped(patches_.at(patch), values, type, points,
               [&](auto in, auto out) { paintAs(grid_, patches_.at(patch), in, out); });
}

} // namespace voxsheet::import
