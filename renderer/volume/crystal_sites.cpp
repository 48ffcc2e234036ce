#include "volume/crystal_sites.h"

#include "base/errors.h"
#include "volume/elements.h"
#include "volume/neighbour_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace voxsheet {
namespace {

constexpr double kOnFace = 0.02;        ///< Å
constexpr double kNearest = 0.4;        ///< Å
constexpr double kBondTolerance = 0.45; ///< Å
constexpr double kCommensurate = 1e-3;  ///< of a lattice vector

bool isMetal(int atomicNumber) {
    static constexpr int others[] = {1,  2,  5,  6,  7,  8,  9,  10, 14, 15, 16, 17,  18,
                                     32, 33, 34, 35, 36, 51, 52, 53, 54, 85, 86, 117, 118};
    return atomicNumber > 0 &&
           std::find(std::begin(others), std::end(others), atomicNumber) == std::end(others);
}

/// The drawn box as edge vectors from its low corner.
struct Box {
    glm::dvec3 corner;
    glm::dmat3 edges;
    glm::bvec3 periodic;
};

Box drawnBox(const Grid& grid, const PeriodicWindow& window) {
    const auto drawn = drawnGrid(grid, window);
    const auto index = boxIndex(drawn);
    Box box{glm::dvec3(drawn.worldFromIndex * glm::dvec4(index.low, 1.0)), {}, grid.periodic};
    for (int axis = 0; axis < 3; ++axis)
        box.edges[axis] = glm::dvec3(drawn.worldFromIndex[axis]) * (index.high[axis] - index.low[axis]);
    return box;
}

bool areNear(const glm::dmat3& a, const glm::dmat3& b) {
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            if (!(std::abs(a[column][row] - b[column][row]) < kCommensurate)) return false;
    return true;
}

bool isWhole(const glm::dmat3& matrix) {
    return areNear(matrix, glm::dmat3(glm::round(matrix[0]), glm::round(matrix[1]), glm::round(matrix[2])));
}

glm::dmat3 periodsOf(const Grid& grid) {
    glm::dmat3 periods;
    for (int axis = 0; axis < 3; ++axis)
        periods[axis] = glm::dvec3(grid.worldFromIndex[axis]) * static_cast<double>(grid.dims[axis]);
    return periods;
}

/// Translations that repeat the atoms; only those of periodic axes count.
glm::dmat3 translations(const Crystal& crystal, const Grid& grid) {
    const auto periods = periodsOf(grid);
    if (!glm::all(grid.periodic) || glm::determinant(crystal.lattice) == 0.0) return periods;
    return isWhole(glm::inverse(crystal.lattice) * periods) ? crystal.lattice : periods;
}

/// Finds the images of atoms in the box and within a margin around it.
class ImageFinder {
public:
    ImageFinder(const Crystal& crystal, const Grid& grid, const PeriodicWindow& window, double margin)
        : box_(drawnBox(grid, window)), repeat_(translations(crystal, grid)),
          boxFromWorld_(glm::inverse(box_.edges)), repeatFromWorld_(glm::inverse(repeat_)) {
        const auto facesApart = [&](int axis) {
            const glm::dvec3 row(boxFromWorld_[0][axis], boxFromWorld_[1][axis], boxFromWorld_[2][axis]);
            return 1.0 / glm::length(row);
        };
        for (int axis = 0; axis < 3; ++axis) {
            slack_[axis] = kOnFace / facesApart(axis);
            margin_[axis] = std::max(margin, kOnFace) / facesApart(axis);
        }
        const auto shift = wrappedShift(window);
        const auto periods = periodsOf(grid);
        moved_ = periods * shift;
        const auto [low, high] = boxInTranslations();
        low_ = low;
        high_ = high;
    }

