// Volumes blended with the drawn one (stages/layer_spec.h). Needs camera_rays.glsl; shading.glsl where they are lit.
//   LAYERS            how many: 0 to 3
//   LAYER_SCALE_i     as VALUE_SCALE of classification.glsl, of layer i
//   LAYER_FILTER_i    1: the shader interpolates its samples itself; 2: the nearest sample, of categories
//   SKIP_EMPTY        1: layerOccupied holds where they can show something
#include "stages/filtering.glsl"
#include "stages/value_scale.glsl"
#include "stages/empty_space.glsl"

#if LAYERS
layout(binding = 7) uniform sampler3D layerVolumes[LAYERS];
layout(binding = 10) uniform sampler1D layerTables[LAYERS];
layout(binding = 13) uniform usampler3D layerOccupied[LAYERS];

struct VolumeLayer {
    mat4 fromTexture; // texture frame of the drawn volume to that of the layer
    vec3 boxLow;
    vec3 boxHigh;
    vec3 voxels;            // texels of its level per axis
    vec3 periodic;          // 1 on axes that wrap
    vec2 mappedFromTexel;   // as in classification.glsl
    vec2 entryFromMapped;
    float lastEntry;
    float density;          // its extinction per unit of the drawn volume's opacity; its weight included; of planes its weight
    vec2 valueFromTexel;    // planes
    float threshold;        // planes: smaller values are absent
    mat3 viewFromGradient;  // as in shading.glsl
    float cellSamples;      // as in empty_space.glsl
    vec3 cellsPerTexture;
    ivec3 lastCell;
};
uniform VolumeLayer layers[LAYERS];
uniform float ownDensity; // weight of the drawn volume

float layerTexel(sampler3D samples, VolumeLayer layer, vec3 at, int filtering) {
    if (filtering == 2) return nearestTexel(samples, at, layer.periodic);
    return filtering == 1 ? filteredTexel(samples, at, layer.periodic) : textureLod(samples, at, 0.0).r;
}

#if SHADING
// Six taps, as gradientAt in shading.glsl.
vec3 layerGradient(sampler3D samples, VolumeLayer layer, vec3 at, int filtering) {
    vec3 voxel = 1.0 / layer.voxels;
    vec3 low = mix(max(at - voxel, 0.5 * voxel), at - voxel, layer.periodic);
    vec3 high = mix(min(at + voxel, 1.0 - 0.5 * voxel), at + voxel, layer.periodic);
    vec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
        vec3 before = at;
        vec3 after = at;
        before[axis] = low[axis];
        after[axis] = high[axis];
        float distance = (high[axis] - low[axis]) * layer.voxels[axis];
        gradient[axis] = distance > 0.0 ? (layerTexel(samples, layer, after, filtering) - layerTexel(samples, layer, before, filtering)) / distance : 0.0;
    }
    return gradient;
}
#endif

// What lights all volumes of a sample alike.
struct LayerLight {
    vec3 toEye;
    bool behindCut; // then all have the cut's normal
    vec3 cutNormal; // in the view frame
};

bool isOutside(VolumeLayer layer, vec3 at) { return any(lessThan(at, layer.boxLow)) || any(greaterThan(at, layer.boxHigh)); }

vec4 layerEntry(sampler1D table, VolumeLayer layer, float texel, int scale) {
    float mapped = scaledValue(scale, texel * layer.mappedFromTexel.x + layer.mappedFromTexel.y);
    return texelFetch(table, int(clamp(mapped * layer.entryFromMapped.x + layer.entryFromMapped.y, 0.0, layer.lastEntry)), 0);
}

