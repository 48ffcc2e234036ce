// The slices that one polygon carries (techniques/slicing/slicing.h). Positions come from the pixel's ray and not from interpolated
// texture coordinates, which rasterisers keep in fewer bits; for the same reason polygons are a little too large and the
// ray's own path through the box decides.
//   SLABS_PER_POLYGON  slices, front to back
//   SKIP_EMPTY         1: polygons' pixels that cannot show anything are left out
#include "stages/box.glsl"
#include "stages/classification.glsl"
#include "stages/empty_space.glsl"
#include "stages/opacity.glsl"

layout(binding = 2) uniform usampler3D occupiedCells;

flat in float firstDepth;
layout(location = 0) out vec4 colour;

uniform float slabDepth;
uniform float unitsPerRadius; // bounding radius / unitLength

bool mayShow(vec3 position) {
#if SKIP_EMPTY
    return texelFetch(occupiedCells, cellAt(position), 0).r != 0u;
#else
    return true;
#endif
}

void main() {
    Ray ray = cameraRay(gl_FragCoord.xy);
    vec2 span = boxSpan(ray);
    float middle = firstDepth + 0.5 * float(SLABS_PER_POLYGON) * slabDepth;
    int slabs = mayShow(ray.origin + middle * ray.direction) ? SLABS_PER_POLYGON : 0;
    float unitsPerDepth = ray.radiiPerDepth * unitsPerRadius;
    colour = vec4(0.0);
    for (int slab = 0; slab < slabs; ++slab) {
        float near = max(firstDepth + float(slab) * slabDepth, span.x);
        float far = min(firstDepth + float(slab + 1) * slabDepth, span.y);
        vec4 entry = classifyTexel(texelAt(ray.origin + 0.5 * (near + far) * ray.direction));
        vec4 rgba = overLength(entry, max(far - near, 0.0) * unitsPerDepth);
        colour += (1.0 - colour.a) * rgba;
    }
}
