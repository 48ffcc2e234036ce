#include "fields/solids.h"

#include "volume/elements.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxsheet::fields {
namespace {

double radiusOf(const TileSpec& tile, const CrystalSite& site) {
    return tile.crystal.radiusScale * elementOf(site.atomicNumber).covalentRadius;
}

glm::dvec3 nearestOnAxis(const Capsule& capsule, const glm::dvec3& point) {
    const auto axis = capsule.end - capsule.start;
    const double square = glm::dot(axis, axis);
    if (square == 0.0) return capsule.start;
    return capsule.start + std::clamp(glm::dot(point - capsule.start, axis) / square, 0.0, 1.0) * axis;
}

glm::dvec3 colourAt(const Capsule& capsule, const glm::dvec3& onAxis) {
    return glm::distance(onAxis, capsule.start) < glm::distance(onAxis, capsule.end) ? capsule.startColour
           : capsule.start == capsule.end                                            ? capsule.startColour
                                                                                     : capsule.endColour;
}

/// Roots of a x^2 + 2 b x + c, each to `visit`.
template <typename Visit>
void visitRoots(double a, double b, double c, Visit visit) {
    const double discriminant = b * b - a * c;
    if (discriminant < 0.0 || a <= 0.0) return;
    visit((-b - std::sqrt(discriminant)) / a);
    visit((-b + std::sqrt(discriminant)) / a);
}

/// The first depth beyond `nearest` at which the ray passes the capsule's surface.
std::optional<double> surfaceDepth(const Capsule& capsule, const WorldRay& ray, double nearest) {
    std::optional<double> first;
    const auto consider = [&](double depth) {
        if (!(depth > nearest) || (first && *first <= depth)) return;
        const auto point = ray.at(depth);
        // Spheres and tube hold more of the surface than the capsule has: what lies inside does not count.
        if (glm::distance(point, nearestOnAxis(capsule, point)) > capsule.radius * (1.0 - 1e-9))
            first = depth;
    };
    const double square = capsule.radius * capsule.radius;
    for (const auto& centre : {capsule.start, capsule.end}) {
        const auto from = ray.origin - centre;
        visitRoots(glm::dot(ray.direction, ray.direction), glm::dot(from, ray.direction),
                   glm::dot(from, from) - square, consider);
    }
    if (capsule.start != capsule.end) {
        const auto axis = glm::normalize(capsule.end - capsule.start);
        const auto across = [&](const glm::dvec3& v) { return v - glm::dot(v, axis) * axis; };
        const auto from = across(ray.origin - capsule.start);
        const auto direction = across(ray.direction);
        visitRoots(glm::dot(direction, direction), glm::dot(from, direction), glm::dot(from, from) - square,
                   [&](double depth) {
                       const double along = glm::dot(ray.at(depth) - capsule.start, axis);
                       if (along >= 0.0 && along <= glm::distance(capsule.start, capsule.end))
                           consider(depth);
                   });
    }
    return first;
}

} // namespace

std::vector<Capsule> capsulesOf(const TileSpec& tile, const DatasetMeta& meta,
                                const std::function<double(const glm::dvec3&)>& objectMeasure) {
    std::vector<Capsule> capsules;
    if (!meta.crystal || (!tile.crystal.atoms && tile.crystal.bonds == BondReach::None)) return capsules;
    const auto found = crystalSites(*meta.crystal, meta.grid, tile.periodic, tile.crystal.bonds);
    const auto isKept = [&](const CrystalSite& site) {
        if (tile.technique == Technique::Plane) return true;
        const double slack = 0.25 * radiusOf(tile, site);
        for (const auto& plane : tile.clip.planes)
            if (glm::dot(plane.normal, site.positionWorld) - plane.offset < -slack) return false;
        if (!objectMeasure) return true;
        const double scale =
            std::cbrt(std::abs(glm::determinant(glm::dmat3(tile.clip.object->objectFromWorld))));
        return objectMeasure(site.positionWorld) >= -slack * scale;
    };
    for (const auto& site : found.sites) {
        if (!tile.crystal.atoms || !isKept(site)) continue;
        const auto colour = elementOf(site.atomicNumber).colour;
        capsules.push_back({site.positionWorld, site.positionWorld, radiusOf(tile, site), colour, colour});
    }
    for (const auto& bond : found.bonds) {
        const auto& first = found.sites[bond.first];
        const auto& second = found.sites[bond.second];
        if (isKept(first) && isKept(second))
            capsules.push_back({first.positionWorld, second.positionWorld,
                                0.12 * tile.crystal.radiusScale / 0.5, elementOf(first.atomicNumber).colour,
                                elementOf(second.atomicNumber).colour});
    }
    return capsules;
}

std::optional<SolidHit> firstSolidHit(const TileSpec& tile, const std::vector<Capsule>& capsules,
                                      const WorldRay& ray) {
    const double nearest =
        tile.camera.projection == Projection::Perspective ? 0.0 : -std::numeric_limits<double>::infinity();
    std::optional<SolidHit> hit;
    for (const auto& capsule : capsules) {
        const auto depth = surfaceDepth(capsule, ray, nearest);
        if (!depth || (hit && hit->depth <= *depth)) continue;
        const auto onAxis = nearestOnAxis(capsule, ray.at(*depth));
        hit = SolidHit{*depth, ray.at(*depth) - onAxis, colourAt(capsule, onAxis)};
    }
    return hit;
}

std::optional<SolidHit> cutSolidHit(const TileSpec& tile, const std::vector<Capsule>& capsules,
                                    const WorldRay& ray) {
    const auto& plane = tile.plane;
    const double depth =
        (plane.offset - glm::dot(plane.normal, ray.origin)) / glm::dot(plane.normal, ray.direction);
    std::optional<SolidHit> hit;
    double nearest = 1.0;
    for (const auto& capsule : capsules) {
        const auto onAxis = nearestOnAxis(capsule, ray.at(depth));
        const double nearness = glm::distance(ray.at(depth), onAxis) / capsule.radius;
        if (nearness > nearest) continue;
        nearest = nearness;
        hit = SolidHit{depth, {}, colourAt(capsule, onAxis)};
    }
    return hit;
}

} // namespace voxsheet::fields
