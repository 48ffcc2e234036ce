#include "base/errors.h"
#include "engine/colour_map.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

namespace voxsheet::engine {
namespace {

TEST(ColourMap, TheEmbeddedSetHoldsTheWellKnownMaps) {
    const ColourMapTable& table = ColourMapTable::embedded();
    EXPECT_GE(table.maps().size(), 12U);
    for (const char* name :
         {"viridis", "plasma", "inferno", "magma", "cividis", "turbo", "grey", "cool-warm", "purple-orange",
          "red-blue", "ct-bone", "ct-muscle", "ct-soft-tissue", "ct-lung"}) {
        EXPECT_NE(table.find(name), nullptr) << name;
    }
    EXPECT_EQ(table.find("no such map"), nullptr);
    for (const ColourMap& map : table.maps())
        EXPECT_FALSE(map.source.empty()) << map.name;
}

TEST(ColourMap, KnownColoursStandWhereTheyShould) {
    const ColourMapTable& table = ColourMapTable::embedded();
    const ColourMap& viridis = *table.find("viridis");
    EXPECT_NEAR(viridis.stops.front().rgb.x, 68.0 / 255, 0.005);
    EXPECT_NEAR(viridis.stops.back().rgb.y, 231.0 / 255, 0.005);
    // Moreland 2009: cool-warm runs from (59, 76, 192) over (221, 221, 221) to (180, 4, 38).
    const ColourMap& coolWarm = *table.find("cool-warm");
    EXPECT_NEAR(coolWarm.stops.front().rgb.z, 192.0 / 255, 0.005);
    EXPECT_NEAR(coolWarm.stops[coolWarm.stops.size() / 2].rgb.x, 221.0 / 255, 0.005);
    EXPECT_NEAR(coolWarm.stops.back().rgb.x, 180.0 / 255, 0.005);
    EXPECT_EQ(coolWarm.kind, ColourMapKind::Diverging);
}

TEST(ColourMap, ACtMapIsAnchoredAtItsHounsfieldValues) {
    const ColourMap& bone = *ColourMapTable::embedded().find("ct-bone");
    const auto colours = coloursOverRange(bone, -1000, 1000, true);
    EXPECT_EQ(colours.front().position, 0.0);
    EXPECT_EQ(colours.back().position, 1.0);
    bool found = false;
    for (const ColourPoint& stop : colours) {
        if (std::abs(stop.position - (641.385 + 1000) / 2000) < 1e-9) found = stop.rgb.x > 0.9;
    }
    EXPECT_TRUE(found) << "bone's cream colour belongs at 641 HU";
    const auto opacities = opacitiesOverRange(bone, -1000, 1000, true);
    EXPECT_EQ(opacities.front().opacity, 0.0);
    EXPECT_GT(opacities.back().opacity, 0.6);
}

TEST(ColourMap, WindowAndLevelStretchACtMap) {
    const ColourMap& bone = *ColourMapTable::embedded().find("ct-bone");
    const auto stretched = coloursOverRange(bone, 0, 10, false);
    const auto window = coloursOverRange(bone, bone.window.first, bone.window.second, true);
    ASSERT_EQ(stretched.size(), window.size());
    for (std::size_t i = 0; i < window.size(); ++i)
        EXPECT_EQ(stretched[i].position, window[i].position);
}

TEST(ColourMap, BadDocumentsAreRefusedWithTheField) {
    const auto fieldOf = [](const char* text) {
        try {
            static_cast<void>(ColourMapTable::fromJson(text));
        } catch (const InvalidInput& error) {
            return error.field();
        }
        return std::string("accepted");
    };
    EXPECT_EQ(fieldOf("not json"), "maps");
    EXPECT_EQ(fieldOf(R"({"maps": []})"), "maps");
    EXPECT_EQ(fieldOf(R"({"maps": [{"name": "a"}]})"), "label");
    const char* head = R"({"maps": [{"name": "a", "label": "A", "source": "s", "kind": )";
    EXPECT_EQ(fieldOf((std::string(head) + R"("odd", "stops": [[0,0,0,0],[1,1,1,1]]}]})").c_str()), "kind");
    EXPECT_EQ(fieldOf((std::string(head) + R"("sequential", "stops": [[0,0,0,0]]}]})").c_str()), "stops");
    EXPECT_EQ(fieldOf((std::string(head) + R"("sequential", "stops": [[0,0,0,0],[0.9,1,1,1]]}]})").c_str()),
              "stops");
    EXPECT_EQ(fieldOf((std::string(head) + R"("sequential", "stops": [[0,0,0,0],[1,1,2,1]]}]})").c_str()),
              "stops");
    EXPECT_EQ(
        fieldOf((std::string(head) + R"("ct", "stops": [[0,0,0,0],[1,1,1,1]], "opacity": [[0,0],[1,1]]}]})")
                    .c_str()),
        "window");
}

TEST(ColourMap, TheDescriptionCarriesEveryMapOverZeroToOne) {
    const auto description = describeColourMaps(ColourMapTable::embedded());
    std::set<std::string> names;
    for (const auto& map : description["maps"]) {
        names.insert(map["name"]);
        EXPECT_EQ(map["stops"].front()[0], 0.0) << map["name"];
        EXPECT_EQ(map["stops"].back()[0], 1.0) << map["name"];
    }
    EXPECT_EQ(names.size(), ColourMapTable::embedded().maps().size());
}

} // namespace
} // namespace voxsheet::engine
