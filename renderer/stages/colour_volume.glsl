// Colours from another volume at the same point of the world (stages/colour_volume.h).
//   COLOUR_VOLUME  1: there is one
//   COLOUR_SCALE   as VALUE_SCALE of classification.glsl
//   COLOUR_FILTER  1: the shader interpolates its samples itself
#include "stages/filtering.glsl"
#include "stages/value_scale.glsl"

#if COLOUR_VOLUME
layout(binding = 5) uniform sampler3D colourVolume;
layout(binding = 6) uniform sampler1D colourTable;

uniform mat4 colourFromTexture; // texture frame of the drawn volume to that of the colouring one
uniform vec3 colourBoxLow;
uniform vec3 colourBoxHigh;
uniform vec2 colourMappedFromTexel;
uniform vec2 colourEntryFromMapped;
uniform float colourLastEntry;
uniform vec3 colourPeriodic;

// Its colour at a point of the drawn volume; `own` where it has none.
vec3 colourAt(vec3 position, vec3 own) {
    vec3 at = (colourFromTexture * vec4(position, 1.0)).xyz;
    if (any(lessThan(at, colourBoxLow)) || any(greaterThan(at, colourBoxHigh))) return own;
#if COLOUR_FILTER
    float texel = filteredTexel(colourVolume, at, colourPeriodic);
#else
    float texel = textureLod(colourVolume, at, 0.0).r;
#endif
    if (isnan(texel)) return own;
    float mapped = scaledValue(COLOUR_SCALE, texel * colourMappedFromTexel.x + colourMappedFromTexel.y);
    return texelFetch(colourTable, int(clamp(mapped * colourEntryFromMapped.x + colourEntryFromMapped.y, 0.0, colourLastEntry)), 0).rgb;
}
#endif
