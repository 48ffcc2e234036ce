#include "engine/visible_range.h"

#include "engine/sample_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace voxsheet::engine {

namespace {

/// Samples of one level as points of the world.
struct Lattice {
    glm::ivec3 dims;
    glm::dvec3 first; ///< of sample (0, 0, 0)
    glm::dmat3 edges; ///< columns: from sample to sample

    [[nodiscard]] glm::dvec3 at(int i, int j, int k) const { return first + edges * glm::dvec3(i, j, k); }
};

/// \param grid  placed (volume/periodic_window.h)
Lattice latticeOf(const Grid& grid, int level) {
    Lattice lattice;
    lattice.dims = levelDims(grid.dims, level);
    const glm::dmat4 world = worldFromTexture(grid);
    const glm::dvec3 texel = 1.0 / glm::dvec3(lattice.dims);
    lattice.first = glm::dvec3(world * glm::dvec4(0.5 * texel, 1.0));
    for (int axis = 0; axis < 3; ++axis)
        lattice.edges[axis] = glm::dvec3(world[axis]) * texel[axis];
    return lattice;
}

/// Where (xyz, w) . (p, 1) >= 0.
using HalfSpace = glm::dvec4;

/// What the edges of the picture, and the eye, leave of the world.
std::vector<HalfSpace> pictureEdges(const CameraSpec& camera, glm::ivec2 sizePixels) {
    const double aspect = static_cast<double>(sizePixels.x) / static_cast<double>(sizePixels.y);
    std::vector<HalfSpace> view;
    if (camera.projection == Projection::Perspective) {
        const double half = std::tan(glm::radians(camera.fovYDegrees) / 2.0);
        view = {{1, 0, -half * aspect, 0}, {-1, 0, -half * aspect, 0}, {0, 1, -half, 0}, {0, -1, -half, 0}};
        view.emplace_back(0, 0, -1, 0);
    } else {
        const double half = camera.heightWorld / 2.0;
        view = {{1, 0, 0, half * aspect}, {-1, 0, 0, half * aspect}, {0, 1, 0, half}, {0, -1, 0, half}};
    }
    for (HalfSpace& each : view)
        each = glm::transpose(camera.viewFromWorld) * each;
    return view;
}

/// A sample takes part in the interpolation on a plane if the plane is less than a voxel away.
void addSlab(std::vector<HalfSpace>& spaces, const PlaneSpec& plane, const Lattice& lattice) {
    double reach = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        reach += std::abs(glm::dot(plane.normal, lattice.edges[axis]));
    reach *= plane.interpolation == PlaneInterpolation::Nearest ? 0.5 : 1.0 - 1e-6;
    spaces.emplace_back(plane.normal, reach - plane.offset);
    spaces.emplace_back(-plane.normal, reach + plane.offset);
}

/// The samples i of a row that lie in all half-spaces: first to second; none if first > second.
std::pair<int, int> keptPart(const std::vector<HalfSpace>& spaces, const glm::dvec3& start,
                             const glm::dvec3& edge, int count) {
    double low = 0.0;
    double high = count - 1.0;
    for (const HalfSpace& space : spaces) {
        const double advance = glm::dot(glm::dvec3(space), edge);
        const double value = glm::dot(glm::dvec3(space), start) + space.w;
        if (advance > 0.0) low = std::max(low, -value / advance);
        if (advance < 0.0) high = std::min(high, -value / advance);
        if (advance == 0.0 && value < 0.0) return {1, 0};
    }
    if (low > high) return {1, 0};
    return {static_cast<int>(std::ceil(low)), static_cast<int>(std::floor(high))};
}

/// A periodic volume's samples stand again one period further, as often as the drawn box holds them; the box
/// itself begins up to a period after its first sample.
std::vector<glm::dvec3> periodOffsets(const Grid& placed, const PeriodicWindow& window) {
    glm::ivec3 first(0);
    glm::ivec3 last(0);
    for (int axis = 0; axis < 3; ++axis) {
        if (!placed.periodic[axis]) continue;
        first[axis] = -1;
        last[axis] = window.replicate[axis];
    }
    const glm::dmat3 edges(placed.worldFromIndex);
    std::vector<glm::dvec3> offsets;
    for (int c = first.z; c <= last.z; ++c)
        for (int b = first.y; b <= last.y; ++b)
            for (int a = first.x; a <= last.x; ++a)
                offsets.push_back(edges * (glm::dvec3(a, b, c) * glm::dvec3(placed.dims)));
    return offsets;
}

/// Only where samples stand outside the drawn box at all.
void addBox(std::vector<HalfSpace>& spaces, const Grid& drawn) {
    if (!drawn.periodic.x && !drawn.periodic.y && !drawn.periodic.z) return;
    constexpr double tolerance = 1e-6; // voxels
    const IndexBox box = boxIndex(drawn);
    const glm::dmat4 rows = glm::transpose(glm::inverse(drawn.worldFromIndex));
    for (int axis = 0; axis < 3; ++axis) {
        if (!drawn.periodic[axis]) continue;
        spaces.push_back(rows[axis] - HalfSpace(0, 0, 0, box.low[axis] - tolerance));
        spaces.push_back(HalfSpace(0, 0, 0, box.high[axis] + tolerance) - rows[axis]);
    }
}

} // namespace

std::optional<ValueExtremes> visibleRange(const TileSpec& tile, const DatasetMeta& meta,
                                          const VolumeProvider& volumes, const ObjectSamples* object) {
    VolumeKey key{meta.key, tile.field, tile.step, 0};
    while (key.level + 1 < meta.levels() &&
           sampleCount(levelDims(meta.grid.dims, key.level)) > kVisibleSamples)
        ++key.level;
    const Grid placed = placedGrid(meta.grid, tile.periodic);
    const Lattice lattice = latticeOf(placed, key.level);
    std::vector<HalfSpace> spaces = pictureEdges(tile.camera, tile.sizePixels);
    const bool plane = tile.technique == Technique::Plane;
    if (plane) addSlab(spaces, tile.plane, lattice);
    for (const ClipPlane& clip : tile.clip.planes)
        spaces.emplace_back(clip.normal, -clip.offset);
    addBox(spaces, drawnGrid(meta.grid, tile.periodic));
    const std::vector<glm::dvec3> offsets = periodOffsets(placed, tile.periodic);
    const bool cuts = object != nullptr && tile.clip.object && !plane;

    ValueExtremes range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    const double step = glm::length(lattice.edges[0]);
    for (int k = 0; k < lattice.dims.z; ++k) {
        std::vector<double> slice; // Read where something of it is kept.
        for (int j = 0; j < lattice.dims.y; ++j) {
            for (const glm::dvec3& offset : offsets) {
                const glm::dvec3 start = lattice.at(0, j, k) + offset;
                const auto [first, last] = keptPart(spaces, start, lattice.edges[0], lattice.dims.x);
                if (first > last) continue;
                if (slice.empty()) slice = readValues(volumes, meta, key, k, 1);
                std::optional<ObjectCut> cut;
                if (cuts) cut.emplace(Ray{start, lattice.edges[0] / step}, *tile.clip.object, *object);
                const double* row =
                    slice.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(lattice.dims.x);
                for (int i = first; i <= last; ++i) {
                    const double value = row[i];
                    if (!std::isfinite(value) || (cut && !cut->keeps(i * step))) continue;
                    range.min = std::min(range.min, value);
                    range.max = std::max(range.max, value);
                }
            }
        }
    }
    if (range.min > range.max) return std::nullopt;
    return range;
}

} // namespace voxsheet::engine
