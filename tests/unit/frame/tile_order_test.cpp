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
    while (tiles.size() < readiness.size()) {
        const auto choice = chooseTile(issued, [&](std::size_t tile) { return readiness[tile]; });
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

/// What the disk reads for while the tile that is chosen is drawn.
std::optional<std::size_t> ahead(const std::vector<TileReadiness>& readiness) {
    return chooseTile(std::vector<bool>(readiness.size()), [&](std::size_t tile) { return readiness[tile]; })
        .ahead;
}

TEST(TileOrder, TheDiskReadsForTheFirstThatNeedsItWhileOthersAreDrawn) {
    EXPECT_EQ(ahead({kAtHand, kOnDisk, kAtHand, kOnDisk}), 1U);
    EXPECT_EQ(ahead({kOnDisk, kResident, kOnDisk, kAtHand}), 0U);
    EXPECT_EQ(ahead({kOnDisk, kOnDisk}), 1U) << "the first is drawn";
    EXPECT_EQ(ahead({kOnDisk}), std::nullopt);
    EXPECT_EQ(ahead({kAtHand, kAtHand}), std::nullopt);
    EXPECT_EQ(ahead({kOnDisk, kResident, kResident}), std::nullopt) << "there is time yet";
}

TEST(TileOrder, LooksNoFurtherThanTwoThatWaitForNothing) {
    std::size_t asked = 0;
    const auto choice = chooseTile(std::vector<bool>(100), [&](std::size_t) {
        ++asked;
        return kResident;
    });
    EXPECT_EQ(choice.tile, 0U);
    EXPECT_FALSE(choice.ahead);
    EXPECT_EQ(asked, 2U);
}

TEST(TileOrder, AFrameWithoutTilesIsAnError) {
    EXPECT_THROW((void)chooseTile({true, true}, [](std::size_t) { return kResident; }), InternalError);
}

} // namespace
} // namespace voxsheet
