#include "engine/crystal_resolver.h"

namespace voxsheet::engine {

namespace {

BondReach reachOf(sheet::BondReach reach) {
    switch (reach) {
    case sheet::BondReach::Inside:
        return BondReach::InBox;
    case sheet::BondReach::Across:
        return BondReach::Across;
    case sheet::BondReach::None:
        break;
    }
    return BondReach::None;
}

bool asksForAtoms(const sheet::CrystalStyle& style) {
    return style.atoms || style.bonds != sheet::BondReach::None;
}

} // namespace

CrystalSpec resolveCrystal(const sheet::CrystalStyle& style, const DatasetMeta& meta) {
    CrystalSpec spec;
    if (!meta.crystal) return spec;
    spec.cell = style.cell;
    if (!asksForAtoms(style) || meta.crystal->atoms.empty()) return spec;
    spec.atoms = style.atoms;
    spec.bonds = reachOf(style.bonds);
    spec.radiusScale = style.radius;
    return spec;
}

std::string missingCrystalNote(const sheet::CrystalStyle& style, const DatasetMeta& meta) {
    const bool atoms = asksForAtoms(style);
    if (!atoms && !style.cell) return {};
    if (!meta.crystal)
        return "no crystal is drawn: the data have no lattice and no atoms, which VASP, Gaussian cube and "
               "XSF "
               "files bring; switch crystal.atoms, crystal.bonds and crystal.cell off for this cell";
    if (atoms && meta.crystal->atoms.empty()) return "no atoms are drawn: the file lists none";
    return {};
}

} // namespace voxsheet::engine
