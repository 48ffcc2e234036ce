// The largest value along one ray per pixel, then classified (techniques/mip/mip.h).
//   CHUNK_SAMPLES  samples that one look-up of the cells' largest values answers for
//   SKIP_EMPTY     1: stretches that cannot exceed the largest sample so far are left out
#include "stages/box.glsl"
#include "stages/classification.glsl"
#include "stages/empty_space.glsl"
#include "stages/opacity.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f, binding = 0) writeonly uniform image2D target;
layout(binding = 2) uniform sampler3D largestInCells;

uniform ivec2 targetSize;
uniform int firstRow;
uniform vec3 voxelsPerTexture; // texels of the drawn level per axis
uniform float sampleDistanceVoxels;
uniform float opacityScale; // 1 / (the table's largest opacity)
uniform float texelSign; // -1 where values fall with texels

const float kNone = -3.0e38;

float largestTexel(Ray ray, vec2 span) {
    float spacing = sampleDistanceVoxels / length(ray.direction * voxelsPerTexture);
    float stretches = (span.y - span.x) / spacing;
    int whole = int(stretches);
    vec3 stride = spacing * ray.direction;
    vec3 first = ray.origin + (span.x + 0.5 * spacing) * ray.direction;

    // The sample of the rest of the path comes first: it is a start for the comparison.
    float rest = stretches - float(whole);
    float largest = kNone;
    float texel = texelSign * texelAt(first + (float(whole) + 0.5 * (rest - 1.0)) * stride);
    if (texel > largest) largest = texel; // false for NaN
    int chunks = (whole + CHUNK_SAMPLES - 1) / CHUNK_SAMPLES;
    int chunk = 0;
    while (true) {
#if SKIP_EMPTY
        while (chunk < chunks) {
            vec3 middle = first + (float(chunk * CHUNK_SAMPLES) + 0.5 * float(CHUNK_SAMPLES - 1)) * stride;
            if (texelFetch(largestInCells, cellAt(middle), 0).r > largest) break;
            ++chunk;
        }
#endif
        if (chunk >= chunks) break;
        int begin = chunk * CHUNK_SAMPLES;
        for (int k = 0; k < CHUNK_SAMPLES; ++k) {
            texel = texelSign * texelAt(first + float(begin + k) * stride);
            if (begin + k < whole && texel > largest) largest = texel;
        }
        ++chunk;
    }
    return largest;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(0, firstRow);
    if (any(greaterThanEqual(pixel, targetSize))) return;
    Ray ray = cameraRay(vec2(pixel) + 0.5);
    vec2 span = boxSpan(ray);
    float largest = span.x < span.y ? largestTexel(ray, span) : kNone;
    vec4 rgba = largest > kNone ? opacityScale * overLength(classifyTexel(texelSign * largest), 1.0) : vec4(0.0);
    imageStore(target, pixel, rgba);
}
