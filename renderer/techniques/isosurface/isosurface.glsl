// Crossings of isovalues along one ray per pixel, front to back (techniques/isosurface/isosurface.h).
//   CHUNK_SAMPLES  steps that one look-up of empty space answers for
//   SKIP_EMPTY     1: stretches without a crossing are left out
//   CAPS           1: cuts close what they open
//   ALPHA_TEST     1: the plain test, with its gaps
//   SURFACES       how many there are
//   EXACT_ROOTS    1: crossings are told and refined by the shader's own interpolation, for filters with coarse weights
#include "stages/kept_span.glsl"
#include "stages/classification.glsl"
#include "stages/empty_space.glsl"
#include "stages/picture_pixel.glsl"
#include "stages/solids.glsl"
#include "stages/clip_object.glsl"
#include "stages/shading.glsl"
#include "stages/colour_volume.glsl"

layout(binding = 2) uniform usampler3D occupiedCells;

uniform vec3 voxelsPerTexture; // texels of the drawn level per axis
uniform float sampleDistanceVoxels;
const int kMaxSurfaces = 8;
uniform vec4 surfaceTexels[kMaxSurfaces];  // x: the value as a texel; rising
uniform vec4 surfaceColours[kMaxSurfaces]; // not premultiplied
uniform float tolerance;                   // 1/128 of the volume's range in texels: what the plain test takes for equal
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

// From a chunk with its middle at this depth to the next that a surface may cross, in chunks; 0: one may cross it.
int chunksAhead(Path path, float middle) {
#if SKIP_EMPTY
    return stretchesAhead(texelFetch(occupiedCells, cellAt(path.ray.origin + middle * path.ray.direction), 0).r,
                          float(CHUNK_SAMPLES) * sampleDistanceVoxels);
#else
    return 0;
#endif
}

// The texel that crossings are refined by.
float refinedTexelAt(Path path, float depth) {
#if EXACT_ROOTS
    return interpolatedTexel(path.ray.origin + depth * path.ray.direction);
#else
    return texelAtDepth(path, depth);
#endif
}

// The texel whose side of each surface tells whether one is crossed. Weights in steps of 1/256 on three axes move it by 3/512 of the range
// at most: what is further away from every surface stays on its side.
float sidedTexelAt(Path path, float depth) {
    float texel = texelAtDepth(path, depth);
#if EXACT_ROOTS
    bool near = false;
    for (int i = 0; i < SURFACES; ++i) near = near || abs(texel - surfaceTexels[i].x) <= tolerance;
    if (near) texel = refinedTexelAt(path, depth);
#endif
    return texel;
}

// Where the texel is `texel` between two depths that lie on both sides of it: by false position, with the weight of an end that
// stays halved (Illinois; Dowell & Jarratt 1971), until it is enclosed to kRefinedVoxels or two guesses in turn lie within an eighth of that.
float refinedDepth(Path path, float texel, float near, float far, float atNear, float atFar) {
    float wanted = kRefinedVoxels * path.depthPerVoxel;
    float a = near, b = far, fa = atNear - texel, fb = atFar - texel;
    float guess = a + (b - a) * clamp(fa / (fa - fb), 0.0, 1.0);
    float moved = b - a;
    float side = 0.0; // of the last guess
    for (int i = 0; i < 12 && min(b - a, 8.0 * moved) > wanted; ++i) {
        float f = refinedTexelAt(path, guess) - texel;
        bool before = (f < 0.0) == (fa < 0.0);
        float kept = side == (before ? 1.0 : -1.0) ? 0.5 : 1.0;
        side = before ? 1.0 : -1.0;
        fb = before ? kept * fb : f;
        fa = before ? f : kept * fa;
        a = before ? guess : a;
        b = before ? b : guess;
        float next = a + (b - a) * clamp(fa / (fa - fb), 0.0, 1.0);
        moved = abs(next - guess);
        guess = next;
    }
    return guess;
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
    float texel = refinedTexelAt(path, depth);
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
    showCap(light, path, path.span.begin, cutNormals[max(path.span.cutPlane, 0)].xyz);
#else
    showCap(light, path, path.span.begin, vec3(0.0));
#endif
}

#endif

// How many surfaces lie at or below a texel, in the order of surfaceTexels; -1: no value.
int rankOf(float texel) {
    int rank = 0;
    for (int i = 0; i < SURFACES; ++i) rank += texel >= surfaceTexels[i].x ? 1 : 0;
    return isnan(texel) ? -1 : rank;
}

