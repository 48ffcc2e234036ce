// The slices that one polygon carries (techniques/slicing/slicing.h). Positions come from the pixel's ray and not from interpolated
// texture coordinates, which rasterisers keep in fewer bits; for the same reason polygons are a little too large and the
// ray's own path through what is kept of the box decides.
//   SLABS_PER_POLYGON  slices, front to back
//   SKIP_EMPTY         1: polygons' pixels that cannot show anything are left out
#include "stages/kept_span.glsl"
#include "stages/classification.glsl"
#include "stages/empty_space.glsl"
#include "stages/opacity.glsl"
#include "stages/clip_object.glsl"
#include "stages/shading.glsl"

layout(binding = 2) uniform usampler3D occupiedCells;

flat in float firstDepth;
layout(location = 0) out vec4 colour;

uniform float slabDepth;
uniform float unitsPerRadius; // bounding radius / unitLength
uniform vec3 voxelsPerTexture; // texels of the drawn level per axis

bool mayShow(vec3 position) {
#if SKIP_EMPTY
    return texelFetch(occupiedCells, cellAt(position), 0).r != 0u;
#else
    return true;
#endif
}

// The part [near, far] of the ray, one sample in its middle, behind what is in `colour` already.
void addPart(Ray ray, KeptSpan span, vec2 part, float unitsPerDepth, float depthPerVoxel
#if CLIP_OBJECT
             , ClipRay clip, bool nearObject
#endif
) {
    float depth = 0.5 * (part.x + part.y);
    vec4 entry = classifyTexel(texelAt(ray.origin + depth * ray.direction));
#if SHADING
    if (entry.a > 0.0 && part.x < part.y)
#if CLIP_OBJECT
        entry.rgb = lit(entry.rgb, sampleNormal(ray, span, depth, depthPerVoxel, clip, nearObject), ray.toEye);
#else
        entry.rgb = lit(entry.rgb, sampleNormal(ray, span, depth, depthPerVoxel), ray.toEye);
#endif
#endif
    colour += (1.0 - colour.a) * overLength(entry, max(part.y - part.x, 0.0) * unitsPerDepth);
}

#if CLIP_OBJECT
vec2 partKept(ClipRay clip, float near, float far) {
#if CLIP_OBJECT == 2
    return keptMeasure(clip, 0.5 * (near + far)) >= 0.0 ? vec2(near, far) : vec2(near);
#else
    return keptPart(near, far, keptMeasure(clip, near), keptMeasure(clip, far));
#endif
}
#endif

void main() {
    Ray ray = cameraRay(gl_FragCoord.xy);
    KeptSpan span = keptSpan(ray);
    float middle = firstDepth + 0.5 * float(SLABS_PER_POLYGON) * slabDepth;
    int slabs = mayShow(ray.origin + middle * ray.direction) ? SLABS_PER_POLYGON : 0;
    float unitsPerDepth = ray.radiiPerDepth * unitsPerRadius;
    float depthPerVoxel = 1.0 / length(ray.direction * voxelsPerTexture);
    colour = vec4(0.0);
#if CLIP_OBJECT
    ClipRay clip = clipRayOf(ray);
    float end = firstDepth + float(SLABS_PER_POLYGON) * slabDepth;
    int verdict = slabs > 0 ? clipVerdict(clip, firstDepth - depthPerVoxel, end) : -1;
    if (verdict < 0) slabs = 0;
#endif
    for (int slab = 0; slab < slabs; ++slab) {
        float near = max(firstDepth + float(slab) * slabDepth, span.begin);
        float far = min(firstDepth + float(slab + 1) * slabDepth, span.end);
#if CLIP_OBJECT
        vec2 part = vec2(near, far);
        if (verdict == 0) part = near < far ? partKept(clip, near, far) : vec2(near);
        addPart(ray, span, part, unitsPerDepth, depthPerVoxel, clip, verdict == 0);
#else
        addPart(ray, span, vec2(near, far), unitsPerDepth, depthPerVoxel);
#endif
    }
}
