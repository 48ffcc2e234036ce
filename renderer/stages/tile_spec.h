// What decides one cell's pixels, by value: no pointer into the program, so that it can be sent to another
// process.
#pragma once

#include "stages/crystal_spec.h"
#include "stages/isosurface_spec.h"
#include "stages/layer_spec.h"
#include "stages/plane_spec.h"
#include "stages/shading_spec.h"
#include "volume/clip.h"
#include "volume/periodic_window.h"
#include "volume/texture_encoding.h"
#include "volume/transfer_function.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

namespace voxsheet {

enum class Technique { Slices, Raycast, Mip, Surface, Isosurface, Plane };

/// As the style key `technique` names them: "raycast".
[[nodiscard]] inline const char* techniqueName(Technique technique) {
    switch (technique) {
    case Technique::Slices:
        return "slices";
    case Technique::Raycast:
        return "raycast";
    case Technique::Mip:
        return "mip";
    case Technique::Surface:
        return "surface";
    case Technique::Plane:
        return "plane";
    case Technique::Isosurface:
        break;
    }
    return "isosurface";
}

/// What the transfer function is asked for along a ray.
enum class Classification {
    AtSamples,     ///< entries at the samples
    PreIntegrated, ///< their mean between the values at the ends of each stretch (stages/preintegration.h)
};

enum class Projection { Perspective, Orthographic };

/// A camera in the world frame; it looks along -z of the view frame, x right, y up.
struct CameraSpec {
    glm::dmat4 viewFromWorld{1.0}; ///< rigid
    Projection projection = Projection::Perspective;
    double fovYDegrees = 30.0; ///< Perspective: full vertical angle, (0, 180)
    double heightWorld = 1.0;  ///< Orthographic: world height of the picture, > 0
};

/// One cell's picture.
struct TileSpec {
    std::string dataset; ///< DatasetMeta::key
    int field = 0;
    int step = 0;
    int level = 0; ///< level of detail to draw, 0 = full; must exist
    Technique technique = Technique::Raycast;
    CameraSpec camera;
    std::shared_ptr<const TransferTable> transfer; ///< never null; content, not identity, matters
    double unitLengthWorld = 1.0;                  ///< path length over which table opacities hold, > 0
    double sampleDistanceVoxels = 0.5; ///< distance of samples in voxels of the drawn level, (0, 64]
    Classification classification = Classification::AtSamples; ///< heeded where preIntegrates()
    bool adaptiveSampling = false; ///< fewer samples where little changes; heeded where adaptsSampling()
    glm::vec4 background{0.0F, 0.0F, 0.0F, 1.0F}; ///< sRGB, not premultiplied; alpha 0 = transparent
    glm::ivec2 sizePixels{256};                   ///< [1, 8192] each
    PeriodicWindow periodic;                      ///< of the cell's own volume only
    ClipSpec clip;                                ///< not for Plane
    ShadingSpec shading;                          ///< of volumes not for Mip and Plane
    IsosurfaceSpec isosurface;                    ///< Isosurface only
    LayersSpec layers;                            ///< Raycast and Plane only
    CrystalSpec crystal;                          ///< of the cell's own dataset
    std::optional<glm::dvec3> crosshairWorld;     ///< lines through it along the world's axes; not for Plane
    PlaneSpec plane;                              ///< Plane only, which needs an orthographic camera
    FloatTexels floatTexels = FloatTexels::Full;
    /// The values are numbers of categories: nothing lies between two of them, so every technique takes the
    /// nearest sample, and a plane is clear where the table is. Not for Mip and Isosurface, and never lit.
    bool categories = false;
};

/// True for pictures that rays march through volumes, and that the kernels of simd/ can draw. Not of
/// categories, whose samples shaders take; and atoms that a clip object cuts away are sought by shaders,
/// which read it as a texture.
[[nodiscard]] inline bool marchesRays(const TileSpec& tile) {
    const auto& layers = tile.layers.volumes;
    const bool ofCategories =
        std::any_of(layers.begin(), layers.end(), [](const auto& layer) { return layer.categories; });
    if (tile.categories || ofCategories || (!tile.crystal.empty() && tile.clip.object)) return false;
    return tile.technique != Technique::Surface && tile.technique != Technique::Plane;
}

/// True where whole stretches show the mean of the transfer function: ray casting of one volume that no
/// object clips.
[[nodiscard]] inline bool preIntegrates(const TileSpec& tile) {
    return tile.technique == Technique::Raycast && tile.classification == Classification::PreIntegrated &&
           tile.layers.volumes.empty() && !tile.clip.object && !tile.categories;
}

/// True where samples are farther apart in parts of the volume that change little (stages/sample_strides.h).
[[nodiscard]] inline bool adaptsSampling(const TileSpec& tile) {
    return tile.technique == Technique::Raycast && tile.adaptiveSampling && tile.layers.volumes.empty() &&
           !tile.categories && !preIntegrates(tile);
}

/// Lit ray casting of one volume, with samples half a voxel apart at most: two samples have one normal
/// (techniques/raycast/raycast.h).
[[nodiscard]] inline bool pairsShareLight(const TileSpec& tile) {
    return tile.technique == Technique::Raycast && tile.shading.enabled && tile.layers.volumes.empty() &&
           tile.sampleDistanceVoxels <= 0.5;
}

} // namespace voxsheet
