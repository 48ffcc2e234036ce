// Emission and absorption along one ray per pixel, front to back (techniques/raycast/raycast.h).
//   CHUNK_SAMPLES  samples that one look-up of empty space answers for
//   SKIP_EMPTY     1: stretches that cannot show anything are left out
//   LAYERS         volumes blended with the drawn one
//   PRE_INTEGRATED 1: whole stretches show the mean of the transfer function
//   ADAPTIVE       1: cells say how many stretches have one sample together
//   PAIRS_SHARE_LIGHT  1: two samples of whole stretches have one normal
#include "stages/kept_span.glsl"
#include "stages/classification.glsl"
#include "stages/empty_space.glsl"
#include "stages/opacity.glsl"
#include "stages/picture_pixel.glsl"
#include "stages/solids.glsl"
#include "stages/clip_object.glsl"
#include "stages/shading.glsl"
#include "stages/layers.glsl"
#if PRE_INTEGRATED
#include "stages/preintegration.glsl"
#endif

layout(binding = 2) uniform usampler3D occupiedCells;

uniform vec3 voxelsPerTexture; // texels of the drawn level per axis
uniform float sampleDistanceVoxels;
uniform float unitsPerRadius; // bounding radius / unitLength

const float kOpaque = 1.0 / 1024.0;
const int kClippedStride = 2; // stretches that have one sample together where an object clips: a crossing is sought within them

