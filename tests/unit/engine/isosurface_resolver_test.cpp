#include "engine/isosurface_resolver.h"

#include "base/errors.h"

#include <gtest/gtest.h>

#include <random>

namespace voxsheet::engine {
namespace {

TransferFunction greyOver(double low, double high) {
    TransferFunction function;
    function.colours = {{0.0, glm::dvec3(0.0)}, {1.0, glm::dvec3(1.0)}};
    function.opacities = {{0.0, 0.0}, {1.0, 1.0}};
    function.low = low;
    function.high = high;
    return function;
}

ValueSummary summaryOf(std::vector<float> values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const double min = static_cast<double>(*low);
    const double max = static_cast<double>(*high);
    return summariseValues(values, min, max);
}

/// Air at 0, a body at 100, some noise on both.
ValueSummary bodyInAir() {
    std::vector<float> values;
    std::mt19937 random(1);
    std::normal_distribution<float> noise(0.0F, 3.0F);
    for (int i = 0; i < 20000; ++i)
        values.push_back((i % 3 == 0 ? 100.0F : 0.0F) + noise(random));
    return summaryOf(values);
}

ValueSummary signedNoise() {
    std::vector<float> values;
    std::mt19937 random(2);
    std::normal_distribution<float> noise(0.0F, 1.0F);
    for (int i = 0; i < 20000; ++i)
        values.push_back(noise(random));
    return summaryOf(values);
}

std::vector<double> valuesOf(const std::vector<Isosurface>& surfaces) {
    std::vector<double> values;
    for (const Isosurface& surface : surfaces)
        values.push_back(surface.value);
    return values;
}

TEST(IsosurfaceResolver, TheDefaultValueLiesBetweenABodyAndTheAir) {
    const auto surfaces = resolveSurfaces({}, greyOver(0.0, 100.0), bodyInAir());
    ASSERT_EQ(surfaces.size(), 1U);
    EXPECT_GT(surfaces[0].value, 20.0);
    EXPECT_LT(surfaces[0].value, 80.0);
    EXPECT_EQ(surfaces[0].colour.w, 1.0F);
}

TEST(IsosurfaceResolver, TheTransferFunctionsColourIsMadeBrightEnoughForTheLight) {
    TransferFunction function = greyOver(0.0, 1.0);
    function.colours = {{0.0, {0.1, 0.2, 0.4}}, {0.5, {0.0, 0.0, 0.0}}, {1.0, {0.3, 1.0, 0.5}}};
    sheet::IsosurfaceStyle style;
    style.values = {0.0, 0.5, 1.0};
    const auto surfaces = resolveSurfaces(style, function, bodyInAir());
    const glm::vec3 dark(surfaces[0].colour);
    EXPECT_GT(dark.z, 0.8F);
    EXPECT_NEAR(dark.x / dark.z, 0.25F, 1e-6F) << "the same hue";
    EXPECT_NEAR(dark.y / dark.z, 0.5F, 1e-6F);
    EXPECT_GT(surfaces[1].colour.x, 0.8F) << "black has no hue: grey";
    EXPECT_EQ(glm::vec3(surfaces[2].colour), glm::vec3(0.3F, 1.0F, 0.5F)) << "bright as it is";
}

TEST(IsosurfaceResolver, SurfacesNearZeroOfADivergingMapAreNotPale) {
    TransferFunction function = greyOver(-4.0, 4.0);
    function.colours = {{0.0, {0.0, 0.0, 1.0}}, {0.5, {1.0, 1.0, 1.0}}, {1.0, {1.0, 0.0, 0.0}}};
    sheet::IsosurfaceStyle style;
    style.values = {0.4, -0.4, 2.0, 0.0, 9.0};
    const auto pale = resolveSurfaces(style, function, signedNoise());
    EXPECT_NEAR(pale[0].colour.y, 0.9F, 1e-6F) << "what the transfer function says";
    const auto surfaces = resolveSurfaces(style, function, signedNoise(), true);
    EXPECT_EQ(surfaces[0].colour.x, 1.0F);
    EXPECT_LT(surfaces[0].colour.y, 0.35F);
    EXPECT_EQ(surfaces[1].colour.z, 1.0F);
    EXPECT_NEAR(surfaces[1].colour.y, surfaces[0].colour.y, 1e-6F) << "as strong on the other side";
    EXPECT_LT(surfaces[2].colour.y, surfaces[0].colour.y) << "further out stays further out";
    EXPECT_EQ(glm::vec3(surfaces[3].colour), glm::vec3(1.0F)) << "0 itself is neutral";
    EXPECT_EQ(glm::vec3(surfaces[4].colour), glm::vec3(1.0F, 0.0F, 0.0F)) << "beyond the range: its end";
    style.colours = {*sheet::parseColour("#00ff00")};
    EXPECT_EQ(glm::vec3(resolveSurfaces(style, function, signedNoise(), true)[0].colour),
              glm::vec3(0.0F, 1.0F, 0.0F));
}

TEST(IsosurfaceResolver, SignedDataShowBothSignsAlike) {
    const ValueSummary summary = signedNoise();
    const auto values = valuesOf(resolveSurfaces({}, greyOver(-2.0, 3.0), summary));
    EXPECT_EQ(values, (std::vector<double>{0.75, -0.75}));
    const double window = defaultWindow(summary).high;
    EXPECT_EQ(valuesOf(resolveSurfaces({}, greyOver(1.0, 3.0), summary)),
              (std::vector<double>{0.25 * window, -0.25 * window}))
        << "the range holds one sign only";
    sheet::IsosurfaceStyle mirrored;
    mirrored.mirror = true;
    EXPECT_EQ(valuesOf(resolveSurfaces(mirrored, greyOver(-2.0, 3.0), summary)), values);
}

TEST(IsosurfaceResolver, LabelsOfTwoValuesAreSplitInTheMiddleAndConstantsStayEmpty) {
    std::vector<float> labels(1000, 0.0F);
    std::fill(labels.begin(), labels.begin() + 20, 1.0F);
    EXPECT_NEAR(defaultIsovalues(summaryOf(labels), {}).front(), 0.5, 0.05);
    const double value = defaultIsovalues(summaryOf(std::vector<float>(100, 7.0F)), {}).front();
    EXPECT_NE(value, 7.0);
    EXPECT_TRUE(std::isfinite(value));
    EXPECT_TRUE(std::isfinite(defaultIsovalues(ValueSummary{}, {}).front()));
}

TEST(IsosurfaceResolver, MirrorGivesEachValueItsNegativeOnce) {
    sheet::IsosurfaceStyle style;
    style.values = {2.0, -2.0, 0.0, 3.0};
    style.mirror = true;
    EXPECT_EQ(valuesOf(resolveSurfaces(style, greyOver(-3.0, 3.0), signedNoise())),
              (std::vector<double>{2.0, -2.0, 0.0, 3.0, -3.0}));
    style.mirror = false;
    style.values = {2.0, 2.0, 1.0};
    EXPECT_EQ(valuesOf(resolveSurfaces(style, greyOver(-3.0, 3.0), signedNoise())),
              (std::vector<double>{2.0, 1.0}));
}

TEST(IsosurfaceResolver, ColoursGoBySurfaceAndOpacitiesByValueAndTheLastRepeats) {
    sheet::IsosurfaceStyle style;
    style.values = {1.0, 2.0};
    style.mirror = true;
    style.colours = {sheet::Colour{{255, 0, 0, 255}}, sheet::Colour{{0, 0, 255, 255}}};
    style.opacities = {0.25, 1.0};
    const auto surfaces = resolveSurfaces(style, greyOver(-3.0, 3.0), signedNoise());
    ASSERT_EQ(surfaces.size(), 4U);
    EXPECT_EQ(surfaces[0].colour, glm::vec4(1.0F, 0.0F, 0.0F, 0.25F));
    EXPECT_EQ(surfaces[1].colour, glm::vec4(0.0F, 0.0F, 1.0F, 0.25F));
    EXPECT_EQ(surfaces[2].colour, glm::vec4(0.0F, 0.0F, 1.0F, 1.0F));
    EXPECT_EQ(surfaces[3].colour, glm::vec4(0.0F, 0.0F, 1.0F, 1.0F));
}

TEST(IsosurfaceResolver, MoreSurfacesThanAPictureShowsNameTheKeyAtFault) {
    sheet::IsosurfaceStyle style;
    style.values = {1, 2, 3, 4, 5};
    EXPECT_EQ(resolveSurfaces(style, greyOver(-3.0, 3.0), signedNoise()).size(), 5U);
    style.mirror = true;
    try {
        static_cast<void>(resolveSurfaces(style, greyOver(-3.0, 3.0), signedNoise()));
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.field(), "isosurface.mirror");
    }
}

TEST(IsosurfaceResolver, ValuesOutsideTheRangeAreKeptAsTheyAre) {
    sheet::IsosurfaceStyle style;
    style.values = {1e300};
    style.caps = true;
    style.method = sheet::IsosurfaceMethod::AlphaTest;
    const IsosurfaceSpec spec = resolveIsosurface(style, greyOver(0.0, 1.0), bodyInAir());
    EXPECT_EQ(spec.surfaces.at(0).value, 1e300);
    EXPECT_EQ(spec.surfaces.at(0).colour.x, 1.0F);
    EXPECT_TRUE(spec.caps);
    EXPECT_EQ(spec.method, IsosurfaceMethod::AlphaTest);
}

TEST(IsosurfaceResolver, OnlySurfacesThatAllLieOutsideTheDataAreWorthANote) {
    std::vector<float> values{0.0F, 5.0F, 10.0F};
    const ValueSummary data = summaryOf(values);
    const auto noteFor = [&](const std::vector<double>& isovalues) {
        std::vector<Isosurface> surfaces;
        for (const double value : isovalues)
            surfaces.push_back({value, {}});
        return emptySurfacesNote(surfaces, data);
    };
    EXPECT_EQ(noteFor({11.0}),
              "no surface is drawn: the data's values go from 0 to 10, and the isovalue is 11; "
              "set isovalue to a value between them");
    EXPECT_NE(noteFor({-1.0, 12.5}).find("the isovalues are -1, 12.5"), std::string::npos);
    EXPECT_EQ(noteFor({11.0, 5.0}), "");
    EXPECT_EQ(noteFor({10.0}), "") << "the ends are inside";
    EXPECT_EQ(noteFor({0.0}), "");
    EXPECT_EQ(noteFor({}), "");
    EXPECT_EQ(emptySurfacesNote({{11.0, {}}}, ValueSummary{}), "") << "there is no value at all";
}

} // namespace
} // namespace voxsheet::engine
