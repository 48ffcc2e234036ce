#include "engine/atom_probe.h"

#include "volume/elements.h"

#include <algorithm>
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

} // namespace

std::optional<AtomHit> atomUnderRay(const TileSpec& tile, const CrystalSites& sites, const Ray& ray) {
    if (!tile.crystal.atoms) return std::nullopt;
    const bool flat = tile.technique == Technique::Plane;
    if (tile.clip.object && !flat) return std::nullopt;
    const auto isKept = [&](const glm::dvec3& centre) {
        return flat ||
               std::all_of(tile.clip.planes.begin(), tile.clip.planes.end(), [&](const ClipPlane& plane) {
                   return glm::dot(plane.normal, centre) >= plane.offset;
               });
    };
    const auto onPlane = flat ? depthOnPlane(tile.plane, ray) : std::nullopt;
    std::optional<AtomHit> nearest;
    for (const CrystalSite& site : sites.sites) {
        if (!isKept(site.positionWorld)) continue;
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
