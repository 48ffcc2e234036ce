// Mean of the transfer function between two values (stages/preintegration.h). Needs classification.glsl.
layout(binding = 17) uniform sampler1D integralTable; // of rgb times extinction and extinction, up to each entry

const float kFarBeyond = 65536.0; // entries; there below and above have all of a stretch

// Position over the entries; beyond the ends, too. NaN stays.
float entryPosition(float texel) {
    float mapped = scaledValue(VALUE_SCALE, texel * mappedFromTexel.x + mappedFromTexel.y);
    return isnan(texel) ? texel : clamp(mapped * entryFromMapped.x + entryFromMapped.y, -kFarBeyond, kFarBeyond);
}

vec4 integralAt(float position) {
    float first = clamp(floor(position), 0.0, lastEntry);
    vec4 before = texelFetch(integralTable, int(first), 0);
    vec4 after = texelFetch(integralTable, int(first) + 1, 0);
    return before + (position - first) * (after - before);
}

// Chromaticity and extinction.
vec4 meanEntry(float begin, float end) {
    // Values that stay within two entries need no mean, and sums in 32 bits would not give it.
    if (abs(end - begin) < 2.0) return texelFetch(transferTable, int(clamp(0.5 * (begin + end), 0.0, lastEntry)), 0);
#if MAY_BE_NAN
    if (isnan(begin + end)) return vec4(0.0);
#endif
    vec4 sum = integralAt(end) - integralAt(begin);
    float extinction = max(sum.w / (end - begin), 0.0);
    return extinction > 0.0 ? vec4(clamp(sum.rgb / sum.w, 0.0, 1.0), extinction) : vec4(0.0);
}
