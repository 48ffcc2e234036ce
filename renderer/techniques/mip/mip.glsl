// The largest value along one ray per pixel, then classified (techniques/mip/mip.h).
//   CHUNK_SAMPLES  samples that one look-up of the cells' largest values answers for
//   SKIP_EMPTY     1: stretches that cannot exceed the largest sample so far are left out
#include "stages/kept_span.glsl"
#include "stages/classification.glsl"
#include "stages/empty_space.glsl"
#include "stages/opacity.glsl"
#include "stages/picture_pixel.glsl"
#include "stages/solids.glsl"
#include "stages/clip_object.glsl"

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
    float firstDepth; // of sample 0
    float spacing;    // of depth
#if CLIP_OBJECT
    ClipRay clip;
#endif
};

float largestIn(Path path, int chunk, float largest) {
    int begin = chunk * CHUNK_SAMPLES;
#if CLIP_OBJECT
    float firstDepth = path.firstDepth + float(begin) * path.spacing;
    int verdict = clipVerdict(path.clip, firstDepth, firstDepth + float(CHUNK_SAMPLES) * path.spacing);
    if (verdict < 0) return largest;
#endif
    int whole = CHUNK_SAMPLES;
#if CLIP_OBJECT
    whole = verdict > 0 ? CHUNK_SAMPLES : 0;
    int clipped = verdict == 0 ? CHUNK_SAMPLES : 0;
    for (int k = 0; k < clipped; ++k) {
        float texel = texelSign * texelAt(path.first + float(begin + k) * path.stride);
        bool kept = keptMeasure(path.clip, firstDepth + float(k) * path.spacing) >= 0.0;
        if (begin + k < path.whole && texel > largest && kept) largest = texel; // false for NaN
    }
#endif
    for (int k = 0; k < whole; ++k) {
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
    path.firstDepth = span.x + 0.5 * spacing;
    path.spacing = spacing;
    path.first = ray.origin + path.firstDepth * ray.direction;
#if CLIP_OBJECT
    path.clip = clipRayOf(ray);
#endif

    float rest = stretches - float(path.whole);
    float largest = kNone;
    float restSample = float(path.whole) + 0.5 * (rest - 1.0);
    float texel = texelSign * texelAt(path.first + restSample * path.stride);
    bool counts = texel > largest;
#if CLIP_OBJECT
    if (counts) counts = keptMeasure(path.clip, path.firstDepth + restSample * spacing) >= 0.0;
#endif
    if (counts) largest = texel;
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
    KeptSpan span = beforeSolids(keptSpan(ray), pixel);
    float largest = span.begin < span.end ? largestTexel(ray, vec2(span.begin, span.end)) : kNone;
    vec4 rgba = largest > kNone ? opacityScale * overLength(classifyTexel(texelSign * largest), 1.0) : vec4(0.0);
    imageStore(target, pixel, rgba);
}
