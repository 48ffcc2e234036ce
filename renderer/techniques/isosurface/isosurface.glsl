// Crossings of isovalues along one ray per pixel, front to back (techniques/isosurface/isosurface.h).
//   CHUNK_SAMPLES  steps that one look-up of empty space answers for
//   SKIP_EMPTY     1: stretches without a crossing are left out
//   CAPS           1: cuts close what they open
//   ALPHA_TEST     1: the plain test, with its gaps
#include "stages/kept_span.glsl"
#include "stages/classification.glsl"
#include "stages/empty_space.glsl"
#include "stages/picture_pixel.glsl"
#include "stages/clip_object.glsl"
#include "stages/shading.glsl"
#include "stages/colour_volume.glsl"

layout(binding = 2) uniform usampler3D occupiedCells;

uniform vec3 voxelsPerTexture; // texels of the drawn level per axis
uniform float sampleDistanceVoxels;
const int kMaxSurfaces = 8;
uniform int surfaceCount;
uniform vec4 surfaceTexels[kMaxSurfaces];  // x: the value as a texel; rising
uniform vec4 surfaceColours[kMaxSurfaces]; // not premultiplied
uniform float tolerance;                   // of the plain test, in texels
uniform vec2 capTexels; // texel times x is at least y: inside
uniform vec2 mirroredCapTexels; // the same for negative values; never true: there are none

const float kOpaque = 1.0 / 1024.0;
const float kRefinedVoxels = 0.008; // width within which a crossing is enclosed

struct Path {
    Ray ray;
    KeptSpan span;
    float spacing;
    float depthPerVoxel;
#if CLIP_OBJECT
    ClipRay clip;
#endif
};

struct Light {
    vec3 colour;
    float transmittance;
};

float texelAtDepth(Path path, float depth) { return texelAt(path.ray.origin + depth * path.ray.direction); }

bool mayCross(Path path, float depth) {
#if SKIP_EMPTY
    return texelFetch(occupiedCells, cellAt(path.ray.origin + depth * path.ray.direction), 0).r != 0u;
#else
    return true;
#endif
}

// Encloses the crossing of `texel` between two depths to kRefinedVoxels, then interpolates.
float refinedDepth(Path path, float texel, float near, float far, float atNear, float atFar) {
    float wanted = kRefinedVoxels * path.depthPerVoxel;
    float a = near, b = far, fa = atNear - texel, fb = atFar - texel;
    for (int i = 0; i < 12 && b - a > wanted; ++i) {
        // First where a straight line crosses, then a short step towards the other end: on smooth data these two enclose
        // the crossing; halving in between keeps the worst case bounded.
        float guess = (i & 3) == 3 ? 0.5 * (a + b) : a + (b - a) * clamp(fa / (fa - fb), 0.02, 0.98);
        float f = texelAtDepth(path, guess) - texel;
        bool before = (f < 0.0) == (fa < 0.0);
        float next = before ? min(guess + 0.9 * wanted, b) : max(guess - 0.9 * wanted, a);
        if (before) { a = guess; fa = f; } else { b = guess; fb = f; }
        if (next <= a || next >= b) continue;
        f = texelAtDepth(path, next) - texel;
        if ((f < 0.0) == (fa < 0.0)) { a = next; fa = f; } else { b = next; fb = f; }
    }
    return a + (b - a) * clamp(fa / (fa - fb), 0.0, 1.0);
}

void addSurface(inout Light light, vec3 rgb, float alpha) {
    light.colour += light.transmittance * alpha * rgb;
    light.transmittance *= 1.0 - alpha;
}

#if SHADING
vec3 litSurface(vec3 rgb, Path path, vec3 position) {
    return lit(rgb, viewFromGradient * gradientAt(position), path.ray.toEye);
}
#else
vec3 litSurface(vec3 rgb, Path path, vec3 position) { return rgb; }
#endif

void showCrossing(inout Light light, Path path, int surface, float depth) {
#if CLIP_OBJECT
    if (keptMeasure(path.clip, depth) < 0.0) return;
#endif
    vec3 position = path.ray.origin + depth * path.ray.direction;
    vec4 colour = surfaceColours[surface];
#if COLOUR_VOLUME
    colour.rgb = colourAt(position, colour.rgb);
#endif
    addSurface(light, litSurface(colour.rgb, path, position), colour.a);
}

#if CAPS
// A cut at `depth`, whose normal is of the view frame; shows it if it lies inside a surface.
void showCap(inout Light light, Path path, float depth, vec3 normal) {
    float texel = texelAtDepth(path, depth);
    bool inside = texel * capTexels.x >= capTexels.y || texel * mirroredCapTexels.x >= mirroredCapTexels.y; // false for NaN
    if (!inside) return;
    vec3 rgb = classifyTexel(texel).rgb;
#if SHADING
    rgb = lit(rgb, normal, path.ray.toEye);
#endif
    addSurface(light, rgb, 1.0);
}

