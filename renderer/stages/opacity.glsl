// Opacity of a sample over its stretch of the ray.

// From chromaticity and extinction, over a length in units of unitLength, to premultiplied colour and alpha.
vec4 overLength(vec4 entry, float length) {
    float alpha = 1.0 - exp2(-entry.a * length);
    return vec4(entry.rgb * alpha, alpha);
}
