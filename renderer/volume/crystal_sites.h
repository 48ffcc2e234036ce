// Atoms and bonds of a crystal as a picture of it shows them: the periodic images that lie in the drawn box.
#pragma once

#include "volume/dataset.h"
#include "volume/periodic_window.h"

#include <cstddef>
#include <vector>

namespace voxsheet {

/// One image of an atom.
struct CrystalSite {
    int atomicNumber = 0;
    glm::dvec3 positionWorld{0.0};
    bool inBox = true; ///< false: only a bond to it makes it a part of the picture
};

/// Two sites, as indices.
struct CrystalBond {
    std::size_t first = 0;
    std::size_t second = 0;
};

enum class BondReach {
    None,   ///< no bonds
    InBox,  ///< between sites in the box
    Across, ///< also from there to images beyond the faces through which the box goes on
};

struct CrystalSites {
    std::vector<CrystalSite> sites; ///< those in the box first, in the order of the file
    std::vector<CrystalBond> bonds;
};

/// At most so many images in one picture.
inline constexpr std::size_t kMaxCrystalSites = 400'000;

/// Atoms move with the window's shift as the data do. On periodic axes all images are there that lie in the
/// drawn box, both of those that lie in two opposite faces (to 0.02 Å) included; on other axes atoms are
/// where the file has them, in the box or not. Where all axes are periodic and the box holds whole numbers of
/// the crystal's own lattice vectors, these decide what the images are, else the periods of the grid.
///
/// Two sites are bonded if they are farther apart than 0.4 Å and nearer than the sum of their covalent radii
/// and 0.45 Å (Meng & Lewis, J. Comput. Chem. 12, 1991; the values of Jmol and Open Babel). Two metals are
/// bonded only where the crystal has no other elements.
///
/// The crystal's world must be in Å. Throws LimitExceeded (field periodic.replicate) for more than
/// kMaxCrystalSites.
[[nodiscard]] CrystalSites crystalSites(const Crystal& crystal, const Grid& grid,
                                        const PeriodicWindow& window, BondReach reach);

struct Segment {
    glm::dvec3 start{0.0};
    glm::dvec3 end{0.0};
};

/// Edges of the unit cells in the drawn box, cell by cell, each once. They lie where the box lies, which the
/// shift does not move. A lattice that is not the period of the grid has one cell, at the box's low corner.
[[nodiscard]] std::vector<Segment> cellEdges(const Crystal& crystal, const Grid& grid,
                                             const PeriodicWindow& window);

/// Where a plane dot(normal, p) = offset cuts the faces of these cells.
[[nodiscard]] std::vector<Segment> cellOutlines(const Crystal& crystal, const Grid& grid,
                                                const PeriodicWindow& window, const glm::dvec3& normal,
                                                double offset);

} // namespace voxsheet
