// Opacity of a sample over its stretch of the ray, premultiplied.
//   UNIFORM_EXPONENT  1: the table is already premultiplied and corrected, 0: it holds chromaticity and extinction

// `exponent`: length of the stretch in units of unitLength.
vec4 overStretch(vec4 entry, float exponent) {
#if UNIFORM_EXPONENT
    return entry;
#else
    float alpha = 1.0 - exp2(-entry.a * exponent);
    return vec4(entry.rgb * alpha, alpha);
#endif
}

// The same over the `part` of a stretch, in [0, 1].
vec4 overPartOfStretch(vec4 entry, float exponent, float part) {
#if UNIFORM_EXPONENT
    if (entry.a <= 0.0) return vec4(0.0);
    float alpha = 1.0 - pow(max(1.0 - entry.a, 1e-37), part);
    return entry * (alpha / entry.a);
#else
    return overStretch(entry, exponent * part);
#endif
}
