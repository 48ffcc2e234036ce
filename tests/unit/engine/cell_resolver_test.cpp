#include "base/errors.h"
#include "engine/cell_resolver.h"
#include "memory_dataset.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <random>

namespace voxsheet::engine {
namespace {

class CellResolver : public testing::Test {
protected:
    CellResolver() : keys(table()) {
        std::vector<float> positive;
        std::vector<float> signedValues;
        std::mt19937 random(5);
        std::normal_distribution<float> noise(0.0F, 2.0F);
        for (int i = 0; i < 5000; ++i) {
            positive.push_back(static_cast<float>(i % 256));
            signedValues.push_back(noise(random));
        }
        density = summariseValues(positive, 0, 255);
        difference = summariseValues(signedValues, -9, 8);
        ct = summariseValues(positive, -1000, 2000);
        meta = test::metaOf("k", {64, 64, 32});
    }

    static sheet::KeyTable table() {
        auto names = ColourMapTable::embedded().names();
        names.insert(names.begin(), "auto");
        return sheet::makeKeyTable(names);
    }

    sheet::ResolvedStyle style(const nlohmann::json& values = nlohmann::json::object()) {
        sheet::Sheet sheet;
        sheet.style = sheet::parseStyleMap(keys, values);
        return sheet::resolveStyle(keys, sheet, {0, 0});
    }

    ResolvedTransfer resolve(const nlohmann::json& values, const ValueSummary& summary) {
        return resolveTransfer(style(values), ColourMapTable::embedded(), summary, 64);
    }

