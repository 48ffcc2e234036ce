// The slices that one polygon carries (techniques/slicing/slicing.h). Positions come from the pixel's ray and not from interpolated
// texture coordinates, which rasterisers keep in fewer bits; for the same reason polygons are a little too large and the
// ray's own path through what is kept of the box decides.
//   SLABS_PER_POLYGON  slices, front to back
//   SKIP_EMPTY         1: polygons' pixels that cannot show anything are left out
#include "stages/kept_span.glsl"
#include "stages/classification.glsl"
#include "stages/empty_space.glsl"
#include "stages/opacity.glsl"
#include "stages/solids.glsl"
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
    return texelFetch(occupiedCells, cellAt(position), 0).r == 0u;
#else
    return true;
#endif
}

struct Slab {
    float depth;  // of its sample
    float length; // of what is kept of it
    vec4 entry;
};

Slab slabAt(Ray ray, KeptSpan span, int index
#if CLIP_OBJECT
            , ClipRay clip
#endif
) {
    float near = max(firstDepth + float(index) * slabDepth, span.begin);
    float far = min(firstDepth + float(index + 1) * slabDepth, span.end);
    vec2 part = vec2(near, max(near, far));
#if CLIP_OBJECT == 1
    part = keptPart(part.x, part.y, keptMeasure(clip, part.x), keptMeasure(clip, part.y));
#elif CLIP_OBJECT == 2
    if (keptMeasure(clip, 0.5 * (part.x + part.y)) < 0.0) part.y = part.x;
#endif
    Slab slab;
    slab.depth = 0.5 * (part.x + part.y);
    slab.length = part.y - part.x;
    slab.entry = classifyTexel(texelAt(ray.origin + slab.depth * ray.direction));
    return slab;
}

void main() {
    Ray ray = cameraRay(gl_FragCoord.xy);
    KeptSpan span = beforeSolids(keptSpan(ray), ivec2(gl_FragCoord.xy));
    float middle = firstDepth + 0.5 * float(SLABS_PER_POLYGON) * slabDepth;
    int slabs = mayShow(ray.origin + middle * ray.direction) ? SLABS_PER_POLYGON : 0;
    float unitsPerDepth = ray.radiiPerDepth * unitsPerRadius;
    colour = vec4(0.0);
#if CLIP_OBJECT || SHADING
    float depthPerVoxel = 1.0 / length(ray.direction * voxelsPerTexture);
#endif
#if CLIP_OBJECT
    ClipRay clip = clipRayOf(ray);
    // One voxel more in front: it decides whether samples lie behind a cut.
    int verdict = clipVerdict(clip, firstDepth - depthPerVoxel, firstDepth + float(SLABS_PER_POLYGON) * slabDepth);
    if (verdict < 0) slabs = 0;
#endif
    int index = 0;
    while (index < slabs) {
        Slab slab;
#if SHADING
        // Light is dear: only loops keep it off the samples that show nothing (techniques/raycast/raycast.glsl).
        bool found = false;
        while (index < slabs && !found) {
#endif
#if CLIP_OBJECT
            slab = slabAt(ray, span, index, clip);
#else
            slab = slabAt(ray, span, index);
#endif
            ++index;
#if SHADING
            found = slab.entry.a > 0.0 && slab.length > 0.0;
        }
        if (!found) break;
#if CLIP_OBJECT
        vec3 normal = sampleNormal(ray, span, slab.depth, depthPerVoxel, clip, verdict == 0);
#else
        vec3 normal = sampleNormal(ray, span, slab.depth, depthPerVoxel);
#endif
        slab.entry.rgb = lit(slab.entry.rgb, normal, ray.toEye);
#endif
        colour += (1.0 - colour.a) * overLength(slab.entry, slab.length * unitsPerDepth);
    }
}
