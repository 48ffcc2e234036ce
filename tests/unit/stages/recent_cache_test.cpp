#include "stages/recent_cache.h"
#include "volume/min_max_grid.h"

#include <gtest/gtest.h>

namespace voxsheet {
namespace {

bool holds(RecentCache<int, int>& cache, int key) {
    return cache.find([&](int other) { return other == key; }) != nullptr;
}

TEST(RecentCache, TheLeastRecentlyUsedGoesFirst) {
    RecentCache<int, int> cache(2);
    cache.insert(1, 10);
    cache.insert(2, 20);
    EXPECT_TRUE(holds(cache, 1));
    cache.insert(3, 30);
    EXPECT_FALSE(holds(cache, 2));
    EXPECT_TRUE(holds(cache, 1));
    EXPECT_TRUE(holds(cache, 3));
}

TEST(RecentCache, CostsStayWithinTheCapacityButForTheNewest) {
    RecentCache<int, int> cache(100);
    cache.insert(1, 10, 40);
    cache.insert(2, 20, 40);
    cache.insert(3, 30, 40);
    EXPECT_FALSE(holds(cache, 1));
    EXPECT_TRUE(holds(cache, 2));
    EXPECT_EQ(cache.insert(4, 70, 500), 70) << "larger than all of the cache";
    EXPECT_TRUE(holds(cache, 4));
    EXPECT_FALSE(holds(cache, 3));
    cache.insert(5, 50, 60);
    cache.insert(6, 60, 40);
    EXPECT_TRUE(holds(cache, 5)) << "what was thrown out no longer counts";
}

TEST(RecentCache, ASmallerCapacityHoldsFromTheNextInsertOn) {
    RecentCache<int, int> cache(100);
    for (int i = 0; i < 4; ++i)
        cache.insert(i, i, 20);
    cache.setCapacity(40);
    cache.insert(4, 4, 20);
    EXPECT_TRUE(holds(cache, 4));
    EXPECT_TRUE(holds(cache, 3));
    EXPECT_FALSE(holds(cache, 2));
    EXPECT_FALSE(holds(cache, 0));
}

TEST(ContentHash, TellsRangesAndShapesApartAndEqualGridsNot) {
    const MinMaxGrid grid{{2, 1, 1}, {{0.0F, 1.0F}, {2.0F, 3.0F}}};
    auto copy = grid;
    EXPECT_EQ(contentHash(copy), contentHash(grid));
    copy.bricks = {1, 2, 1};
    EXPECT_NE(contentHash(copy), contentHash(grid));
    copy = grid;
    copy.ranges[1].high = 3.5F;
    EXPECT_NE(contentHash(copy), contentHash(grid));
}

} // namespace
} // namespace voxsheet