    sheet::KeyTable keys;
    ValueSummary density;
    ValueSummary difference;
    ValueSummary ct;
    DatasetMeta meta;
};

TEST_F(CellResolver, PositiveDataOpenInViridisOverTheirRange) {
    const ResolvedTransfer transfer = resolve(nlohmann::json::object(), density);
    EXPECT_EQ(transfer.map->name, "viridis");
    EXPECT_FALSE(transfer.diverging);
    EXPECT_EQ(transfer.function.low, 0);
    EXPECT_EQ(transfer.function.high, 255);
    EXPECT_NO_THROW(static_cast<void>(buildTransferTable(transfer.function)));
}

TEST_F(CellResolver, SignedDataOpenDivergingAndTransparentAtZero) {
    const ResolvedTransfer transfer = resolve(nlohmann::json::object(), difference);
    EXPECT_EQ(transfer.map->name, "cool-warm");
    EXPECT_EQ(transfer.function.low, -transfer.function.high);
    EXPECT_EQ(evaluateTransfer(transfer.function, 0.0).w, 0.0);
    EXPECT_GT(evaluateTransfer(transfer.function, 6.0).w, 0.0);
    EXPECT_GT(evaluateTransfer(transfer.function, -6.0).w, 0.0);
}

TEST_F(CellResolver, EveryRangeModeGivesItsOwnRange) {
    EXPECT_EQ(resolve({{"range.mode", "own"}}, difference).function.low, -9);
    EXPECT_EQ(resolve({{"range.mode", "own"}}, difference).function.high, 8);
    EXPECT_EQ(resolve({{"range.mode", "symmetric"}}, difference).function.high, 9);
    const auto fixed = resolve({{"range.mode", "fixed"}, {"range.min", 10}, {"range.max", 20}}, density);
    EXPECT_EQ(fixed.function.low, 10);
    EXPECT_EQ(fixed.function.high, 20);
    EXPECT_EQ(resolve({{"range.mode", "fixed"}, {"range.min", 10}}, density).function.high, 255);
    const auto percent =
        resolve({{"range.mode", "percentile"}, {"range.min", 10}, {"range.max", 90}}, density);
    EXPECT_NEAR(percent.function.low, 25.5, 2);
    EXPECT_NEAR(percent.function.high, 229.5, 2);
}

TEST_F(CellResolver, AnyRangeThatDataGiveCanBeMadeSymmetric) {
    for (const char* mode : {"auto", "own", "shared", "percentile"}) {
        const auto transfer = resolve({{"range.mode", mode}, {"range.symmetric", "on"}}, density);
        EXPECT_GT(transfer.function.high, 200.0) << mode;
        EXPECT_EQ(transfer.function.low, -transfer.function.high) << mode;
        EXPECT_EQ(transfer.map->name, "cool-warm") << mode;
        EXPECT_EQ(evaluateTransfer(transfer.function, 0.0).w, 0.0) << mode;
    }
    // What was typed in stays.
    const auto fixed = resolve(
        {{"range.mode", "fixed"}, {"range.min", -1}, {"range.max", 3}, {"range.symmetric", "on"}}, density);
    EXPECT_EQ(fixed.function.low, -1);
    EXPECT_EQ(fixed.function.high, 3);
}

TEST_F(CellResolver, AnEmptyFixedRangeNamesTheKeyAtFault) {
    try {
        static_cast<void>(resolve({{"range.mode", "fixed"}, {"range.min", 300}}, density));
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.field(), "range.min");
    }
}

TEST_F(CellResolver, EveryScaleHasFiniteOpacities) {
    for (const char* scale : {"linear", "log", "symlog"}) {
        for (const ValueSummary* summary : {&density, &difference, &ct}) {
            const auto transfer = resolve({{"range.scale", scale}}, *summary);
            for (const OpacityPoint& point : transfer.function.opacities) {
                EXPECT_TRUE(point.position >= 0 && point.position <= 1) << scale;
                EXPECT_TRUE(point.opacity >= 0 && point.opacity <= 1) << scale;
            }
            EXPECT_NO_THROW(static_cast<void>(buildTransferTable(transfer.function))) << scale;
        }
    }
    EXPECT_THROW(static_cast<void>(resolve(
                     {{"range.scale", "log"}, {"range.mode", "fixed"}, {"range.min", -5}, {"range.max", -1}},
                     difference)),
                 InvalidInput);
}

TEST_F(CellResolver, TheNeutralColourOfADivergingMapFollowsZero) {
    const auto transfer =
        resolve({{"transfer.map", "cool-warm"}, {"range.mode", "fixed"}, {"range.min", -1}, {"range.max", 3}},
                difference);
    const glm::dvec4 zero = evaluateTransfer(transfer.function, 0.0);
    EXPECT_NEAR(zero.x, 221.0 / 255, 0.01);
    EXPECT_NEAR(zero.z, 221.0 / 255, 0.01);
}

TEST_F(CellResolver, ACtMapBringsItsWindowAndOpacity) {
    const auto transfer = resolve({{"transfer.map", "ct-bone"}}, ct);
    const ColourMap& bone = *ColourMapTable::embedded().find("ct-bone");
    EXPECT_EQ(transfer.function.low, bone.window.first);
    EXPECT_EQ(evaluateTransfer(transfer.function, -100).w, 0.0);
    EXPECT_NEAR(evaluateTransfer(transfer.function, 641.385).w, 0.7157, 0.01);
}

TEST_F(CellResolver, OwnOpacityAndPointsWin) {
    const auto transfer = resolve({{"transfer.opacity", {{0.0, 0.5}, {1.0, 0.5}}},
                                   {"transfer.points", {{0.0, "#ff0000"}, {1.0, "#ff0000"}}}},
                                  density);
    const glm::dvec4 colour = evaluateTransfer(transfer.function, 100);
    EXPECT_NEAR(colour.x, 1.0, 1e-9);
    EXPECT_NEAR(colour.y, 0.0, 1e-9);
    EXPECT_NEAR(colour.w, 0.5, 1e-9);
}

TEST_F(CellResolver, TheStepIsHeldAtTheLastAndAMissingFieldIsNamed) {
    EXPECT_EQ(chooseField(std::int64_t{0}, 99, meta).step, 0);
    EXPECT_EQ(chooseField(std::string("density"), 0, meta).field, 0);
    try {
        static_cast<void>(chooseField(std::string("velocity"), 0, meta));
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.field(), "field");
        EXPECT_NE(std::string(error.what()).find("density"), std::string::npos) << error.what();
    }
    EXPECT_THROW(static_cast<void>(chooseField(std::int64_t{1}, 0, meta)), InvalidInput);
}

