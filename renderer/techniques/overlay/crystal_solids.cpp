#include "techniques/overlay/crystal_solids.h"

#include "volume/elements.h"

namespace voxsheet {
namespace {

constexpr glm::vec4 kLineColour(0.62F, 0.62F, 0.62F, 0.0F); // seen before black and before white
/// Atoms of a relaxed layer lie on both sides of a cut through its middle.
constexpr float kClipSlackRadii = 0.25F;

class SolidMaker {
public:
    SolidMaker(const Crystal& crystal, const Grid& grid, const TileSpec& tile)
        : crystal_(crystal), grid_(grid), tile_(tile) {
        const Grid drawn = drawnGrid(grid, tile.periodic);
        centre_ = centreWorld(drawn);
        unit_ = boundingRadiusWorld(drawn);
    }

    [[nodiscard]] std::vector<Solid> make() {
        const CrystalSpec& spec = tile_.crystal;
        if (spec.atoms || spec.bonds != BondReach::None) addSites();
        if (spec.cell) addLines();
        return std::move(solids_);
    }

private:
    [[nodiscard]] glm::vec3 place(const glm::dvec3& world) const { return {(world - centre_) / unit_}; }
    [[nodiscard]] float length(double world) const { return static_cast<float>(world / unit_); }

    void addSites() {
        const CrystalSpec& spec = tile_.crystal;
        const CrystalSites found = crystalSites(crystal_, grid_, tile_.periodic, spec.bonds);
        const auto radiusOf = [&](std::size_t site) {
            return length(spec.radiusScale * elementOf(found.sites[site].atomicNumber).covalentRadius);
        };
        const auto colourOf = [&](std::size_t site) {
            const auto colour = elementOf(found.sites[site].atomicNumber).colour;
            return glm::vec4(glm::vec3(colour), kClipSlackRadii * radiusOf(site));
        };
        for (std::size_t i = 0; spec.atoms && i < found.sites.size(); ++i) {
            const glm::vec3 at = place(found.sites[i].positionWorld);
            solids_.push_back({glm::vec4(at, radiusOf(i)), glm::vec4(at, 0.0F), colourOf(i), colourOf(i)});
        }
        const float bondRadius = length(2.0 * spec.radiusScale * kBondRadius);
        for (const auto& bond : found.bonds)
            solids_.push_back({glm::vec4(place(found.sites[bond.first].positionWorld), bondRadius),
                               glm::vec4(place(found.sites[bond.second].positionWorld), 0.0F),
                               colourOf(bond.first), colourOf(bond.second)});
    }

    void addLines() {
        const PlaneSpec& plane = tile_.plane;
        const auto lines = tile_.technique == Technique::Plane
                               ? cellOutlines(crystal_, grid_, tile_.periodic, plane.normal, plane.offset)
                               : cellEdges(crystal_, grid_, tile_.periodic);
        for (const Segment& line : lines)
            solids_.push_back({glm::vec4(place(line.start), 0.0F), glm::vec4(place(line.end), 1.0F),
                               kLineColour, kLineColour});
    }

    const Crystal& crystal_;
    const Grid& grid_;
    const TileSpec& tile_;
    glm::dvec3 centre_{0.0};
    double unit_ = 1.0;
    std::vector<Solid> solids_;
};

} // namespace

std::vector<Solid> crystalSolids(const Crystal& crystal, const Grid& grid, const TileSpec& tile) {
    return SolidMaker(crystal, grid, tile).make();
}

} // namespace voxsheet
