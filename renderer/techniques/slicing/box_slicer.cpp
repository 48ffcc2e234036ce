#include "techniques/slicing/box_slicer.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>

namespace voxsheet {
namespace {

constexpr double kMaxSlices = 0x1p20;

/// An edge runs along `axis` from corner `low`, whose bit of that axis is 0.
struct Edge {
    int axis;
    int low;
    bool operator==(const Edge&) const = default;
};

struct EdgeRing {
    int count = 0;
    std::array<Edge, 6> edges{};
};

int highCorner(const Edge& edge) { return edge.low | (1 << edge.axis); }

bool crosses(const BoxCorners& corners, const Edge& edge, double depth) {
    return (corners[static_cast<std::size_t>(edge.low)].z < depth) !=
           (corners[static_cast<std::size_t>(highCorner(edge))].z < depth);
}

/// Faces are (axis, side); an edge along axis a lies in the two faces of the other axes on the sides of its
/// low corner.
bool liesIn(const Edge& edge, int faceAxis, int side) {
    return edge.axis != faceAxis && ((edge.low >> faceAxis) & 1) == side;
}

/// The edges that the plane at `depth` crosses, in order around the polygon: neighbours share a face. The
/// plane must pass no corner.
EdgeRing crossedRing(const BoxCorners& corners, double depth) {
    std::vector<Edge> crossed;
    for (int axis = 0; axis < 3; ++axis)
        for (int low = 0; low < 8; ++low)
            if (((low >> axis) & 1) == 0 && crosses(corners, {axis, low}, depth))
                crossed.push_back({axis, low});
    EdgeRing ring;
    if (crossed.size() < 3 || crossed.size() > 6) return ring;
    Edge current = crossed.front();
    int arrivedAxis = -1;
    int arrivedSide = -1;
    do {
        ring.edges[static_cast<std::size_t>(ring.count++)] = current;
        const Edge from = current;
        for (int faceAxis = 0; faceAxis < 3 && current == from; ++faceAxis) {
            const int side = (from.low >> faceAxis) & 1;
            if (faceAxis == from.axis || (faceAxis == arrivedAxis && side == arrivedSide)) continue;
            // A plane that crosses one edge of a face crosses exactly one other of its edges.
            const auto next = std::find_if(crossed.begin(), crossed.end(), [&](const Edge& edge) {
                return !(edge == from) && liesIn(edge, faceAxis, side);
            });
            if (next == crossed.end()) return EdgeRing{};
            current = *next;
            arrivedAxis = faceAxis;
            arrivedSide = side;
        }
    } while (!(current == crossed.front()) && ring.count < 6);
    return ring;
}

struct MovingPoint {
    glm::dvec2 at;       ///< at the depth asked for
    glm::dvec2 perDepth; ///< movement per unit of depth
};

MovingPoint pointOn(const BoxCorners& corners, const Edge& edge, double depth) {
    const auto& a = corners[static_cast<std::size_t>(edge.low)];
    const auto& b = corners[static_cast<std::size_t>(highCorner(edge))];
    const glm::dvec2 perDepth = glm::dvec2(b - a) / (b.z - a.z);
    return {glm::dvec2(a) + (depth - a.z) * perDepth, perDepth};
}

/// Slices of planes first, first - 1, …, last, all within one interval between corners.
void sweepInterval(const BoxCorners& corners, const SlicePlanes& planes, long first, long last,
                   std::vector<Slice>& slices) {
    const auto depthOf = [&](long plane) { return planes.anchor + (double(plane) + 0.5) * planes.spacing; };
    const auto ring = crossedRing(corners, depthOf(first));
    if (ring.count < 3) return;
    std::array<glm::dvec2, 6> point{};
    std::array<glm::dvec2, 6> step{};
    for (std::size_t i = 0; i < static_cast<std::size_t>(ring.count); ++i) {
        const auto moving = pointOn(corners, ring.edges[i], depthOf(first));
        point[i] = moving.at;
        step[i] = -planes.spacing * moving.perDepth;
    }
    for (long plane = first; plane >= last; --plane) {
        slices.push_back({depthOf(plane), ring.count, point});
        for (std::size_t i = 0; i < point.size(); ++i)
            point[i] += step[i];
    }
}

} // namespace

std::vector<Slice> sliceBox(const BoxCorners& corners, const SlicePlanes& planes) {
    std::array<double, 8> depths{};
    std::transform(corners.begin(), corners.end(), depths.begin(),
                   [](const glm::dvec3& corner) { return corner.z; });
    std::sort(depths.begin(), depths.end());
    if ((depths.back() - depths.front()) / planes.spacing > kMaxSlices)
        throw InvalidInput("sample distance", "it would need more than a million slices",
                           "use a larger distance")
            .withField("sampling.distance");

    std::vector<Slice> slices;
    for (std::size_t upper = depths.size() - 1; upper > 0; --upper) {
        const double far = depths[upper];
        const double near = std::max(depths[upper - 1], planes.nearest);
        // Planes with near < depth <= far: a plane through a corner belongs to the interval before it.
        const auto planeBelow = [&](double depth) {
            return static_cast<long>(std::floor((depth - planes.anchor) / planes.spacing - 0.5));
        };
        if (!(near < far)) continue;
        const long first = planeBelow(far);
        const long last = planeBelow(near) + 1;
        if (first >= last) sweepInterval(corners, planes, first, last, slices);
    }
    return slices;
}

} // namespace voxsheet