TEST_F(CellResolver, TheWholeVolumeIsInThePictureFromEverySideAndInEveryShape) {
    for (const glm::ivec2 size : {glm::ivec2(400, 200), glm::ivec2(200, 400), glm::ivec2(300, 300)}) {
        for (const char* projection : {"perspective", "orthographic"}) {
            for (int azimuth = 0; azimuth < 360; azimuth += 45) {
                const auto resolved = style(
                    {{"camera.projection", projection}, {"camera.azimuth", static_cast<double>(azimuth)}});
                const CameraSpec camera = resolveCamera(resolved.style.camera, ownFrame(meta.grid), size);
                const IndexBox box = boxIndex(meta.grid);
                for (int corner = 0; corner < 8; ++corner) {
                    const glm::dvec3 index((corner & 1) ? box.high.x : box.low.x,
                                           (corner & 2) ? box.high.y : box.low.y,
                                           (corner & 4) ? box.high.z : box.low.z);
                    const glm::dvec4 view =
                        camera.viewFromWorld * (meta.grid.worldFromIndex * glm::dvec4(index, 1.0));
                    ASSERT_LT(view.z, 0.0);
                    const double half = camera.projection == Projection::Perspective
                                            ? -view.z * std::tan(glm::radians(camera.fovYDegrees) / 2)
                                            : camera.heightWorld / 2;
                    EXPECT_LE(std::abs(view.y), half) << projection << azimuth;
                    EXPECT_LE(std::abs(view.x), half * size.x / size.y) << projection << azimuth;
                }
            }
        }
    }
}

TEST_F(CellResolver, LevelAndQualityTakeTheCoarserWithinWhatThereIs) {
    const auto table = buildTransferTable(resolve(nlohmann::json::object(), density).function);
    const auto tile = [&](const nlohmann::json& values, int level) {
        return resolveTile(style(values).style, meta, {0, 0}, table, {64, 64}, level, 2.0);
    };
    EXPECT_EQ(tile(nlohmann::json::object(), 0).level, 0);
    EXPECT_EQ(tile({{"quality", "half"}}, 0).level, 1);
    EXPECT_EQ(tile({{"quality", "half"}}, 2).level, 2);
    EXPECT_EQ(tile(nlohmann::json::object(), 99).level, meta.levels() - 1);
    EXPECT_EQ(tile({{"sampling.distance", 0.5}}, 0).sampleDistanceVoxels, 1.0);
    EXPECT_NEAR(tile(nlohmann::json::object(), 0).unitLengthWorld, 1.0, 1e-12);
    EXPECT_EQ(tile({{"background", "transparent"}}, 0).background.w, 0.0F);
    EXPECT_EQ(tile({{"sampling.transfer", "samples"}}, 0).classification, Classification::AtSamples);
    EXPECT_EQ(tile({{"sampling.transfer", "mean"}}, 0).classification, Classification::PreIntegrated);
    EXPECT_TRUE(tile(nlohmann::json::object(), 0).adaptiveSampling);
    EXPECT_FALSE(tile({{"sampling.adaptive", "off"}}, 0).adaptiveSampling);
}

