#include "import/mesh/triangle_geometry.h"

#include <algorithm>
#include <cmath>

namespace voxsheet::import {

namespace {

using glm::dvec2;
using glm::dvec3;

ClosestPoint at(const dvec3& from, const dvec3& point, TrianglePart part) {
    const auto offset = from - point;
    return {point, glm::dot(offset, offset), part};
}

/// Six times the volume of a tetrahedron: positive if d is on the side from which a, b, c run anticlockwise;
/// 0 within the rounding of its calculation.
class Side3 {
public:
    Side3(const Corners& a, const Corners& b) {
        dvec3 low = a[0];
        dvec3 high = a[0];
        for (const auto* triangle : {&a, &b})
            for (const auto& corner : *triangle) {
                low = glm::min(low, corner);
                high = glm::max(high, corner);
            }
        const double length = glm::length(high - low);
        rounding_ = 1e-13 * length * length * length;
    }

    [[nodiscard]] double operator()(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d) const {
        const double volume = glm::dot(glm::cross(b - a, c - a), d - a);
        return std::abs(volume) <= rounding_ ? 0.0 : volume;
    }

private:
    double rounding_ = 0.0;
};

/// A segment that crosses a triangle's plane, or ends in it; one that lies in the plane does not count.
bool segmentMeets(const Side3& side, const dvec3& p, const dvec3& q, const Corners& t, bool countTouching) {
    const double before = side(t[0], t[1], t[2], p);
    const double after = side(t[0], t[1], t[2], q);
    if (before * after > 0.0 || (before == 0.0 && after == 0.0)) return false;
    if (!countTouching && (before == 0.0 || after == 0.0)) return false;
    const double a = side(p, q, t[0], t[1]);
    const double b = side(p, q, t[1], t[2]);
    const double c = side(p, q, t[2], t[0]);
    return (a >= 0.0 && b >= 0.0 && c >= 0.0) || (a <= 0.0 && b <= 0.0 && c <= 0.0);
}

double side2(const dvec2& a, const dvec2& b, const dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool segmentsCross(const dvec2& a, const dvec2& b, const dvec2& c, const dvec2& d) {
    return side2(a, b, c) * side2(a, b, d) < 0.0 && side2(c, d, a) * side2(c, d, b) < 0.0;
}

bool holds(const std::array<dvec2, 3>& t, const dvec2& p) {
    const double a = side2(t[0], t[1], p);
    const double b = side2(t[1], t[2], p);
    const double c = side2(t[2], t[0], p);
    return (a > 0.0 && b > 0.0 && c > 0.0) || (a < 0.0 && b < 0.0 && c < 0.0);
}

/// Seen along the axis that is nearest to the normal.
bool coplanarOverlap(const Corners& a, const Corners& b) {
    const auto normal = glm::abs(glm::cross(a[1] - a[0], a[2] - a[0]));
    const int axis = normal.x >= normal.y && normal.x >= normal.z ? 0 : normal.y >= normal.z ? 1 : 2;
    const auto flat = [axis](const dvec3& p) { return dvec2(p[(axis + 1) % 3], p[(axis + 2) % 3]); };
    const std::array<dvec2, 3> s{flat(a[0]), flat(a[1]), flat(a[2])};
    const std::array<dvec2, 3> t{flat(b[0]), flat(b[1]), flat(b[2])};
    for (std::size_t i = 0; i < 3; ++i) {
        if (holds(s, t[i]) || holds(t, s[i])) return true;
        for (std::size_t j = 0; j < 3; ++j)
            if (segmentsCross(s[i], s[(i + 1) % 3], t[j], t[(j + 1) % 3])) return true;
    }
    return false;
}

} // namespace

ClosestPoint closestPoint(const dvec3& p, const Corners& triangle) {
    const auto& [a, b, c] = triangle;
    const auto ab = b - a;
    const auto ac = c - a;
    const double d1 = glm::dot(ab, p - a);
    const double d2 = glm::dot(ac, p - a);
    if (d1 <= 0.0 && d2 <= 0.0) return at(p, a, TrianglePart::Corner0);
    const double d3 = glm::dot(ab, p - b);
    const double d4 = glm::dot(ac, p - b);
    if (d3 >= 0.0 && d4 <= d3) return at(p, b, TrianglePart::Corner1);
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && d1 > d3)
        return at(p, a + ab * (d1 / (d1 - d3)), TrianglePart::Side0);
    const double d5 = glm::dot(ab, p - c);
    const double d6 = glm::dot(ac, p - c);
    if (d6 >= 0.0 && d5 <= d6) return at(p, c, TrianglePart::Corner2);
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 && d2 > d6)
        return at(p, a + ac * (d2 / (d2 - d6)), TrianglePart::Side2);
    const double va = d3 * d6 - d5 * d4;
    const double d43 = d4 - d3;
    const double d56 = d5 - d6;
    if (va <= 0.0 && d43 >= 0.0 && d56 >= 0.0 && d43 + d56 > 0.0)
        return at(p, b + (c - b) * (d43 / (d43 + d56)), TrianglePart::Side1);
    const double sum = va + vb + vc;
    if (!(sum > 0.0)) return at(p, a, TrianglePart::Corner0); // rounding of a triangle without area
    return at(p, a + ab * (vb / sum) + ac * (vc / sum), TrianglePart::Face);
}

bool trianglesMeet(const Corners& a, const Corners& b) {
    const Side3 side(a, b);
    const auto inPlane = [&](const dvec3& p) { return side(a[0], a[1], a[2], p) == 0.0; };
    if (inPlane(b[0]) && inPlane(b[1]) && inPlane(b[2])) return coplanarOverlap(a, b);
    for (std::size_t i = 0; i < 3; ++i)
        if (segmentMeets(side, a[i], a[(i + 1) % 3], b, true) ||
            segmentMeets(side, b[i], b[(i + 1) % 3], a, true))
            return true;
    return false;
}

bool trianglesCutBesideCorner(const Corners& a, const Corners& b) {
    const Side3 side(a, b);
    return segmentMeets(side, a[1], a[2], b, false) || segmentMeets(side, b[1], b[2], a, false);
}

} // namespace voxsheet::import
