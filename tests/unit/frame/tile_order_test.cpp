#include "frame/tile_order.h"

#include "base/errors.h"

#include <gtest/gtest.h>

namespace voxsheet {
namespace {

constexpr auto kResident = TileReadiness::Resident;
constexpr auto kAtHand = TileReadiness::AtHand;
constexpr auto kOnDisk = TileReadiness::OnDisk;

/// The tiles in the order in which they are chosen.
std::vector<std::size_t> order(const std::vector<TileReadiness>& readiness) {
    std::vector<bool> issued(readiness.size());
    std::vector<std::size_t> tiles;
    std::optional<std::size_t> foretold;
    while (tiles.size() < readiness.size()) {
        const auto choice = chooseTile(issued, [&](std::size_t tile) { return readiness[tile]; });
        EXPECT_EQ(choice.tile, foretold.value_or(choice.tile));
        EXPECT_EQ(choice.after.has_value(), tiles.size() + 1 < readiness.size());
        foretold = choice.after;
        issued[choice.tile] = true;
        tiles.push_back(choice.tile);
    }
    return tiles;
}

TEST(TileOrder, WhatWaitsForLeastComesFirst) {
    EXPECT_EQ(order({kOnDisk, kAtHand, kResident, kOnDisk, kResident, kAtHand}),
              (std::vector<std::size_t>{2, 4, 1, 5, 0, 3}));
    EXPECT_EQ(order({kResident, kResident, kResident}), (std::vector<std::size_t>{0, 1, 2}));
    EXPECT_EQ(order({kOnDisk}), (std::vector<std::size_t>{0}));
}

TEST(TileOrder, LooksNoFurtherThanTwoThatWaitForNothing) {
    std::size_t asked = 0;
    const auto choice = chooseTile(std::vector<bool>(100), [&](std::size_t) {
        ++asked;
        return kResident;
    });
    EXPECT_EQ(choice.tile, 0U);
    EXPECT_EQ(choice.after, 1U);
    EXPECT_EQ(asked, 2U);
}

TEST(TileOrder, AFrameWithoutTilesIsAnError) {
    EXPECT_THROW((void)chooseTile({true, true}, [](std::size_t) { return kResident; }), InternalError);
}

} // namespace
} // namespace voxsheet
