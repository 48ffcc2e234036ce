// What a pixel of a face shows (techniques/surface/surface.h).
#include "stages/kept_span.glsl"
#include "stages/classification.glsl"
#include "stages/solids.glsl"
#include "stages/clip_object.glsl"
#include "stages/shading.glsl"

flat in int face;
layout(location = 0) out vec4 colour;

const int kMaxFaces = 22; // six of the box and those of the clip planes
uniform vec4 facePlanes[kMaxFaces];  // texture frame: dot(xyz, p) + w = 0
uniform vec4 faceNormals[kMaxFaces]; // view frame
uniform vec3 voxelsPerTexture;       // texels of the drawn level per axis
uniform float sampleDistanceVoxels;
uniform bool eyeInside;
uniform vec4 nanColour; // not premultiplied

float depthOnFace(Ray ray) {
    vec4 plane = facePlanes[face];
    return -(dot(plane.xyz, ray.origin) + plane.w) / dot(plane.xyz, ray.direction);
}

#if CLIP_OBJECT
// The first point from `begin` on where the ray comes into what the object keeps, or -1e30.
float firstEntry(ClipRay clip, float begin, float end, float step) {
    float near = begin;
    float measureNear = keptMeasure(clip, near);
    float far = begin;
    float measureFar = measureNear;
    bool found = false;
    while (!found && near < end) {
        // Distances say how far nothing can change.
        float safe = measureNear < 0.0 ? (-measureNear - nearestSampleSlack) / (1.1 * clip.lengthPerDepth) : 0.0;
        far = min(near + max(step, safe), end);
        measureFar = keptMeasure(clip, far);
        found = measureNear < 0.0 && measureFar >= 0.0;
        if (found) break;
        near = far;
        measureNear = measureFar;
    }
    if (!found) return -1e30;
#if CLIP_OBJECT == 2
    // The face of a voxel, to 1/64 of a step.
    for (int i = 0; i < 6; ++i) {
        float middle = 0.5 * (near + far);
        if (keptMeasure(clip, middle) >= 0.0) far = middle; else near = middle;
    }
    return far;
#else
    return clipCrossing(near, far, measureNear, measureFar);
#endif
}
#endif

void main() {
    colour = vec4(0.0);
    Ray ray = cameraRay(gl_FragCoord.xy);
    float onFace = depthOnFace(ray);
    float depth = onFace;
    vec3 normal = faceNormals[face].xyz;
#if CLIP_OBJECT
    ClipRay clip = clipRayOf(ray);
    KeptSpan span = keptSpan(ray);
    float begin = eyeInside ? rayNearest : onFace;
    float end = eyeInside ? onFace : max(span.end, onFace);
    float step = min(sampleDistanceVoxels, 1.0) / length(ray.direction * voxelsPerTexture);
    if (eyeInside || keptMeasure(clip, onFace) < 0.0) {
        float entry = firstEntry(clip, begin, end, step);
        if (entry > -1e29) {
            depth = entry;
            normal = clipSurfaceNormal(clip.origin + depth * clip.direction);
        } else if (!eyeInside || keptMeasure(clip, onFace) < 0.0) {
            discard;
        }
    }
#endif
    if (solidDepth(ivec2(gl_FragCoord.xy)) < depth) return; // the solid goes under
    float texel = texelAt(ray.origin + depth * ray.direction);
    if (isnan(texel)) {
        colour = vec4(nanColour.rgb * nanColour.a, nanColour.a);
        return;
    }
    vec3 rgb = classifyTexel(texel).rgb;
#if SHADING
    rgb = lit(rgb, normal, ray.toEye);
#endif
    colour = vec4(rgb, 1.0);
}
