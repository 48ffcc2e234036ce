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

#if SHADING
// The stretch whose sample is looked at next.
struct Cursor {
    int stretches; // along the whole ray, the shorter last one included
    int chunks;
    int chunk;
    int stretch;  // of the chunk
    bool entered; // `stretch` and `measure` hold for this chunk
    float measure; // where the stretch begins
    float depth;  // of the sample that was found
    float length; // that it stands for
    vec4 entry;
    bool nearObject;
};

float depthOf(Path path, int stretch) { return path.span.begin + float(stretch) * path.spacing; }

bool isWorthEntering(Path path, inout Cursor at) {
    int first = at.chunk * CHUNK_SAMPLES;
    float begin = depthOf(path, first);
    float end = depthOf(path, first + CHUNK_SAMPLES);
    bool worth = mayShow(path.ray.origin + 0.5 * (begin + end) * path.ray.direction);
#if CLIP_OBJECT
    // One voxel more in front: it decides whether samples lie behind a cut.
    int verdict = clipVerdict(path.clip, begin - path.depthPerVoxel, end);
    worth = worth && verdict >= 0;
    at.nearObject = verdict == 0;
#endif
    return worth;
}

// Goes on to the next sample that shows. Light is dear: where a driver runs SIMD groups with masks, a branch that no ray
// takes costs its time all the same, and only loops keep it off the samples that show nothing.
bool seekSample(Path path, inout Cursor at) {
    bool found = false;
    while (!found && at.chunk < at.chunks) {
        while (!at.entered && at.chunk < at.chunks && !isWorthEntering(path, at)) ++at.chunk;
        int first = at.chunk * CHUNK_SAMPLES;
        int count = min(CHUNK_SAMPLES, at.stretches - first);
        if (!at.entered) {
            at.entered = true;
            at.stretch = 0;
#if CLIP_OBJECT == 1
            at.measure = keptMeasure(path.clip, depthOf(path, first));
#endif
        }
        while (at.chunk < at.chunks && at.stretch < count) {
            vec2 part = vec2(depthOf(path, first + at.stretch), min(depthOf(path, first + at.stretch + 1), path.span.end));
            ++at.stretch;
#if CLIP_OBJECT == 1
            float measureEnd = keptMeasure(path.clip, part.y);
            part = keptPart(part.x, part.y, at.measure, measureEnd);
            at.measure = measureEnd;
#elif CLIP_OBJECT == 2
            if (keptMeasure(path.clip, 0.5 * (part.x + part.y)) < 0.0) part.y = part.x;
#endif
            at.depth = 0.5 * (part.x + part.y);
            at.length = part.y - part.x;
            at.entry = classifyTexel(texelAt(path.ray.origin + at.depth * path.ray.direction));
            found = at.entry.a > 0.0 && at.length > 0.0;
            if (found) break;
        }
        if (!found) {
            at.entered = false;
            ++at.chunk;
        }
    }
    return found;
}

vec4 composite(Path path) {
    Cursor at;
    at.stretches = int((path.span.end - path.span.begin) / path.spacing) + 1;
    at.chunks = (at.stretches + CHUNK_SAMPLES - 1) / CHUNK_SAMPLES;
    at.chunk = 0;
    at.entered = false;
    at.measure = 0.0;
    at.nearObject = false;
    Light light = Light(vec3(0.0), 1.0);
    while (light.transmittance > kOpaque) {
        if (!seekSample(path, at)) break;
#if CLIP_OBJECT
        vec3 normal = sampleNormal(path.ray, path.span, at.depth, path.depthPerVoxel, path.clip, at.nearObject);
#else
        vec3 normal = sampleNormal(path.ray, path.span, at.depth, path.depthPerVoxel);
#endif
        add(light, vec4(lit(at.entry.rgb, normal, path.ray.toEye), at.entry.a), at.length * path.unitsPerDepth);
    }
    return vec4(light.colour, 1.0 - light.transmittance);
}
#else
// The sample at `depth` that stands for `length` of depth.
void takeSample(inout Light light, Path path, float depth, float length) {
    add(light, classifyTexel(texelAt(path.ray.origin + depth * path.ray.direction)), length * path.unitsPerDepth);
}

void takeWhole(inout Light light, Path path, int first, int count) {
    for (int k = 0; k < CHUNK_SAMPLES; ++k)
        takeSample(light, path, path.span.begin + (float(first + k) + 0.5) * path.spacing, k < count ? path.spacing : 0.0);
}

#if CLIP_OBJECT
// The stretch [begin, end], as far as the object keeps it; gives the measure at its end, which the next one begins with.
float takeClipped(inout Light light, Path path, float begin, float end, float measureBegin) {
#if CLIP_OBJECT == 2
    float middle = 0.5 * (begin + end);
    takeSample(light, path, middle, keptMeasure(path.clip, middle) >= 0.0 ? end - begin : 0.0);
    return 0.0;
#else
    float measureEnd = keptMeasure(path.clip, end);
    vec2 part = keptPart(begin, end, measureBegin, measureEnd);
    takeSample(light, path, 0.5 * (part.x + part.y), part.y - part.x);
    return measureEnd;
#endif
}

void takeChunk(inout Light light, Path path, int first, int whole) {
    float begin = path.span.begin + float(first) * path.spacing;
    int verdict = clipVerdict(path.clip, begin, begin + float(CHUNK_SAMPLES) * path.spacing);
    int count = min(CHUNK_SAMPLES, whole - first);
    if (verdict > 0) takeWhole(light, path, first, count);
    float measure = keptMeasure(path.clip, begin);
    int clipped = verdict == 0 ? count : 0;
    for (int k = 0; k < clipped; ++k) {
        float stretch = begin + float(k) * path.spacing;
        measure = takeClipped(light, path, stretch, stretch + path.spacing, measure);
    }
}
#else
void takeChunk(inout Light light, Path path, int first, int whole) { takeWhole(light, path, first, whole - first); }
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
    takeSample(light, path, 0.5 * (begin + path.span.end), path.span.end - begin);
#endif
    return vec4(light.colour, 1.0 - light.transmittance);
}
#endif

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
