#include "engine/shading_resolver.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

namespace voxsheet::engine {
namespace {

CameraSpec fromTheRight() {
    CameraSpec camera; // The eye looks along -x of the world, z up.
    camera.viewFromWorld = glm::lookAt(glm::dvec3(5.0, 0.0, 0.0), glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1.0));
    return camera;
}

TEST(ShadingResolver, OnlyIsosurfacesAreShadedUnlessAskedAndProjectionsAndPlanesNever) {
    for (const auto technique :
         {sheet::Technique::Slices, sheet::Technique::Raycast, sheet::Technique::Mip,
          sheet::Technique::Surface, sheet::Technique::Isosurface, sheet::Technique::Plane}) {
        sheet::TypedStyle style;
        style.technique = technique;
        EXPECT_EQ(resolveShading(style, {}).enabled, technique == sheet::Technique::Isosurface);
        style.shading.model = sheet::ShadingModel::Phong;
        EXPECT_EQ(resolveShading(style, {}).enabled,
                  technique != sheet::Technique::Mip && technique != sheet::Technique::Plane);
        style.shading.model = sheet::ShadingModel::None;
        EXPECT_FALSE(resolveShading(style, {}).enabled);
    }
}

TEST(ShadingResolver, GradientsComeFromATextureWhereEverySampleIsShaded) {
    sheet::TypedStyle style;
    style.technique = sheet::Technique::Raycast;
    EXPECT_EQ(resolveShading(style, {}).gradient, GradientSource::Texture);
    style.technique = sheet::Technique::Isosurface;
    EXPECT_EQ(resolveShading(style, {}).gradient, GradientSource::OnTheFly);
    style.shading.gradient = sheet::GradientSource::Texture;
    EXPECT_EQ(resolveShading(style, {}).gradient, GradientSource::Texture);
    style.technique = sheet::Technique::Slices;
    style.shading.gradient = sheet::GradientSource::OnTheFly;
    EXPECT_EQ(resolveShading(style, {}).gradient, GradientSource::OnTheFly);
}

TEST(ShadingResolver, LightsOfTheWorldTurnWithTheCameraAndThoseOfTheViewDoNot) {
    sheet::TypedStyle style;
    style.light.directions = {{0.0, 0.0, 1e-200}, {1e200, 0.0, 0.0}};
    const auto view = resolveShading(style, fromTheRight()).lightsView;
    ASSERT_EQ(view.size(), 2U);
    EXPECT_EQ(view[0], glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_EQ(view[1], glm::dvec3(1.0, 0.0, 0.0));
    style.light.frame = sheet::LightFrame::World;
    const auto world = resolveShading(style, fromTheRight()).lightsView;
    // World z is up in the picture; world x comes towards the eye.
    EXPECT_NEAR(glm::distance(world[0], {0.0, 1.0, 0.0}), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(world[1], {0.0, 0.0, 1.0}), 0.0, 1e-12);
}

TEST(ShadingResolver, TheNumbersAreTheStyles) {
    sheet::TypedStyle style;
    style.shading.ambient = 0.1;
    style.shading.diffuse = 0.2;
    style.shading.specular = 0.3;
    style.shading.shininess = 40.0;
    style.light.head = 0.5;
    style.light.intensity = 0.6;
    const ShadingSpec shading = resolveShading(style, {});
    EXPECT_EQ(shading.ambient, 0.1);
    EXPECT_EQ(shading.diffuse, 0.2);
    EXPECT_EQ(shading.specular, 0.3);
    EXPECT_EQ(shading.shininess, 40.0);
    EXPECT_EQ(shading.headLight, 0.5);
    EXPECT_EQ(shading.lightIntensity, 0.6);
}

} // namespace
} // namespace voxsheet::engine
