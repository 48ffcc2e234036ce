#include "engine/shading_resolver.h"

#include "engine/unit_vector.h"

namespace voxsheet::engine {

namespace {

bool isShaded(const sheet::TypedStyle& style) {
    if (style.technique == sheet::Technique::Mip || style.technique == sheet::Technique::Plane) return false;
    switch (style.shading.model) {
    case sheet::ShadingModel::None:
        return false;
    case sheet::ShadingModel::Phong:
        return true;
    case sheet::ShadingModel::Auto:
        break;
    }
    return style.technique == sheet::Technique::Isosurface;
}

GradientSource gradientSource(const sheet::TypedStyle& style) {
    switch (style.shading.gradient) {
    case sheet::GradientSource::Texture:
        return GradientSource::Texture;
    case sheet::GradientSource::OnTheFly:
        return GradientSource::OnTheFly;
    case sheet::GradientSource::Auto:
        break;
    }
    const bool everySample =
        style.technique == sheet::Technique::Raycast || style.technique == sheet::Technique::Slices;
    return everySample ? GradientSource::Texture : GradientSource::OnTheFly;
}

} // namespace

ShadingSpec resolveShading(const sheet::TypedStyle& style, const CameraSpec& camera) {
    ShadingSpec shading;
    shading.enabled = isShaded(style);
    shading.gradient = gradientSource(style);
    shading.ambient = style.shading.ambient;
    shading.diffuse = style.shading.diffuse;
    shading.specular = style.shading.specular;
    shading.shininess = style.shading.shininess;
    shading.headLight = style.light.head;
    shading.lightIntensity = style.light.intensity;
    const glm::dmat3 viewFromWorld(camera.viewFromWorld);
    for (const glm::dvec3& direction : style.light.directions) {
        const glm::dvec3 unit = unitVector(direction);
        const bool world = style.light.frame == sheet::LightFrame::World;
        shading.lightsView.push_back(world ? glm::normalize(viewFromWorld * unit) : unit);
    }
    return shading;
}

} // namespace voxsheet::engine