#if ALPHA_TEST
void march(inout Light light, Path path) {
    // One sample in the middle of each stretch, and of the shorter rest.
    for (int step = 0; light.transmittance > kOpaque; ++step) {
        float begin = path.span.begin + float(step) * path.spacing;
        if (begin >= path.span.end) break;
        float depth = 0.5 * (begin + min(begin + path.spacing, path.span.end));
        float texel = texelAtDepth(path, depth);
        for (int i = 0; i < SURFACES; ++i)
            if (abs(texel - surfaceTexels[i].x) <= tolerance) showCrossing(light, path, i, depth);
    }
}
#else
// Where a ray has got to: the step from `begin` on is looked at next.
struct March {
    int steps;   // along the whole ray
    int chunks;
    int chunk;
    int step;    // of the chunk
    bool entered; // the members below hold for this chunk
    float begin;
    float atBegin; // texels
    float end;
    float atEnd;
    int rankBegin;
    int rankEnd;
    float atStep;   // where the whole step begins, whatever `begin` is
    float atBefore; // a step before that
    bool mayTurn;   // the value had been heading for a surface but did not pass it at the step's end
    bool isSplit;   // the rest of the step, behind `end`, is looked at next: up to
    float wholeEnd;
    float atWholeEnd;
#if CAPS && CLIP_OBJECT
    float measureBegin;
    float measureEnd;
#endif
};

float chunkBegin(Path path, int chunk) { return path.span.begin + float(chunk * CHUNK_SAMPLES) * path.spacing; }

// To the next chunk that can hold anything to show, in chunks; 0: this one can.
int worthEnteringAhead(Path path, March at) {
    float begin = chunkBegin(path, at.chunk);
    float length = float(CHUNK_SAMPLES) * path.spacing;
    int ahead = chunksAhead(path, begin + 0.5 * length);
#if CLIP_OBJECT
    int verdict = clipVerdict(path.clip, begin, min(begin + length, path.span.end));
    // A cut may stand anywhere.
    if (bool(CAPS)) return verdict > 0 ? min(ahead, 1) : verdict < 0 ? 1 : 0;
    return verdict < 0 ? max(ahead, 1) : ahead;
#else
    return ahead;
#endif
}

bool hasEvent(March at) {
#if CAPS && CLIP_OBJECT
    if (at.measureBegin < 0.0 && at.measureEnd >= 0.0) return true;
#endif
    return at.rankBegin != at.rankEnd && at.rankBegin >= 0 && at.rankEnd >= 0;
}

void toNextStep(inout March at) {
    ++at.step;
    at.begin = at.end;
    at.atBegin = at.atEnd;
    at.rankBegin = at.rankEnd;
    at.atBefore = at.atStep;
    at.atStep = at.atEnd;
#if CAPS && CLIP_OBJECT
    at.measureBegin = at.measureEnd;
#endif
}

void enter(Path path, inout March at) {
    at.entered = true;
    at.step = 0;
    at.begin = chunkBegin(path, at.chunk);
    at.atBegin = sidedTexelAt(path, at.begin);
    at.rankBegin = rankOf(at.atBegin);
    at.atStep = at.atBegin;
    at.atBefore = sidedTexelAt(path, at.begin - path.spacing);
    at.isSplit = false;
#if CAPS && CLIP_OBJECT
    at.measureBegin = keptMeasure(path.clip, at.begin);
#endif
}

// Whether the value may pass a surface and come back within the step: it had been heading for one. (Where a value bends back,
// as on a ridge, it stays on this side of its straight continuation.)
bool isHeadingForSurface(March at) {
    int ahead = rankOf(2.0 * at.atStep - at.atBefore);
    return ahead >= 0 && at.rankBegin >= 0 && at.rankEnd == at.rankBegin && ahead != at.rankBegin;
}

// Splits a step in which the value passes a surface and turns back at a point beyond the surface, found by golden section.
void splitAtTurn(Path path, inout March at) {
    float side = at.atStep > at.atBefore ? 1.0 : -1.0;
    float a = at.begin, b = at.end;
    float turn = a;
    float atTurn = at.atBegin;
    for (int i = 0; i < 8 && at.mayTurn; ++i) {
        float guess = b - turn > turn - a ? mix(turn, b, 0.382) : mix(turn, a, 0.382);
        float texel = sidedTexelAt(path, guess);
        bool better = side * texel > side * atTurn;
        if ((guess > turn) == better) a = better ? turn : guess; else b = better ? turn : guess;
        if (better) { turn = guess; atTurn = texel; }
        int rank = rankOf(atTurn);
        at.isSplit = rank >= 0 && rank != at.rankBegin;
        if (at.isSplit) {
            at.wholeEnd = at.end;
            at.atWholeEnd = at.atEnd;
            at.end = turn;
            at.atEnd = atTurn;
            at.rankEnd = rank;
            break;
        }
    }
}

