// What of a crystal stands in the picture of its volume, as opaque solids.
#pragma once

#include "volume/crystal_sites.h"

namespace voxsheet {

/// Of the cell's own dataset; one that has no atoms shows none. Radii are those of the elements times
/// radiusScale, of bonds kBondRadius times twice radiusScale; edges of cells are as thin as the picture
/// shows well.
struct CrystalSpec {
    bool cell = false;  ///< edges of the unit cells; with Technique::Plane their outlines in the plane
    bool atoms = false; ///< spheres; without them bonds are sticks with round ends
    BondReach bonds = BondReach::None;
    double radiusScale = 0.5; ///< (0, 4]

    /// Nothing is shown.
    [[nodiscard]] bool empty() const { return !cell && !atoms && bonds == BondReach::None; }
    bool operator==(const CrystalSpec&) const = default;
};

inline constexpr double kBondRadius = 0.12; ///< Å, at a radiusScale of 0.5

/// Throws InvalidInput (field crystal.radius) if the scale is out of its range.
void validateCrystal(const CrystalSpec& crystal);

} // namespace voxsheet