    /// visit(position, inBox) for every image.
    template <typename Visit>
    void visitImages(const glm::dvec3& positionInFile, Visit visit) const {
        const glm::dvec3 position = positionInFile + moved_;
        const glm::dvec3 at = repeatFromWorld_ * (position - box_.corner);
        glm::ivec3 first(0);
        glm::ivec3 last(0);
        for (int axis = 0; axis < 3; ++axis) {
            if (!box_.periodic[axis]) continue;
            first[axis] = static_cast<int>(std::ceil(low_[axis] - at[axis]));
            last[axis] = static_cast<int>(std::floor(high_[axis] - at[axis]));
        }
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x) {
                    const glm::dvec3 image = position + repeat_ * glm::dvec3(x, y, z);
                    const glm::dvec3 inBox = boxFromWorld_ * (image - box_.corner);
                    if (lies(inBox, margin_)) visit(image, lies(inBox, slack_));
                }
    }

private:
    [[nodiscard]] bool lies(const glm::dvec3& inBox, const glm::dvec3& beyond) const {
        for (int axis = 0; axis < 3; ++axis)
            if (box_.periodic[axis] && !(inBox[axis] >= -beyond[axis] && inBox[axis] <= 1.0 + beyond[axis]))
                return false;
        return true;
    }
    [[nodiscard]] std::pair<glm::dvec3, glm::dvec3> boxInTranslations() const {
        glm::dvec3 low(1e300);
        glm::dvec3 high(-1e300);
        for (int corner = 0; corner < 8; ++corner) {
            glm::dvec3 at;
            for (int axis = 0; axis < 3; ++axis)
                at[axis] = ((corner >> axis) & 1) != 0 ? 1.0 + margin_[axis] : -margin_[axis];
            const glm::dvec3 repeats = repeatFromWorld_ * (box_.edges * at);
            low = glm::min(low, repeats);
            high = glm::max(high, repeats);
        }
        return {low, high};
    }

    Box box_;
    glm::dmat3 repeat_;
    glm::dmat3 boxFromWorld_;
    glm::dmat3 repeatFromWorld_;
    glm::dvec3 slack_{0.0};
    glm::dvec3 margin_{0.0};
    glm::dvec3 moved_{0.0};
    glm::dvec3 low_{0.0};
    glm::dvec3 high_{0.0};
};

double largestRadius(const Crystal& crystal) {
    double largest = 0.0;
    for (const Atom& atom : crystal.atoms)
        largest = std::max(largest, elementOf(atom.atomicNumber).covalentRadius);
    return largest;
}

void requireFewEnough(std::size_t sites) {
    if (sites <= kMaxCrystalSites) return;
    throw LimitExceeded("atoms of the picture", "there are more than " + std::to_string(kMaxCrystalSites),
                        "draw fewer periods, or switch crystal.atoms and crystal.bonds off")
        .withField("periodic.replicate");
}

class BondRule {
public:
    explicit BondRule(const Crystal& crystal)
        : metalsBond_(std::all_of(crystal.atoms.begin(), crystal.atoms.end(),
                                  [](const Atom& atom) { return isMetal(atom.atomicNumber); })) {}
    [[nodiscard]] bool bonds(const CrystalSite& a, const CrystalSite& b) const {
        if (!metalsBond_ && isMetal(a.atomicNumber) && isMetal(b.atomicNumber)) return false;
        const double distance = glm::distance(a.positionWorld, b.positionWorld);
        const double radii =
            elementOf(a.atomicNumber).covalentRadius + elementOf(b.atomicNumber).covalentRadius;
        return distance > kNearest && distance < radii + kBondTolerance;
    }

private:
    bool metalsBond_;
};

std::vector<CrystalBond> bondsBetween(const std::vector<CrystalSite>& sites, const BondRule& rule,
                                      double longest) {
    std::vector<glm::dvec3> positions;
    positions.reserve(sites.size());
    for (const CrystalSite& site : sites)
        positions.push_back(site.positionWorld);
    std::vector<CrystalBond> bonds;
    forEachPairWithin(positions, longest, [&](std::size_t first, std::size_t second) {
        if (!sites[first].inBox && !sites[second].inBox) return;
        if (rule.bonds(sites[first], sites[second])) bonds.push_back({first, second});
    });
    return bonds;
}

/// Leaves out sites beyond the box to which no bond leads.
CrystalSites withoutStrays(const std::vector<CrystalSite>& sites, std::vector<CrystalBond> bonds) {
    std::vector<bool> used(sites.size());
    for (std::size_t i = 0; i < sites.size(); ++i)
        used[i] = sites[i].inBox;
    for (const CrystalBond& bond : bonds)
        used[bond.first] = used[bond.second] = true;
    std::vector<std::size_t> place(sites.size());
    CrystalSites kept;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        place[i] = kept.sites.size();
        if (used[i]) kept.sites.push_back(sites[i]);
    }
    for (CrystalBond& bond : bonds)
        bond = {place[bond.first], place[bond.second]};
    kept.bonds = std::move(bonds);
    return kept;
}

