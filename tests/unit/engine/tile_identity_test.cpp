#include "engine/tile_identity.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

namespace voxsheet::engine {
namespace {

TileSpec tile() {
    TileSpec spec;
    spec.dataset = "d";
    TransferTable table;
    table.entries = {glm::vec4(0.0F), glm::vec4(1.0F)};
    spec.transfer = std::make_shared<const TransferTable>(table);
    return spec;
}

TEST(TileIdentity, EqualSpecsHaveEqualIdentitiesWhateverTheirTables) {
    const TileSpec a = tile();
    const TileSpec b = tile();
    ASSERT_NE(a.transfer, b.transfer);
    EXPECT_EQ(tileIdentity(a, "device"), tileIdentity(b, "device"));
    EXPECT_EQ(tileIdentity(a, "device").size(), 32U);
}

TEST(TileIdentity, EveryNumberThatDecidesPixelsCounts) {
    const auto changedTable = [](const std::function<void(TransferTable&)>& change) {
        return [change](TileSpec& spec) {
            TransferTable table = *spec.transfer;
            change(table);
            spec.transfer = std::make_shared<const TransferTable>(table);
        };
    };
    const std::vector<std::function<void(TileSpec&)>> changes{
        [](TileSpec&) {},
        [](TileSpec& s) { s.dataset = "e"; },
        [](TileSpec& s) { s.field = 1; },
        [](TileSpec& s) { s.step = 1; },
        [](TileSpec& s) { s.level = 1; },
        [](TileSpec& s) { s.technique = Technique::Mip; },
        [](TileSpec& s) { s.camera.viewFromWorld[3][2] = -1e-9; },
        [](TileSpec& s) { s.camera.fovYDegrees = 31; },
        [](TileSpec& s) { s.camera.projection = Projection::Orthographic; },
        [](TileSpec& s) { s.unitLengthWorld = 2; },
        [](TileSpec& s) { s.sampleDistanceVoxels = 0.25; },
        [](TileSpec& s) { s.background.w = 0.5F; },
        [](TileSpec& s) { s.sizePixels.y = 255; },
        changedTable([](TransferTable& t) { t.low = -1; }),
        changedTable([](TransferTable& t) { t.high = 2; }),
        changedTable([](TransferTable& t) { t.scale = ValueScale::Log; }),
        changedTable([](TransferTable& t) { t.symLogThreshold = 0.5; }),
        changedTable([](TransferTable& t) { t.below.x = 0.1F; }),
        changedTable([](TransferTable& t) { t.above.x = 0.1F; }),
        changedTable([](TransferTable& t) { t.entries[1].w = 0.9F; }),
        changedTable([](TransferTable& t) { t.entries.push_back(glm::vec4(1.0F)); }),
    };
    std::set<std::string> identities;
    for (const auto& change : changes) {
        TileSpec spec = tile();
        change(spec);
        identities.insert(tileIdentity(spec, "device"));
    }
    identities.insert(tileIdentity(tile(), "another device"));
    EXPECT_EQ(identities.size(), changes.size() + 1);
}

TEST(TileIdentity, WhatTheProjectionDoesNotUseDoesNotCount) {
    TileSpec a = tile();
    TileSpec b = tile();
    b.camera.heightWorld = 5;
    EXPECT_EQ(tileIdentity(a, "d"), tileIdentity(b, "d"));
}

TEST(TileIdentity, TheBuildIsKnown) { EXPECT_EQ(buildIdentity().size(), 32U); }

} // namespace
} // namespace voxsheet::engine
