// One picture as the SIMD kernels draw it: the uniforms of the shaders of the same techniques, as plain
// numbers. Names and meanings are those of the .glsl files in stages/ and techniques/; matrices are columns
// first.
#pragma once

#include "simd/sampled_volume.h"

namespace voxsheet::simd {

struct RayNumbers {
    float pictureOfPixel[4];
    float origin[3], originX[3], originY[3];
    float direction[3], directionX[3], directionY[3];
    float nearest;
    float lengthPerspective;
    float boxLow[3], boxHigh[3];
};

constexpr int kMaxPlanes = 16;
constexpr int kMaxLightCount = 4;
constexpr int kMaxSurfaces = 8;

struct ClipNumbers {
    int planeCount = 0;
    float planes[kMaxPlanes][4];     ///< texture frame: dot(xyz, p) + w >= 0 is kept
    float cutNormals[kMaxPlanes][3]; ///< view frame
    bool hasObject = false;
    bool binary = false; ///< by the sign of the nearest sample
    SampledVolume distances;
    float objectSamples[3];
    float clipFromTexture[12]; ///< columns of three: axes and origin
    float objectFromTexture[9];
    float measureFromTexel[2];
    float nearestSampleSlack;
    float viewFromClipGradient[9];
    float keptLow[3], keptHigh[3];
};

struct LightNumbers {
    bool enabled = false;
    float material[4]; ///< ambient, diffuse, specular, shininess
    float headLight;
    int lightCount = 0;
    float lights[kMaxLightCount][4]; ///< unit directions in the view frame, intensity
    float viewFromGradient[9];
    bool betweenSamples = false; ///< gradients as a gradient texture holds them; else by six taps
};

struct SurfaceNumbers {
    int count = 0;
    float texels[kMaxSurfaces]; ///< rising
    float colours[kMaxSurfaces][4];
    bool caps = false;
    bool plainTest = false; ///< the alpha test of Khanduja & Karki
    float tolerance = 0.0F; ///< of the plain test
    float capTexels[2];
    float mirroredCapTexels[2];
    bool hasColours = false;
    SampledVolume colours3d;
    SampledTable colourTable;
    float colourFromTexture[12];
    float colourBoxLow[3], colourBoxHigh[3];
};

constexpr int kMaxLayerCount = 3;

/// A volume blended with the drawn one (stages/layers.glsl).
struct LayerNumbers {
    SampledVolume volume;
    SampledTable table;
    SampledCells cells;
    float fromTexture[12];
    float boxLow[3], boxHigh[3];
    float density;
    float viewFromGradient[9];
};

struct PictureJob {
    int width = 0;
    int height = 0;
    float* pixels = nullptr; ///< premultiplied rgba of the whole picture, row 0 at the bottom
    const float* solids =
        nullptr; ///< like `pixels`; a: depth of what hides all behind it (stages/solids.glsl)
    RayNumbers rays;
    ClipNumbers clip;
    SampledVolume volume;
    SampledTable table;
    SampledCells cells;
    float sampleDistanceVoxels = 0.5F; ///< slices: the longest way of a ray through a slab
    float slabDepth = 0.0F;            ///< slices
    int chunkSamples = 1;
    LightNumbers light;
    bool adaptive = false;        ///< ray casting: marks hold strides (stages/sample_strides.h)
    bool pairsShareLight = false; ///< ray casting: two samples, half a voxel apart at most, have one normal
    float unitsPerRadius = 1.0F;  ///< ray casting
    int layerCount = 0;           ///< ray casting
    LayerNumbers layers[kMaxLayerCount];
    float ownDensity = 1.0F; ///< where there are layers
    SurfaceNumbers surfaces; ///< isosurfaces
    float texelSign = 1.0F;  ///< maximum projection
    float opacityScale = 1.0F;
};

} // namespace voxsheet::simd