// To the second part of a split step.
void toRestOfStep(inout March at) {
    at.isSplit = false;
    at.begin = at.end;
    at.atBegin = at.atEnd;
    at.rankBegin = at.rankEnd;
    at.end = at.wholeEnd;
    at.atEnd = at.atWholeEnd;
    at.rankEnd = rankOf(at.atEnd);
}

// Goes on to the next step in which something happens or may happen. All loops and no branches around costly code: where a driver runs
// SIMD groups with masks, code in a branch that no ray takes still costs its time.
bool seekStep(Path path, inout March at) {
    at.mayTurn = false;
    bool found = at.entered && hasEvent(at);
    if (!found && at.isSplit) {
        toRestOfStep(at);
        found = hasEvent(at);
    }
    while (!found && at.chunk < at.chunks) {
        if (at.entered) toNextStep(at);
        int ahead = at.entered ? 0 : 1;
        while (ahead > 0 && at.chunk < at.chunks) {
            ahead = worthEnteringAhead(path, at);
            at.chunk += ahead;
        }
        if (at.chunk < at.chunks && !at.entered) enter(path, at);
        int count = min(CHUNK_SAMPLES, at.steps - at.chunk * CHUNK_SAMPLES);
        while (at.chunk < at.chunks && at.step < count) {
            at.end = min(chunkBegin(path, at.chunk) + float(at.step + 1) * path.spacing, path.span.end);
            at.atEnd = sidedTexelAt(path, at.end);
            at.rankEnd = rankOf(at.atEnd);
#if CAPS && CLIP_OBJECT
            at.measureEnd = keptMeasure(path.clip, at.end);
#endif
            found = hasEvent(at);
            at.mayTurn = !found && isHeadingForSurface(at);
            found = found || at.mayTurn;
            if (found) break;
            toNextStep(at);
        }
        if (!found) {
            at.entered = false;
            ++at.chunk;
        }
    }
    return found;
}

// Goes on to the next step in which something happens.
bool seekEvent(Path path, inout March at) {
    bool found = false;
    bool goesOn = true;
    while (goesOn) {
        found = seekStep(path, at);
        splitAtTurn(path, at);
        goesOn = at.mayTurn && !at.isSplit;
    }
    return found;
}

// Shows the first thing that happens in the step, and takes it off.
void showEvent(inout Light light, Path path, inout March at) {
#if CAPS && CLIP_OBJECT
    bool cut = at.measureBegin < 0.0 && at.measureEnd >= 0.0;
    if (cut) {
        float depth = clipCrossing(at.begin, at.end, at.measureBegin, at.measureEnd);
        showCap(light, path, depth, clipSurfaceNormal(path.clip.origin + depth * path.clip.direction));
        at.measureBegin = 0.0;
        return;
    }
#endif
    bool rising = at.rankEnd > at.rankBegin;
    int surface = rising ? at.rankBegin : at.rankBegin - 1;
    showCrossing(light, path, surface, refinedDepth(path, surfaceTexels[surface].x, at.begin, at.end, at.atBegin, at.atEnd));
    at.rankBegin += rising ? 1 : -1;
}

void march(inout Light light, Path path) {
    March at;
    at.steps = int(ceil((path.span.end - path.span.begin) / path.spacing));
    at.chunks = (at.steps + CHUNK_SAMPLES - 1) / CHUNK_SAMPLES;
    at.chunk = 0;
    at.entered = false;
#if CAPS
    showEntryCap(light, path);
#endif
    at.isSplit = false;
    while (light.transmittance > kOpaque) {
        if (!seekEvent(path, at)) break;
        showEvent(light, path, at);
    }
}
#endif

void main() {
    ivec2 pixel = picturePixel();
    if (any(greaterThanEqual(pixel, targetSize))) return;
    Path path;
    path.ray = cameraRay(vec2(pixel) + 0.5);
    path.span = beforeSolids(keptSpan(path.ray), pixel);
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