TEST_F(CellResolver, PeriodsMoveCameraAndClipsWithTheBoxAndTheShiftMovesNeither) {
    const auto table = buildTransferTable(resolve(nlohmann::json::object(), density).function);
    meta.grid.periodic = glm::bvec3(true, true, false);
    const auto tile = [&](nlohmann::json values, const DatasetMeta& of) {
        values["clip.planes"] = {{1, 0, 0, 0.5}};
        return resolveTile(style(values).style, of, {0, 0}, table, {64, 64}, 0, 1.0);
    };
    DatasetMeta written = meta;
    written.grid.dims = {128, 64, 32};
    const auto expected = tile(nlohmann::json::object(), written);
    const auto twice = tile({{"periodic.replicate", {2, 1, 1}}, {"periodic.shift", {0.25, -0.25, 0}}}, meta);
    EXPECT_EQ(twice.periodic, (PeriodicWindow{{0.25, 0.75, 0.0}, {2, 1, 1}}));
    EXPECT_EQ(twice.camera.viewFromWorld, expected.camera.viewFromWorld);
    EXPECT_EQ(twice.clip, expected.clip);
    EXPECT_EQ(twice.level, tile(nlohmann::json::object(), meta).level);
    const nlohmann::json flat = {
        {"technique", "plane"}, {"plane.axis", "sagittal"}, {"plane.position", 0.75}};
    auto flatTwice = flat;
    flatTwice["periodic.replicate"] = {2, 1, 1};
    EXPECT_EQ(tile(flatTwice, meta).plane.offset, tile(flat, written).plane.offset);
    EXPECT_EQ(tile(flatTwice, meta).camera.viewFromWorld, tile(flat, written).camera.viewFromWorld);
    EXPECT_EQ(tile(flatTwice, meta).camera.heightWorld, tile(flat, written).camera.heightWorld);
    const auto refused = [&](const char* key, const nlohmann::json& value) {
        try {
            (void)tile({{key, value}}, meta);
        } catch (const InvalidInput& error) {
            EXPECT_NE(std::string(error.what()).find("axis z of the volume is not periodic"),
                      std::string::npos)
                << error.what();
            return error.field();
        }
        return std::string();
    };
    EXPECT_EQ(refused("periodic.shift", {0, 0, 0.5}), "periodic.shift");
    EXPECT_EQ(refused("periodic.replicate", {1, 1, 2}), "periodic.replicate");
}

TEST_F(CellResolver, LinkedPeriodsApplyOnlyWhereTheDataArePeriodic) {
    const auto asked = [&](sheet::LayerKind kind) {
        auto resolved = style({{"periodic.shift", {0.5, 0.5, 0.5}}, {"periodic.replicate", {2, 1, 3}}});
        for (const char* key : {"periodic.shift", "periodic.replicate"})
            resolved.values.at(key).origin = {kind, 0, 0};
        return resolved;
    };
    Grid slab = meta.grid;
    slab.periodic = glm::bvec3(true, true, false);
    for (const auto kind : {sheet::LayerKind::Sheet, sheet::LayerKind::Column, sheet::LayerKind::Row,
                            sheet::LayerKind::PageView}) {
        auto linked = asked(kind);
        EXPECT_NE(dropLinkedPeriods(linked, slab).find("periodic axes of these data only"),
                  std::string::npos);
        EXPECT_EQ(linked.style.periodic.shift, glm::dvec3(0.5, 0.5, 0));
        EXPECT_EQ(linked.style.periodic.replicate, glm::dvec3(2, 1, 1));
        EXPECT_NO_THROW((void)resolvePeriodicWindow(linked.style.periodic, slab));
        auto none = asked(kind);
        EXPECT_NE(dropLinkedPeriods(none, meta.grid).find("not periodic"), std::string::npos);
        EXPECT_EQ(none.style.periodic.shift, glm::dvec3(0.0));
        auto full = asked(kind);
        Grid crystal = meta.grid;
        crystal.periodic = glm::bvec3(true);
        EXPECT_EQ(dropLinkedPeriods(full, crystal), "");
        EXPECT_EQ(full.style.periodic.replicate, glm::dvec3(2, 1, 3));
    }
    for (const auto kind : {sheet::LayerKind::Cell, sheet::LayerKind::PageCell, sheet::LayerKind::Request}) {
        auto own = asked(kind);
        EXPECT_EQ(dropLinkedPeriods(own, slab), "");
        EXPECT_THROW((void)resolvePeriodicWindow(own.style.periodic, slab), InvalidInput);
    }
}

TEST_F(CellResolver, SharedCellsSpanAllOfThem) {
    std::vector<float> high{1000, 1001, 1002, 1003, 1004, 1005, 1006, 1007};
    const ValueSummary merged = mergeSummaries({density, summariseValues(high, 1000, 1007)});
    EXPECT_EQ(merged.min, 0);
    EXPECT_EQ(merged.max, 1007);
    const auto shared = resolve({{"range.mode", "shared"}}, merged);
    EXPECT_LE(shared.function.low, 1);
    EXPECT_GE(shared.function.high, 1000);
}

} // namespace
} // namespace voxsheet::engine
