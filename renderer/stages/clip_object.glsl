// What a clip object leaves of a ray (stages/clip_stage.h). Needs camera_rays.glsl.
//   CLIP_OBJECT  0 none, 1 by distance, 2 by the sign of the nearest sample
//   CLIP_FILTER  1: the shader interpolates distances itself
#include "stages/filtering.glsl"

#if CLIP_OBJECT
layout(binding = 3) uniform sampler3D clipDistances;

uniform mat4 clipFromTexture;    // texture frame of the volume to that of the distances
uniform mat3 objectFromTexture;  // to the world of the distances; its linear part
uniform vec2 measureFromTexel;   // measure = texel * x + y: a distance, >= 0 where the volume is kept
uniform float nearestSampleSlack; // how far interpolants, or nearest samples, may differ from true distances, twice
uniform mat3 viewFromClipGradient;
uniform vec3 clipTexelSize; // 1 / samples per axis
uniform vec3 clipKeptLow; // nothing is kept outside of this box in the frame of the distances
uniform vec3 clipKeptHigh;

// How much an interpolated distance can change over a length: true distances change by at most that length, and an
// interpolant lies within a sample's spacing of them; computed distances are allowed a tenth more.
float largestChange(float length) { return min(1.1 * length + nearestSampleSlack, 1.7321 * length); }

// The ray in the frame of the distances.
struct ClipRay {
    vec3 origin;
    vec3 direction;
    float lengthPerDepth; // in units of the distances
};

ClipRay clipRayOf(Ray ray) {
    return ClipRay((clipFromTexture * vec4(ray.origin, 1.0)).xyz, mat3(clipFromTexture) * ray.direction,
                   length(objectFromTexture * ray.direction));
}

float distanceTexel(vec3 position) {
#if CLIP_OBJECT == 2
    ivec3 size = textureSize(clipDistances, 0);
    return texelFetch(clipDistances, clamp(ivec3(floor(position * vec3(size))), ivec3(0), size - 1), 0).r;
#elif CLIP_FILTER
    return filteredTexel(clipDistances, position, vec3(0.0));
#else
    return textureLod(clipDistances, position, 0.0).r;
#endif
}

float keptMeasure(ClipRay ray, float depth) {
    return distanceTexel(ray.origin + depth * ray.direction) * measureFromTexel.x + measureFromTexel.y;
}

// The depths between which all lies that is kept; x > y: nothing.
vec2 clipKeptSpan(ClipRay ray) {
    vec3 safe = mix(ray.direction, vec3(1e-12), lessThan(abs(ray.direction), vec3(1e-12)));
    vec3 toLow = (clipKeptLow - ray.origin) / safe;
    vec3 toHigh = (clipKeptHigh - ray.origin) / safe;
    vec3 near = min(toLow, toHigh);
    vec3 far = max(toLow, toHigh);
    return vec2(max(near.x, max(near.y, near.z)), min(far.x, min(far.y, far.z)));
}

// For all depths of [begin, end] at once, with one look-up: 1 kept, -1 removed, 0 not known.
int clipVerdict(ClipRay ray, float begin, float end) {
    float measure = keptMeasure(ray, 0.5 * (begin + end));
    float reach = largestChange(0.5 * (end - begin) * ray.lengthPerDepth);
    return measure > reach ? 1 : measure < -reach ? -1 : 0;
}

// The same, for a ray that goes on: what is removed for longer is said by `removedUntil` >= end, the depth up to which it is.
int clipVerdict(ClipRay ray, float begin, float end, out float removedUntil) {
    float middle = 0.5 * (begin + end);
    float measure = keptMeasure(ray, middle);
    float reach = largestChange((end - middle) * ray.lengthPerDepth);
    removedUntil = middle + max((-measure - nearestSampleSlack) / 1.1, -measure / 1.7321) / ray.lengthPerDepth;
    return measure > reach ? 1 : measure < -reach ? -1 : 0;
}

// Where the measure, linear from depth `begin` to `end`, is 0; its signs there differ.
float clipCrossing(float begin, float end, float measureBegin, float measureEnd) {
    return begin + (end - begin) * clamp(measureBegin / (measureBegin - measureEnd), 0.0, 1.0);
}

// The kept part of the stretch [begin, end]; empty: x == y.
vec2 keptPart(float begin, float end, float measureBegin, float measureEnd) {
    bool first = measureBegin >= 0.0;
    bool last = measureEnd >= 0.0;
    if (first == last) return first ? vec2(begin, end) : vec2(begin);
    float crossing = clipCrossing(begin, end, measureBegin, measureEnd);
    return first ? vec2(begin, crossing) : vec2(crossing, end);
}

// Normal of the object's surface, in the view frame, of any length.
vec3 clipSurfaceNormal(vec3 position) {
    vec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
        vec3 step = vec3(0.0);
        step[axis] = clipTexelSize[axis];
#if CLIP_FILTER
        gradient[axis] = filteredTexel(clipDistances, position + step, vec3(0.0)) - filteredTexel(clipDistances, position - step, vec3(0.0));
#else
        gradient[axis] = textureLod(clipDistances, position + step, 0.0).r - textureLod(clipDistances, position - step, 0.0).r;
#endif
    }
    return viewFromClipGradient * gradient;
}
#endif
