#include "stages/table_key.h"

#include <gtest/gtest.h>

namespace voxsheet {
namespace {

std::shared_ptr<TransferTable> someTable() {
    auto table = std::make_shared<TransferTable>();
    table->entries = {glm::vec4(0.0F), glm::vec4(1.0F, 0.5F, 0.25F, 0.1F)};
    return table;
}

TEST(TableKey, TellsEqualTablesFromOthers) {
    const TableKey key(someTable());
    EXPECT_EQ(TableKey(someTable()).hash(), key.hash());
    const auto change = [&](auto set) {
        const auto table = someTable();
        set(*table);
        return TableKey(table).hash();
    };
    EXPECT_NE(change([](TransferTable& table) { table.entries[1].w = 0.2F; }), key.hash());
    EXPECT_NE(change([](TransferTable& table) { table.entries.pop_back(); }), key.hash());
    EXPECT_NE(change([](TransferTable& table) { table.low = -1.0; }), key.hash());
    EXPECT_NE(change([](TransferTable& table) { table.high = 2.0; }), key.hash());
    EXPECT_NE(change([](TransferTable& table) { table.scale = ValueScale::Log; }), key.hash());
    EXPECT_NE(change([](TransferTable& table) { table.symLogThreshold = 0.5; }), key.hash());
    EXPECT_NE(change([](TransferTable& table) { table.below.x = 1.0F; }), key.hash());
    EXPECT_NE(change([](TransferTable& table) { table.above.x = 1.0F; }), key.hash());
    EXPECT_NE(change([](TransferTable& table) { table.nan.x = 1.0F; }), key.hash());
}

TEST(TableKey, KnowsItsOwnTableWhileThatLives) {
    auto table = someTable();
    const TableKey key(table);
    EXPECT_TRUE(key.isSame(table));
    EXPECT_FALSE(key.isSame(someTable()));
    const std::weak_ptr<const TransferTable> watched = table;
    table.reset();
    EXPECT_TRUE(watched.expired()) << "keys keep no table alive";
    EXPECT_FALSE(key.isSame(someTable()));
    EXPECT_FALSE(TableKey().isSame(nullptr));
}

} // namespace
} // namespace voxsheet
