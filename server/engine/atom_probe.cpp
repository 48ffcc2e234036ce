#include "engine/atom_probe.h"

#include "volume/elements.h"

#include <cmath>

namespace voxsheet::engine {

namespace {

/// Depth at which the ray meets the plane; not set: alongside it.
std::optional<double> depthOnPlane(const PlaneSpec& plane, const Ray& ray) {
    const double slope = glm::dot(plane.normal, ray.direction);
    const double depth = (plane.offset - glm::dot(plane.normal, ray.origin)) / slope;
    if (!std::isfinite(depth)) return std::nullopt;
    return depth;
}

/// Depth at which the ray enters the sphere.
std::optional<double> depthOnSphere(const glm::dvec3& centre, double radius, const Ray& ray) {
    const double middle = glm::dot(centre - ray.origin, ray.direction);
    const glm::dvec3 across = centre - ray.at(middle);
    const double square = radius * radius - glm::dot(across, across);
    if (square < 0.0) return std::nullopt;
    const double depth = middle - std::sqrt(square);
    if (depth < 0.0) return std::nullopt;
    return depth;
}

bool isKept(const ClipSpec& clip, const glm::dvec3& centre, const ObjectSamples* object) {
    for (const ClipPlane& plane : clip.planes)
        if (glm::dot(plane.normal, centre) < plane.offset) return false;
    if (!clip.object) return true;
    const Ray fromCentre{centre, {0.0, 0.0, 1.0}};
    return ObjectCut(fromCentre, *clip.object, *object).keeps(0.0);
}

} // namespace

std::optional<AtomHit> atomUnderRay(const TileSpec& tile, const CrystalSites& sites, const Ray& ray,
                                    const ObjectSamples* object) {
    if (!tile.crystal.atoms) return std::nullopt;
    const bool flat = tile.technique == Technique::Plane;
    const auto onPlane = flat ? depthOnPlane(tile.plane, ray) : std::nullopt;
    std::optional<AtomHit> nearest;
    for (const CrystalSite& site : sites.sites) {
        if (!flat && !isKept(tile.clip, site.positionWorld, object)) continue;
        const double radius = tile.crystal.radiusScale * elementOf(site.atomicNumber).covalentRadius;
        auto depth = onPlane;
        if (!flat)
            depth = depthOnSphere(site.positionWorld, radius, ray);
        else if (depth && glm::distance(ray.at(*depth), site.positionWorld) > radius)
            depth.reset();
        if (depth && (!nearest || *depth < nearest->depth))
            nearest = AtomHit{site.atomicNumber, site.positionWorld, *depth};
    }
    return nearest;
}

} // namespace voxsheet::engine
