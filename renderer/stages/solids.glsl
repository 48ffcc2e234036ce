// Opaque solids that stand in the picture (techniques/overlay/solids_overlay.h): nothing behind them is seen. Needs
// kept_span.glsl.
//   SOLIDS  1: there are some

#if SOLIDS
layout(binding = 16) uniform sampler2D solids; // rgb: lit; a: depth on the pixel's ray, or 1e30
#endif

const float kNoSolid = 1e29;

// Depth on the pixel's ray from which on a solid hides everything.
float solidDepth(ivec2 pixel) {
#if SOLIDS
    return texelFetch(solids, pixel, 0).a;
#else
    return 1e30;
#endif
}

// What of a ray lies before them.
KeptSpan beforeSolids(KeptSpan span, ivec2 pixel) {
#if SOLIDS
    span.end = min(span.end, solidDepth(pixel));
#endif
    return span;
}