// Adds what a layer shows at a point of the drawn volume to chromaticity and extinction there.
void blendLayer(inout vec4 entry, sampler3D samples, sampler1D table, VolumeLayer layer, vec3 position, LayerLight light, int scale, int filtering) {
    vec3 at = (layer.fromTexture * vec4(position, 1.0)).xyz;
    if (isOutside(layer, at)) return;
    float texel = layerTexel(samples, layer, at, filtering);
    if (isnan(texel)) return;
    vec4 more = layerEntry(table, layer, texel, scale);
    more.a *= layer.density;
    if (more.a <= 0.0) return;
#if SHADING
    more.rgb = lit(more.rgb, light.behindCut ? light.cutNormal : layer.viewFromGradient * layerGradient(samples, layer, at, filtering), light.toEye);
#endif
    entry.a += more.a;
    entry.rgb += (more.rgb - entry.rgb) * (more.a / entry.a);
}

// From the drawn volume's own entry to that of all volumes.
void blendLayers(inout vec4 entry, vec3 position, LayerLight light) {
    entry.a *= ownDensity;
    blendLayer(entry, layerVolumes[0], layerTables[0], layers[0], position, light, LAYER_SCALE_0, LAYER_FILTER_0);
#if LAYERS > 1
    blendLayer(entry, layerVolumes[1], layerTables[1], layers[1], position, light, LAYER_SCALE_1, LAYER_FILTER_1);
#endif
#if LAYERS > 2
    blendLayer(entry, layerVolumes[2], layerTables[2], layers[2], position, light, LAYER_SCALE_2, LAYER_FILTER_2);
#endif
}

// Over a premultiplied colour of a plane.
void paintLayer(inout vec4 colour, sampler3D samples, sampler1D table, VolumeLayer layer, vec3 position, int scale, int filtering) {
    vec3 at = (layer.fromTexture * vec4(position, 1.0)).xyz;
    if (isOutside(layer, at)) return;
    float texel = layerTexel(samples, layer, at, filtering);
    // False for NaN, too.
    if (!(texel * layer.valueFromTexel.x + layer.valueFromTexel.y >= layer.threshold)) return;
    vec4 more = layerEntry(table, layer, texel, scale);
    float alpha = layer.density * (1.0 - exp2(-more.a));
    colour = vec4(alpha * more.rgb, alpha) + (1.0 - alpha) * colour;
}

void paintLayers(inout vec4 colour, vec3 position) {
    paintLayer(colour, layerVolumes[0], layerTables[0], layers[0], position, LAYER_SCALE_0, LAYER_FILTER_0);
#if LAYERS > 1
    paintLayer(colour, layerVolumes[1], layerTables[1], layers[1], position, LAYER_SCALE_1, LAYER_FILTER_1);
#endif
#if LAYERS > 2
    paintLayer(colour, layerVolumes[2], layerTables[2], layers[2], position, LAYER_SCALE_2, LAYER_FILTER_2);
#endif
}

// As stretchesAhead: of a stretch that covers `stretch` of the drawn volume's texture frame, in one layer. A middle outside
// of it looks up its nearest cell: what of the stretch is inside lies within that one's reach.
int layerStretchesAhead(usampler3D occupied, VolumeLayer layer, vec3 middle, vec3 stretch) {
    vec3 at = (layer.fromTexture * vec4(middle, 1.0)).xyz;
    at -= layer.periodic * floor(at);
    // Far outside, and clamped first: a float beyond an int's range converts to anything.
    ivec3 cell = ivec3(clamp(at * layer.cellsPerTexture, vec3(0.0), vec3(layer.lastCell)));
    uint mark = texelFetch(occupied, cell, 0).r;
    float stretchVoxels = length(mat3(layer.fromTexture) * stretch * layer.voxels);
    return mark == 0u ? 0 : 1 + int(float(int(mark) - 1) * layer.cellSamples / stretchVoxels);
}

// The least over all layers.
int layersStretchesAhead(vec3 middle, vec3 stretch) {
    int ahead = layerStretchesAhead(layerOccupied[0], layers[0], middle, stretch);
#if LAYERS > 1
    if (ahead > 0) ahead = min(ahead, layerStretchesAhead(layerOccupied[1], layers[1], middle, stretch));
#endif
#if LAYERS > 2
    if (ahead > 0) ahead = min(ahead, layerStretchesAhead(layerOccupied[2], layers[2], middle, stretch));
#endif
    return ahead;
}
#endif
