#include "base/errors.h"
#include "http/resource/stream_update.h"

#include <gtest/gtest.h>

using namespace voxsheet;
using namespace voxsheet::http;

namespace {

const sheet::KeyTable& keys() {
    static const auto table = sheet::makeKeyTable({"viridis", "grey"});
    return table;
}

stream::StreamUpdate parsed(const char* text) {
    return streamUpdateFromJson(nlohmann::json::parse(text), keys());
}

TEST(StreamUpdate, ReadsAckAndView) {
    const auto update = parsed(R"({"ack": 7, "view": {"id": 3, "moving": true, "focus": "B2",
        "tiles": [{"cell": "A1", "width": 320, "height": 240}],
        "style": {"camera.azimuth": 30}, "cells": {"B1": {"camera.roll": 5}}}})");
    EXPECT_EQ(update.ack, 7U);
    ASSERT_TRUE(update.view);
    EXPECT_EQ(update.view->id, 3U);
    EXPECT_TRUE(update.view->moving);
    ASSERT_EQ(update.view->tiles.size(), 1U);
    EXPECT_EQ(update.view->tiles[0].sizePixels, glm::ivec2(320, 240));
    EXPECT_EQ(update.view->focus, (sheet::Address{1, 1}));
    EXPECT_EQ(update.view->overrides.all.count("camera.azimuth"), 1U);
    EXPECT_EQ(update.view->overrides.cells.at(sheet::Address{1, 0}).count("camera.roll"), 1U);
}

TEST(StreamUpdate, EitherMayBeMissing) {
    EXPECT_FALSE(parsed(R"({"ack": 1})").view);
    EXPECT_FALSE(parsed(R"({"view": {"id": 1, "focus": null}})").ack);
    EXPECT_FALSE(parsed("{}").view);
}

TEST(StreamUpdate, RefusesWhatIsNotAView) {
    for (const auto* text :
         {R"({"ack": -1})", R"({"ack": 1.5})", R"({"view": []})", R"({"view": {}})",
          R"({"view": {"id": -1}})",
          R"({"view": {"id": 1, "tiles": [{"cell": "A1", "width": 0, "height": 1}]}})",
          R"({"view": {"id": 1, "tiles": [{"cell": "A1", "width": 99999, "height": 1}]}})",
          R"({"view": {"id": 1, "tiles": [{"cell": "1A", "width": 1, "height": 1}]}})",
          R"({"view": {"id": 1, "tiles": {}}})", R"({"view": {"id": 1, "style": {"camera.azimut": 1}}})",
          R"({"view": {"id": 1, "style": {"camera.fov": 1e9}}})",
          R"({"view": {"id": 1, "cells": {"??": {}}}})", R"({"other": 1})"})
        EXPECT_THROW(parsed(text), InvalidInput) << text;
}

TEST(StreamUpdate, WholeSheetSharesThePixels) {
    sheet::Sheet sheet;
    sheet.columns = 2;
    sheet.rows = 2;
    sheet.cells[{0, 0}].source = "a";
    sheet.cells[{1, 1}].source = "=A1*2";
    sheet.cells[{1, 0}].title = "only a title";
    const auto view = wholeSheetView(sheet, {800.0, 600.0});
    ASSERT_EQ(view.tiles.size(), 2U);
    EXPECT_EQ(view.tiles[0].sizePixels, glm::ivec2(400, 300));
}

} // namespace
