// The part of a ray that the box and the clip planes leave (stages/clip_stage.h): convex, so one interval.
//   CLIP_PLANES  1: there are clip planes
#include "stages/box.glsl"

const int kMaxClipPlanes = 16;
uniform int clipPlaneCount;
uniform vec4 clipPlanes[kMaxClipPlanes]; // texture frame: dot(xyz, p) + w >= 0 is kept

struct KeptSpan {
    float begin;
    float end; // <= begin: nothing is left
    int cutPlane; // the clip plane that the ray enters through, or -1: a face of the box, or the eye
};

KeptSpan keptSpan(Ray ray) {
    vec2 span = boxSpan(ray);
    KeptSpan kept = KeptSpan(span.x, span.y, -1);
#if CLIP_PLANES
    for (int i = 0; i < clipPlaneCount; ++i) {
        float advance = dot(clipPlanes[i].xyz, ray.direction);
        float beyond = dot(clipPlanes[i].xyz, ray.origin) + clipPlanes[i].w;
        float crossing = -beyond / (abs(advance) < 1e-20 ? 1e-20 : advance);
        if (advance > 0.0) {
            if (crossing > kept.begin) {
                kept.begin = crossing;
                kept.cutPlane = i;
            }
        } else if (advance < 0.0) {
            kept.end = min(kept.end, crossing);
        } else if (beyond < 0.0) {
            kept.end = kept.begin;
        }
    }
#endif
    return kept;
}
