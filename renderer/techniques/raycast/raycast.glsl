// Emission and absorption along one ray per pixel, front to back (techniques/raycast/raycast.h).
//   CHUNK_SAMPLES  samples that one look-up of empty space answers for
//   SKIP_EMPTY     1: stretches that cannot show anything are left out
#include "stages/kept_span.glsl"
#include "stages/classification.glsl"
#include "stages/empty_space.glsl"
#include "stages/opacity.glsl"
#include "stages/picture_pixel.glsl"
#include "stages/clip_object.glsl"
#include "stages/shading.glsl"

layout(binding = 2) uniform usampler3D occupiedCells;

uniform vec3 voxelsPerTexture; // texels of the drawn level per axis
uniform float sampleDistanceVoxels;
uniform float unitsPerRadius; // bounding radius / unitLength

const float kOpaque = 1.0 / 1024.0;

bool mayShow(vec3 position) {
#if SKIP_EMPTY
    return texelFetch(occupiedCells, cellAt(position), 0).r != 0u;
#else
    return true;
#endif
}

// What stays the same along a ray.
struct Path {
    Ray ray;
    KeptSpan span;
    float spacing;       // depth of a whole stretch
    float unitsPerDepth; // path length in units of opacity
    float depthPerVoxel;
#if CLIP_OBJECT
    ClipRay clip;
#endif
};

// Colour so far, premultiplied, and what still shines through.
struct Light {
    vec3 colour;
    float transmittance;
};

void add(inout Light light, vec4 entry, float length) {
    vec4 rgba = overLength(entry, length);
    light.colour += light.transmittance * rgba.rgb;
    light.transmittance *= 1.0 - rgba.a;
}

// The sample at `depth` that stands for `length` of depth.
void takeSample(inout Light light, Path path, float depth, float length, bool nearObject) {
    vec4 entry = classifyTexel(texelAt(path.ray.origin + depth * path.ray.direction));
#if SHADING
    if (entry.a > 0.0 && length > 0.0)
#if CLIP_OBJECT
        entry.rgb = lit(entry.rgb, sampleNormal(path.ray, path.span, depth, path.depthPerVoxel, path.clip, nearObject), path.ray.toEye);
#else
        entry.rgb = lit(entry.rgb, sampleNormal(path.ray, path.span, depth, path.depthPerVoxel), path.ray.toEye);
#endif
#endif
    add(light, entry, length * path.unitsPerDepth);
}

#if CLIP_OBJECT
// The stretch [begin, end], as far as the object keeps it; gives the measure at its end, which the next one begins with.
float takeClipped(inout Light light, Path path, float begin, float end, float measureBegin) {
#if CLIP_OBJECT == 2
    float middle = 0.5 * (begin + end);
    float kept = keptMeasure(path.clip, middle) >= 0.0 ? end - begin : 0.0;
    if (kept > 0.0) takeSample(light, path, middle, kept, true);
    return 0.0;
#else
    float measureEnd = keptMeasure(path.clip, end);
    vec2 part = keptPart(begin, end, measureBegin, measureEnd);
    if (part.x < part.y) takeSample(light, path, 0.5 * (part.x + part.y), part.y - part.x, true);
    return measureEnd;
#endif
}

void takeChunk(inout Light light, Path path, int first, int whole) {
    float begin = path.span.begin + float(first) * path.spacing;
    // One voxel more in front: it decides whether samples lie behind a cut.
    float chunkEnd = begin + float(CHUNK_SAMPLES) * path.spacing;
    int verdict = clipVerdict(path.clip, begin - path.depthPerVoxel, chunkEnd);
    if (verdict < 0) return;
    if (verdict > 0) {
        for (int k = 0; k < CHUNK_SAMPLES; ++k)
            takeSample(light, path, begin + (float(k) + 0.5) * path.spacing, first + k < whole ? path.spacing : 0.0, false);
        return;
    }
    float measure = keptMeasure(path.clip, begin);
    int count = min(CHUNK_SAMPLES, whole - first);
    for (int k = 0; k < count; ++k) {
        float stretch = begin + float(k) * path.spacing;
        measure = takeClipped(light, path, stretch, stretch + path.spacing, measure);
    }
}
#else
void takeChunk(inout Light light, Path path, int first, int whole) {
    for (int k = 0; k < CHUNK_SAMPLES; ++k)
        takeSample(light, path, path.span.begin + (float(first + k) + 0.5) * path.spacing, first + k < whole ? path.spacing : 0.0, false);
}
#endif

vec4 composite(Path path) {
    float stretches = (path.span.end - path.span.begin) / path.spacing;
    int whole = int(stretches);
    Light light = Light(vec3(0.0), 1.0);
    int chunks = (whole + CHUNK_SAMPLES - 1) / CHUNK_SAMPLES;
    int chunk = 0;
    vec3 stride = path.spacing * path.ray.direction;
    vec3 first = path.ray.origin + (path.span.begin + 0.5 * path.spacing) * path.ray.direction;
    while (light.transmittance > kOpaque) {
        // Every lane of a SIMD group seeks its own next stretch, so that all of them then have samples to take.
        while (chunk < chunks &&
               !mayShow(first + (float(chunk * CHUNK_SAMPLES) + 0.5 * float(CHUNK_SAMPLES - 1)) * stride))
            ++chunk;
        if (chunk >= chunks) break;
        takeChunk(light, path, chunk * CHUNK_SAMPLES, whole);
        ++chunk;
    }
    // The rest of the path is shorter than a whole stretch: its sample sits in its middle and counts for its length.
    float begin = path.span.begin + float(whole) * path.spacing;
#if CLIP_OBJECT
    takeClipped(light, path, begin, path.span.end, keptMeasure(path.clip, begin));
#else
    takeSample(light, path, 0.5 * (begin + path.span.end), path.span.end - begin, false);
#endif
    return vec4(light.colour, 1.0 - light.transmittance);
}

void main() {
    ivec2 pixel = picturePixel();
    if (any(greaterThanEqual(pixel, targetSize))) return;
    Path path;
    path.ray = cameraRay(vec2(pixel) + 0.5);
    path.span = keptSpan(path.ray);
    vec4 rgba = vec4(0.0);
    if (path.span.begin < path.span.end) {
        path.depthPerVoxel = 1.0 / length(path.ray.direction * voxelsPerTexture);
        path.spacing = sampleDistanceVoxels * path.depthPerVoxel;
        path.unitsPerDepth = path.ray.radiiPerDepth * unitsPerRadius;
#if CLIP_OBJECT
        path.clip = clipRayOf(path.ray);
#endif
        rgba = composite(path);
    }
    imageStore(target, pixel, rgba);
}