/// How many unit cells the box holds per axis, and their edges from the box's low corner.
struct Cells {
    glm::dvec3 corner;
    glm::dmat3 edges;
    glm::ivec3 count;
};

Cells cellsOf(const Crystal& crystal, const Grid& grid, const PeriodicWindow& window) {
    const auto periods = periodsOf(grid);
    Cells cells{drawnBox(grid, window).corner, crystal.lattice, glm::ivec3(1)};
    if (glm::determinant(crystal.lattice) == 0.0) cells.edges = periods;
    if (areNear(glm::inverse(periods) * cells.edges, glm::dmat3(1.0)))
        for (int axis = 0; axis < 3; ++axis)
            if (grid.periodic[axis]) cells.count[axis] = window.replicate[axis];
    return cells;
}

} // namespace

CrystalSites crystalSites(const Crystal& crystal, const Grid& grid, const PeriodicWindow& window,
                          BondReach reach) {
    const double longest = 2.0 * largestRadius(crystal) + kBondTolerance;
    const ImageFinder finder(crystal, grid, window, reach == BondReach::Across ? longest : 0.0);
    std::vector<CrystalSite> sites;
    std::vector<CrystalSite> beyond;
    for (const Atom& atom : crystal.atoms) {
        finder.visitImages(atom.positionWorld, [&](const glm::dvec3& position, bool inBox) {
            if (inBox || reach == BondReach::Across)
                (inBox ? sites : beyond).push_back({atom.atomicNumber, position, inBox});
        });
        requireFewEnough(sites.size() + beyond.size());
    }
    sites.insert(sites.end(), beyond.begin(), beyond.end());
    if (reach == BondReach::None) return {std::move(sites), {}};
    return withoutStrays(sites, bondsBetween(sites, BondRule(crystal), longest));
}

std::vector<Segment> cellEdges(const Crystal& crystal, const Grid& grid, const PeriodicWindow& window) {
    const Cells cells = cellsOf(crystal, grid, window);
    std::vector<Segment> edges;
    for (int along = 0; along < 3; ++along) {
        glm::ivec3 last = cells.count;
        last[along] -= 1;
        for (int z = 0; z <= last.z; ++z)
            for (int y = 0; y <= last.y; ++y)
                for (int x = 0; x <= last.x; ++x) {
                    const glm::dvec3 start = cells.corner + cells.edges * glm::dvec3(x, y, z);
                    edges.push_back({start, start + cells.edges[along]});
                }
    }
    return edges;
}

std::vector<Segment> cellOutlines(const Crystal& crystal, const Grid& grid, const PeriodicWindow& window,
                                  const glm::dvec3& normal, double offset) {
    const Cells cells = cellsOf(crystal, grid, window);
    std::vector<Segment> outlines;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        const glm::dvec3 edgeU = cells.edges[u] * static_cast<double>(cells.count[u]);
        const glm::dvec3 edgeV = cells.edges[v] * static_cast<double>(cells.count[v]);
        for (int layer = 0; layer <= cells.count[axis]; ++layer) {
            const glm::dvec3 corner = cells.corner + cells.edges[axis] * static_cast<double>(layer);
            const std::array<glm::dvec3, 4> ring{corner, corner + edgeU, corner + edgeU + edgeV,
                                                 corner + edgeV};
            std::vector<glm::dvec3> crossings;
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const auto& from = ring[i];
                const auto& to = ring[(i + 1) % ring.size()];
                const double atFrom = glm::dot(normal, from) - offset;
                const double atTo = glm::dot(normal, to) - offset;
                if ((atFrom < 0.0) != (atTo < 0.0))
                    crossings.push_back(from + (to - from) * (atFrom / (atFrom - atTo)));
            }
            if (crossings.size() == 2) outlines.push_back({crossings[0], crossings[1]});
        }
    }
    return outlines;
}

} // namespace voxsheet