// From a chunk with its middle there to the next that may show something, in chunks; 0: it may itself. `chunk`: what it covers.
// `stride`: how many of its stretches have one sample together.
int chunksAhead(vec3 middle, vec3 chunk, out int stride) {
    stride = 1;
#if SKIP_EMPTY
    uint mark = texelFetch(occupiedCells, cellAt(middle), 0).r;
    int ahead = stretchesAhead(mark, float(CHUNK_SAMPLES) * sampleDistanceVoxels);
#if ADAPTIVE
    stride = strideOf(mark);
#endif
#if LAYERS
    if (ahead > 0) ahead = min(ahead, layersStretchesAhead(middle, chunk));
#endif
    return ahead;
#else
    return 0;
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
// Whether the sample has a cut's normal, and which.
bool cutNormalAt(Path path, float depth, bool nearObject, out vec3 normal) {
#if CLIP_OBJECT
    return cutNormal(path.ray, path.span, depth, path.depthPerVoxel, path.clip, nearObject, normal);
#else
    return cutNormal(path.ray, path.span, depth, path.depthPerVoxel, normal);
#endif
}
#endif

#if SHADING && PRE_INTEGRATED
vec3 litAt(Path path, float depth, vec3 rgb) {
    vec3 normal;
    bool behindCut = cutNormalAt(path, depth, false, normal);
    if (!behindCut) normal = gradientNormal(path.ray.origin + depth * path.ray.direction);
    return lit(rgb, normal, path.ray.toEye);
}
#endif

// The sample at `depth` that stands for `length` of depth.
void takeSample(inout Light light, Path path, float depth, float length, bool nearObject) {
    vec3 position = path.ray.origin + depth * path.ray.direction;
    vec4 entry = classifyTexel(texelAt(position));
    vec3 normal = vec3(0.0);
    bool behindCut = false;
#if SHADING
    if (LAYERS > 0 || entry.a > 0.0) behindCut = cutNormalAt(path, depth, nearObject, normal);
    if (entry.a > 0.0) entry.rgb = lit(entry.rgb, behindCut ? normal : gradientNormal(position), path.ray.toEye);
#endif
#if LAYERS
    blendLayers(entry, position, LayerLight(path.ray.toEye, behindCut, normal));
#endif
    add(light, entry, length * path.unitsPerDepth);
}

// What whole stretches show, one after the other: the one that begins at `depth`.
#if PRE_INTEGRATED
float stretchBegin(Path path, float depth) { return entryPosition(texelAt(path.ray.origin + depth * path.ray.direction)); }

// `begin`: what stretchBegin() gives; becomes that of the next. `length`: path.spacing, or several of it.
vec4 stretchEntry(Path path, float depth, float length, inout float begin) {
    float end = stretchBegin(path, depth + path.spacing);
    vec4 entry = meanEntry(begin, end);
    begin = end;
    return entry;
}
#else
float stretchBegin(Path path, float depth) { return 0.0; }
vec4 stretchEntry(Path path, float depth, float length, inout float begin) {
    return classifyTexel(texelAt(path.ray.origin + (depth + 0.5 * length) * path.ray.direction));
}
#endif

// Of `stride` whole stretches where so many are left.
float depthOf(Path path, int left, int stride) { return float(clamp(left, 0, stride)) * path.spacing; }

#if PAIRS_SHARE_LIGHT
void addThrough(inout Light light, vec3 rgb, float through) {
    light.colour += light.transmittance * (1.0 - through) * rgb;
    light.transmittance *= through;
}

// Two samples that share the normal between them: of `first` and `second` of depth, the second may be nothing.
void takeLitPair(inout Light light, Path path, float depth, float first, float second, inout float begin) {
    vec4 entry = stretchEntry(path, depth, first, begin);
    vec4 other = stretchEntry(path, depth + first, second, begin);
    float through = exp2(-entry.a * (first * path.unitsPerDepth));
    float otherThrough = exp2(-other.a * (second * path.unitsPerDepth));
    Reflection reflection = Reflection(1.0, 0.0);
    if (through * otherThrough < 1.0) {
        float between = depth + (second > 0.0 ? 1.0 : 0.5) * first;
        vec3 normal;
        bool behindCut = cutNormalAt(path, between, false, normal);
        if (!behindCut) normal = gradientNormal(path.ray.origin + between * path.ray.direction);
        reflection = reflectionOf(normal, path.ray.toEye);
    }
    addThrough(light, reflected(reflection, entry.rgb), through);
    addThrough(light, reflected(reflection, other.rgb), otherThrough);
}

void takeWhole(inout Light light, Path path, int first, int count, int stride) {
    float begin = stretchBegin(path, path.span.begin + float(first) * path.spacing);
#if ADAPTIVE
    for (int k = 0; k < count; k += 2 * stride)
#else
    for (int k = 0; k < CHUNK_SAMPLES; k += 2)
#endif
        takeLitPair(light, path, path.span.begin + float(first + k) * path.spacing, depthOf(path, count - k, stride),
                    depthOf(path, count - k - stride, stride), begin);
}
#elif PRE_INTEGRATED
void takeWhole(inout Light light, Path path, int first, int count, int stride) {
    float begin = stretchBegin(path, path.span.begin + float(first) * path.spacing);
    for (int k = 0; k < CHUNK_SAMPLES; ++k) {
        float depth = path.span.begin + float(first + k) * path.spacing;
        vec4 entry = stretchEntry(path, depth, path.spacing, begin);
#if SHADING
        if (entry.a > 0.0) entry.rgb = litAt(path, depth + 0.5 * path.spacing, entry.rgb);
#endif
        add(light, entry, k < count ? path.spacing * path.unitsPerDepth : 0.0);
    }
}
#else
// `count` whole stretches; none or fewer than a chunk's where the path ends.
void takeWhole(inout Light light, Path path, int first, int count, int stride) {
#if ADAPTIVE
    for (int k = 0; k < count; k += stride) {
        float length = depthOf(path, count - k, stride);
        takeSample(light, path, path.span.begin + float(first + k) * path.spacing + 0.5 * length, length, false);
    }
#else
    for (int k = 0; k < CHUNK_SAMPLES; ++k)
        takeSample(light, path, path.span.begin + (float(first + k) + 0.5) * path.spacing, k < count ? path.spacing : 0.0, false);
#endif
}
#endif

#if CLIP_OBJECT
// The stretch [begin, end], as far as the object keeps it; gives the measure at its end, which the next one begins with.
float takeClipped(inout Light light, Path path, float begin, float end, float measureBegin) {
#if CLIP_OBJECT == 2
    float middle = 0.5 * (begin + end);
    takeSample(light, path, middle, keptMeasure(path.clip, middle) >= 0.0 ? end - begin : 0.0, true);
    return 0.0;
#else
    float measureEnd = keptMeasure(path.clip, end);
    vec2 part = keptPart(begin, end, measureBegin, measureEnd);
    takeSample(light, path, 0.5 * (part.x + part.y), part.y - part.x, true);
    return measureEnd;
#endif
}
#endif

// The next chunk of the ray.
struct Chunk {
    int index;
    int verdict; // 1: all of it counts; 0: a part of it may; -1: it shows nothing
    int stride;
};

float chunkBegin(Path path, int chunk) { return path.span.begin + float(chunk * CHUNK_SAMPLES) * path.spacing; }

int wholeIn(int chunk, int whole) { return min(CHUNK_SAMPLES, whole - chunk * CHUNK_SAMPLES); }

#if CLIP_OBJECT
// Where more chunks show nothing, it is the last one of them.
void look(Path path, inout Chunk at) {
    float length = float(CHUNK_SAMPLES) * path.spacing;
    float begin = chunkBegin(path, at.index);
    float removedUntil;
#if SHADING
    // One voxel more in front: it decides whether samples lie behind a cut.
    at.verdict = clipVerdict(path.clip, begin - path.depthPerVoxel, begin + length, removedUntil);
#else
    at.verdict = clipVerdict(path.clip, begin, begin + length, removedUntil);
#endif
    if (at.verdict < 0) at.index = max(at.index, int((removedUntil - path.span.begin) / length) - 1);
    else {
        int ahead = chunksAhead(path.ray.origin + (begin + 0.5 * length) * path.ray.direction, length * path.ray.direction, at.stride);
        if (ahead > 0) at.verdict = -1;
        at.index += max(ahead - 1, 0);
    }
}

void takeClippedChunk(inout Light light, Path path, int chunk, int count, int stride) {
    int most = min(stride, kClippedStride);
    float measure = keptMeasure(path.clip, chunkBegin(path, chunk));
    for (int k = 0; k < count; k += most) {
        float stretch = path.span.begin + float(chunk * CHUNK_SAMPLES + k) * path.spacing;
        measure = takeClipped(light, path, stretch, stretch + depthOf(path, count - k, most), measure);
    }
}

// Loops, not branches: where a driver runs SIMD groups with masks, rays of a group that come to the same kind of chunk at
// different times then still take them together.
void takeWholeStretches(inout Light light, Path path, int whole, int chunks) {
    float length = float(CHUNK_SAMPLES) * path.spacing;
    vec2 kept = (clipKeptSpan(path.clip) - path.span.begin) / length;
    Chunk at = Chunk(int(clamp(kept.x, 0.0, float(chunks))), -1, 1);
    chunks = int(clamp(ceil(kept.y), 0.0, float(chunks)));
    if (at.index < chunks) look(path, at);
    while (light.transmittance > kOpaque && at.index < chunks) {
        while (at.verdict < 0 && at.index < chunks) {
            ++at.index;
            look(path, at);
        }
        while (at.verdict > 0 && at.index < chunks && light.transmittance > kOpaque) {
            takeWhole(light, path, at.index * CHUNK_SAMPLES, wholeIn(at.index, whole), at.stride);
            ++at.index;
            look(path, at);
        }
        while (at.verdict == 0 && at.index < chunks && light.transmittance > kOpaque) {
            takeClippedChunk(light, path, at.index, wholeIn(at.index, whole), at.stride);
            ++at.index;
            look(path, at);
        }
    }
}
#else
// Every lane of a SIMD group seeks its own next chunk, so that all of them then have samples to take.
void takeWholeStretches(inout Light light, Path path, int whole, int chunks) {
    int chunk = 0;
    float length = float(CHUNK_SAMPLES) * path.spacing;
    while (light.transmittance > kOpaque) {
        int ahead = 1;
        int stride = 1;
        while (chunk < chunks && ahead > 0) {
            ahead = chunksAhead(path.ray.origin + (chunkBegin(path, chunk) + 0.5 * length) * path.ray.direction, length * path.ray.direction, stride);
            chunk += ahead;
        }
        if (chunk >= chunks) break;
        takeWhole(light, path, chunk * CHUNK_SAMPLES, wholeIn(chunk, whole), stride);
        ++chunk;
    }
}
#endif

vec4 composite(Path path) {
    int whole = int((path.span.end - path.span.begin) / path.spacing);
    Light light = Light(vec3(0.0), 1.0);
    takeWholeStretches(light, path, whole, (whole + CHUNK_SAMPLES - 1) / CHUNK_SAMPLES);
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
    path.span = beforeSolids(keptSpan(path.ray), pixel);
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
