// From a texel of the volume to colour and opacity, through a float table (stages/classification.h).
//   VALUE_SCALE   0 linear, 1 logarithmic, 2 linear about 0 and logarithmic beyond
//   MAY_BE_NAN    1 when the volume can hold NaN
layout(binding = 0) uniform sampler3D volume;
layout(binding = 1) uniform sampler1D transferTable; // entry 0: below the range; 1 to n: over it; n + 1: above

uniform vec2 mappedFromTexel; // value in the scale's own unit = texel * x + y
uniform vec2 entryFromMapped; // entry = g(mapped) * x + y; g as in volume/transfer_function.h
uniform float lastEntry;      // n + 1

float texelAt(vec3 position) { return textureLod(volume, position, 0.0).r; }

vec4 classifyTexel(float texel) {
    float mapped = texel * mappedFromTexel.x + mappedFromTexel.y;
#if VALUE_SCALE == 1
    mapped = log2(max(mapped, 1e-37));
#elif VALUE_SCALE == 2
    float magnitude = abs(mapped);
    mapped = magnitude <= 1.0 ? mapped : sign(mapped) * (1.0 + log(magnitude));
#endif
    // The clamp comes before the conversion to int: a float beyond its range converts to anything.
    float entry = clamp(mapped * entryFromMapped.x + entryFromMapped.y, 0.0, lastEntry);
#if MAY_BE_NAN
    if (isnan(texel)) return vec4(0.0);
#endif
    return texelFetch(transferTable, int(entry), 0);
}
