// Whether the clips keep a point.
#include "stages/kept_span.glsl"
#include "stages/clip_object.glsl"

uniform vec4 solidClipPlanes[kMaxClipPlanes]; // dot(xyz, point) + w >= 0 is kept
uniform mat4 textureFromSolid;
uniform float measurePerRadius; // what a bounding radius is in the distances of the clip object

// `point` in bounding radii from the box's centre on, world axes; `slack`: how far beyond a clip it may lie.
bool isKept(vec3 point, float slack) {
#if CLIP_PLANES
    for (int i = 0; i < clipPlaneCount; ++i)
        if (dot(solidClipPlanes[i].xyz, point) + solidClipPlanes[i].w < -slack) return false;
#endif
#if CLIP_OBJECT
    vec3 position = (textureFromSolid * vec4(point, 1.0)).xyz;
    float texel = distanceTexel((clipFromTexture * vec4(position, 1.0)).xyz);
    if (texel * measureFromTexel.x + measureFromTexel.y < -slack * measurePerRadius) return false;
#endif
    return true;
}
