#include "engine/crystal_resolver.h"

#include "memory_dataset.h"

#include <gtest/gtest.h>

namespace voxsheet::engine {
namespace {

sheet::CrystalStyle everything() { return {true, true, sheet::BondReach::Across, 0.8}; }

DatasetMeta crystal(bool withAtoms) {
    DatasetMeta meta = test::metaOf("k", {8, 8, 8});
    meta.crystal = Crystal{};
    if (withAtoms) meta.crystal->atoms = {{6, glm::dvec3(1.0)}};
    return meta;
}

TEST(CrystalResolver, ACrystalShowsWhatTheStyleAsksFor) {
    EXPECT_EQ(resolveCrystal(everything(), crystal(true)), (CrystalSpec{true, true, BondReach::Across, 0.8}));
    EXPECT_EQ(missingCrystalNote(everything(), crystal(true)), "");
    const sheet::CrystalStyle bonds{false, false, sheet::BondReach::Inside, 0.5};
    EXPECT_EQ(resolveCrystal(bonds, crystal(true)), (CrystalSpec{false, false, BondReach::InBox, 0.5}));
    EXPECT_TRUE(resolveCrystal({}, crystal(true)).empty());
}

TEST(CrystalResolver, WhatIsNotThereIsNotDrawnAndSaidSo) {
    const DatasetMeta scan = test::metaOf("k", {8, 8, 8});
    EXPECT_EQ(resolveCrystal(everything(), scan), CrystalSpec{});
    EXPECT_EQ(missingCrystalNote(everything(), scan).find("no crystal is drawn: the data have no lattice"),
              0U);
    EXPECT_EQ(missingCrystalNote({}, scan), "");
    EXPECT_EQ(resolveCrystal(everything(), crystal(false)), (CrystalSpec{true, false, BondReach::None, 0.5}));
    EXPECT_EQ(missingCrystalNote(everything(), crystal(false)), "no atoms are drawn: the file lists none");
    sheet::CrystalStyle cell;
    cell.cell = true;
    EXPECT_EQ(missingCrystalNote(cell, crystal(false)), "");
    EXPECT_NE(missingCrystalNote(cell, scan), "");
}

} // namespace
} // namespace voxsheet::engine
