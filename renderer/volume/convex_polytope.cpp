#include "volume/convex_polytope.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace voxsheet {
namespace {

constexpr double kRelativeTolerance = 1e-12;

glm::dvec3 perpendicularTo(const glm::dvec3& normal) {
    const auto magnitude = glm::abs(normal);
    const glm::dvec3 other = magnitude.x <= magnitude.y && magnitude.x <= magnitude.z
                                 ? glm::dvec3(1.0, 0.0, 0.0)
                             : magnitude.y <= magnitude.z ? glm::dvec3(0.0, 1.0, 0.0)
                                                          : glm::dvec3(0.0, 0.0, 1.0);
    return glm::normalize(glm::cross(normal, other));
}

std::array<glm::dvec3, 8> cornersWorld(const Grid& grid) {
    const auto box = boxIndex(grid);
    std::array<glm::dvec3, 8> corners{};
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
        const glm::dvec3 index((corner & 1U) != 0 ? box.high.x : box.low.x,
                               (corner & 2U) != 0 ? box.high.y : box.low.y,
                               (corner & 4U) != 0 ? box.high.z : box.low.z);
        corners[corner] = glm::dvec3(grid.worldFromIndex * glm::dvec4(index, 1.0));
    }
    return corners;
}

/// Unit normal and centre of a polygon, the normal turned away from `inside`.
void orient(PolytopeFace& face, const glm::dvec3& inside) {
    const auto& p = face.polygon;
    glm::dvec3 area(0.0);
    for (std::size_t i = 2; i < p.size(); ++i)
        area += glm::cross(p[i - 1] - p[0], p[i] - p[0]);
    face.outwardNormal = glm::normalize(area);
    if (glm::dot(face.outwardNormal, p[0] - inside) < 0.0) {
        std::reverse(face.polygon.begin(), face.polygon.end());
        face.outwardNormal = -face.outwardNormal;
    }
}

ConvexPolytope wholeBox(const Grid& grid) {
    const auto corners = cornersWorld(grid);
    const auto centre = centreWorld(grid);
    ConvexPolytope polytope;
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
            const auto bit = [](int a) { return std::size_t{1} << static_cast<unsigned>(a); };
            const std::size_t base = side == 1 ? bit(axis) : 0;
            const std::size_t u = bit((axis + 1) % 3);
            const std::size_t v = bit((axis + 2) % 3);
            PolytopeFace face;
            face.origin = 2 * axis + side;
            face.polygon = {corners[base], corners[base | u], corners[base | u | v], corners[base | v]};
            orient(face, centre);
            polytope.faces.push_back(std::move(face));
        }
    return polytope;
}

/// The part of a polygon with distance >= 0 (Sutherland & Hodgman 1974); points on the plane are kept.
std::vector<glm::dvec3> keptPart(const std::vector<glm::dvec3>& polygon,
                                 const std::vector<double>& distances) {
    std::vector<glm::dvec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const std::size_t j = (i + 1) % polygon.size();
        if (distances[i] >= 0.0) kept.push_back(polygon[i]);
        if ((distances[i] > 0.0 && distances[j] < 0.0) || (distances[i] < 0.0 && distances[j] > 0.0)) {
            // From the lower to the higher end, so that both faces at this edge get the same point.
            const bool forward = distances[i] < distances[j];
            const auto& a = forward ? polygon[i] : polygon[j];
            const auto& b = forward ? polygon[j] : polygon[i];
            const double da = forward ? distances[i] : distances[j];
            const double db = forward ? distances[j] : distances[i];
            kept.push_back(a + (b - a) * (da / (da - db)));
        }
    }
    return kept;
}

/// Points of the cut, sorted around their centre; the same point from two faces counts once.
std::vector<glm::dvec3> ringOf(std::vector<glm::dvec3> points, const glm::dvec3& normal, double tolerance) {
    glm::dvec3 centre(0.0);
    for (const auto& point : points)
        centre += point / static_cast<double>(points.size());
    const auto u = perpendicularTo(normal);
    const auto v = glm::cross(normal, u);
    const auto angle = [&](const glm::dvec3& p) {
        return std::atan2(glm::dot(p - centre, v), glm::dot(p - centre, u));
    };
    std::sort(points.begin(), points.end(),
              [&](const glm::dvec3& a, const glm::dvec3& b) { return angle(a) < angle(b); });
    std::vector<glm::dvec3> ring;
    for (const auto& point : points)
        if (ring.empty() || glm::distance(ring.back(), point) > tolerance) ring.push_back(point);
    while (ring.size() > 1 && glm::distance(ring.front(), ring.back()) <= tolerance)
        ring.pop_back();
    return ring;
}

/// Distances of a face's points from a plane; those within the tolerance are on it.
std::vector<double> distancesOf(const PolytopeFace& face, const ClipPlane& plane, double tolerance) {
    std::vector<double> distances;
    for (const auto& point : face.polygon) {
        const double distance = glm::dot(plane.normal, point) - plane.offset;
        distances.push_back(std::abs(distance) <= tolerance ? 0.0 : distance);
    }
    return distances;
}

/// Cuts the polytope in place; `tolerance` in world units.
void cut(ConvexPolytope& polytope, const ClipPlane& plane, int origin, double tolerance) {
    bool above = false;
    bool below = false;
    std::vector<std::vector<double>> distances;
    for (const auto& face : polytope.faces) {
        distances.push_back(distancesOf(face, plane, tolerance));
        for (const double distance : distances.back()) {
            above = above || distance > 0.0;
            below = below || distance < 0.0;
        }
    }
    if (!above) polytope.faces.clear();
    if (!above || !below) return;

    ConvexPolytope kept;
    std::vector<glm::dvec3> onPlane;
    for (std::size_t i = 0; i < polytope.faces.size(); ++i) {
        auto face = polytope.faces[i];
        face.polygon = keptPart(face.polygon, distances[i]);
        const bool inPlane =
            std::all_of(distances[i].begin(), distances[i].end(), [](double d) { return d <= 0.0; });
        for (const auto& point : face.polygon)
            if (std::abs(glm::dot(plane.normal, point) - plane.offset) <= 2.0 * tolerance)
                onPlane.push_back(point);
        if (!inPlane && face.polygon.size() >= 3) kept.faces.push_back(std::move(face));
    }
    PolytopeFace cap;
    cap.origin = origin;
    cap.polygon = ringOf(std::move(onPlane), -plane.normal, 4.0 * tolerance);
    cap.outwardNormal = -plane.normal;
    if (cap.polygon.size() >= 3) kept.faces.push_back(std::move(cap));
    polytope = std::move(kept);
}

} // namespace

double ConvexPolytope::volume() const {
    double sum = 0.0;
    if (faces.empty()) return sum;
    const auto anchor = faces.front().polygon.front();
    for (const auto& face : faces)
        for (std::size_t i = 2; i < face.polygon.size(); ++i)
            sum += glm::dot(face.polygon[0] - anchor,
                            glm::cross(face.polygon[i - 1] - anchor, face.polygon[i] - anchor));
    return sum / 6.0;
}

ConvexPolytope clippedBox(const Grid& grid, std::span<const ClipPlane> planes) {
    auto polytope = wholeBox(grid);
    const double radius = boundingRadiusWorld(grid);
    for (std::size_t i = 0; i < planes.size() && !polytope.empty(); ++i) {
        const double size = radius + std::abs(glm::dot(planes[i].normal, centreWorld(grid)));
        cut(polytope, planes[i], ConvexPolytope::boxFaces + static_cast<int>(i), kRelativeTolerance * size);
    }
    return polytope;
}

} // namespace voxsheet
