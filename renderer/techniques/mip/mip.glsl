// The largest value along one ray per pixel, then classified (techniques/mip/mip.h).
//   CHUNK_SAMPLES  samples that one look-up of the cells' largest values answers for
//   SKIP_EMPTY     1: stretches that cannot exceed the largest sample so far are left out
#include "stages/box.glsl"
#include "stages/classification.glsl"
#include "stages/empty_space.glsl"
#include "stages/opacity.glsl"
#include "stages/picture_pixel.glsl"

layout(binding = 2) uniform sampler3D largestInCells;

uniform vec3 voxelsPerTexture; // texels of the drawn level per axis
uniform float sampleDistanceVoxels;
uniform float opacityScale; // 1 / (the table's largest opacity)
uniform float texelSign; // -1 where values fall with texels

const float kNone = -3.0e38;

// The path of a ray in whole stretches, one sample in the middle of each, and a rest.
struct Path {
    vec3 first;  // sample 0
    vec3 stride; // from sample to sample
    int whole;
    int chunks;
};

float largestIn(Path path, int chunk, float largest) {
    int begin = chunk * CHUNK_SAMPLES;
    for (int k = 0; k < CHUNK_SAMPLES; ++k) {
        float texel = texelSign * texelAt(path.first + float(begin + k) * path.stride);
        if (begin + k < path.whole && texel > largest) largest = texel; // false for NaN
    }
    return largest;
}

float boundOf(Path path, int chunk) {
    vec3 middle = path.first + (float(chunk * CHUNK_SAMPLES) + 0.5 * float(CHUNK_SAMPLES - 1)) * path.stride;
    return texelFetch(largestInCells, cellAt(middle), 0).r;
}

float largestTexel(Ray ray, vec2 span) {
    float spacing = sampleDistanceVoxels / length(ray.direction * voxelsPerTexture);
    float stretches = (span.y - span.x) / spacing;
    Path path;
    path.whole = int(stretches);
    path.chunks = (path.whole + CHUNK_SAMPLES - 1) / CHUNK_SAMPLES;
    path.stride = spacing * ray.direction;
    path.first = ray.origin + (span.x + 0.5 * spacing) * ray.direction;

    float rest = stretches - float(path.whole);
    float largest = kNone;
    float texel = texelSign * texelAt(path.first + (float(path.whole) + 0.5 * (rest - 1.0)) * path.stride);
    if (texel > largest) largest = texel;
#if SKIP_EMPTY
    // The most promising chunk first: most others then cannot exceed what it holds.
    int promising = 0;
    float promise = kNone;
    for (int chunk = 0; chunk < path.chunks; ++chunk) {
        float bound = boundOf(path, chunk);
        if (bound > promise) {
            promise = bound;
            promising = chunk;
        }
    }
    if (path.chunks > 0) largest = largestIn(path, promising, largest);
#endif
    int chunk = 0;
    while (true) {
#if SKIP_EMPTY
        while (chunk < path.chunks && (chunk == promising || !(boundOf(path, chunk) > largest))) ++chunk;
#endif
        if (chunk >= path.chunks) break;
        largest = largestIn(path, chunk, largest);
        ++chunk;
    }
    return largest;
}

void main() {
    ivec2 pixel = picturePixel();
    if (any(greaterThanEqual(pixel, targetSize))) return;
    Ray ray = cameraRay(vec2(pixel) + 0.5);
    vec2 span = boxSpan(ray);
    float largest = span.x < span.y ? largestTexel(ray, span) : kNone;
    vec4 rgba = largest > kNone ? opacityScale * overLength(classifyTexel(texelSign * largest), 1.0) : vec4(0.0);
    imageStore(target, pixel, rgba);
}
