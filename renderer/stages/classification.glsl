// From a texel of the volume to colour and opacity, through a float table (stages/classification.h).
//   VALUE_SCALE   0 linear, 1 logarithmic, 2 linear about 0 and logarithmic beyond
//   MAY_BE_NAN    1 when the volume can hold NaN
//   COARSE_FILTER if defined: weights in steps of 1/256 voxel, as GPUs have them
//   SHADER_FILTER 1: the shader interpolates between samples itself; 2: the nearest sample, of categories
#include "stages/filtering.glsl"
#include "stages/value_scale.glsl"

layout(binding = 0) uniform sampler3D volume;
layout(binding = 1) uniform sampler1D transferTable; // entry 0: below the range; 1 to n: over it; n + 1: above

uniform vec2 mappedFromTexel; // value in the scale's own unit = texel * x + y
uniform vec2 entryFromMapped; // entry = g(mapped) * x + y; g as in volume/transfer_function.h
uniform float lastEntry;      // n + 1

uniform vec3 filterPeriodic; // 1 on axes that wrap

// By interpolation between samples in full precision, whatever the driver's filter does.
float interpolatedTexel(vec3 position) { return filteredTexel(volume, position, filterPeriodic); }

#if SHADER_FILTER == 2
float texelAt(vec3 position) { return nearestTexel(volume, position, filterPeriodic); }
#elif defined(COARSE_FILTER)
float texelAt(vec3 position) { return coarselyFilteredTexel(volume, position, filterPeriodic); }
#elif SHADER_FILTER
float texelAt(vec3 position) { return interpolatedTexel(position); }
#else
float texelAt(vec3 position) { return textureLod(volume, position, 0.0).r; }
#endif

vec4 classifyTexel(float texel) {
    float mapped = scaledValue(VALUE_SCALE, texel * mappedFromTexel.x + mappedFromTexel.y);
    // The clamp comes before the conversion to int: a float beyond its range converts to anything.
    float entry = clamp(mapped * entryFromMapped.x + entryFromMapped.y, 0.0, lastEntry);
#if MAY_BE_NAN
    if (isnan(texel)) return vec4(0.0);
#endif
    return texelFetch(transferTable, int(entry), 0);
}