void showEntryCap(inout Light light, Path path) {
    if (path.span.cutPlane < 0) return;
#if CLIP_OBJECT
    if (keptMeasure(path.clip, path.span.begin) < 0.0) return;
#endif
#if SHADING
    showCap(light, path, path.span.begin, cutNormals[path.span.cutPlane].xyz);
#else
    showCap(light, path, path.span.begin, vec3(0.0));
#endif
}

#if CLIP_OBJECT
void showObjectCap(inout Light light, Path path, float begin, float end, float measureBegin, float measureEnd) {
    if (measureBegin >= 0.0 || measureEnd < 0.0) return;
    float depth = clipCrossing(begin, end, measureBegin, measureEnd);
    showCap(light, path, depth, clipSurfaceNormal(path.clip.origin + depth * path.clip.direction));
}
#endif
#endif

// The crossings between two depths, in the order in which the ray meets them.
void showCrossings(inout Light light, Path path, float begin, float end, float atBegin, float atEnd) {
    bool rising = atEnd > atBegin;
    for (int i = 0; i < surfaceCount; ++i) {
        int surface = rising ? i : surfaceCount - 1 - i;
        float texel = surfaceTexels[surface].x;
        bool below = atBegin < texel;
        if (below == (atEnd < texel) || isnan(atBegin) || isnan(atEnd)) continue;
        showCrossing(light, path, surface, refinedDepth(path, texel, begin, end, atBegin, atEnd));
        if (light.transmittance <= kOpaque) return;
    }
}

#if ALPHA_TEST
void march(inout Light light, Path path) {
    for (float depth = path.span.begin + 0.5 * path.spacing; depth < path.span.end && light.transmittance > kOpaque; depth += path.spacing) {
        float texel = texelAtDepth(path, depth);
        for (int i = 0; i < surfaceCount; ++i)
            if (abs(texel - surfaceTexels[i].x) <= tolerance) showCrossing(light, path, i, depth);
    }
}
#else
void march(inout Light light, Path path) {
    int steps = int(ceil((path.span.end - path.span.begin) / path.spacing));
    int chunks = (steps + CHUNK_SAMPLES - 1) / CHUNK_SAMPLES;
    float chunkDepth = float(CHUNK_SAMPLES) * path.spacing;
#if CAPS
    showEntryCap(light, path);
#endif
    int chunk = 0;
    while (light.transmittance > kOpaque) {
        bool interesting = false;
#if CLIP_OBJECT
        int verdict = 1;
#endif
        // Every lane of a SIMD group seeks its own next chunk, so that all of them then have steps to take.
        for (; chunk < chunks; ++chunk) {
            float begin = path.span.begin + float(chunk) * chunkDepth;
            interesting = mayCross(path, begin + 0.5 * chunkDepth);
#if CLIP_OBJECT
#if !CAPS
            if (!interesting) continue;
#endif
            verdict = clipVerdict(path.clip, begin, min(begin + chunkDepth, path.span.end));
            if (verdict < 0) continue;
            if (verdict == 0 && bool(CAPS)) break;
#endif
            if (interesting) break;
        }
        if (chunk >= chunks) break;
        int first = chunk * CHUNK_SAMPLES;
        int count = min(CHUNK_SAMPLES, steps - first);
        float begin = path.span.begin + float(first) * path.spacing;
        float atBegin = texelAtDepth(path, begin);
#if CAPS && CLIP_OBJECT
        float measure = verdict == 0 ? keptMeasure(path.clip, begin) : 1.0;
#endif
        for (int k = 1; k <= count && light.transmittance > kOpaque; ++k) {
            float end = min(path.span.begin + float(first + k) * path.spacing, path.span.end);
            float atEnd = texelAtDepth(path, end);
#if CAPS && CLIP_OBJECT
            if (verdict == 0) {
                float measureEnd = keptMeasure(path.clip, end);
                showObjectCap(light, path, begin, end, measure, measureEnd);
                measure = measureEnd;
                if (light.transmittance <= kOpaque) break;
            }
#endif
            showCrossings(light, path, begin, end, atBegin, atEnd);
            begin = end;
            atBegin = atEnd;
        }
        ++chunk;
    }
}
#endif

void main() {
    ivec2 pixel = picturePixel();
    if (any(greaterThanEqual(pixel, targetSize))) return;
    Path path;
    path.ray = cameraRay(vec2(pixel) + 0.5);
    path.span = keptSpan(path.ray);
    Light light = Light(vec3(0.0), 1.0);
    if (path.span.begin < path.span.end) {
        path.depthPerVoxel = 1.0 / length(path.ray.direction * voxelsPerTexture);
        path.spacing = sampleDistanceVoxels * path.depthPerVoxel;
#if CLIP_OBJECT
        path.clip = clipRayOf(path.ray);
#endif
        march(light, path);
    }
    imageStore(target, pixel, vec4(light.colour, 1.0 - light.transmittance));
}
