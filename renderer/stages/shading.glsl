// Light on a sample or a surface (stages/shading_spec.h, stages/shading_stage.h). Needs classification.glsl and kept_span.glsl;
// clip_object.glsl where objects clip.
//   SHADING           1: lit
//   GRADIENT_TEXTURE  1: gradients come from a texture, else from six taps
#include "stages/light.glsl"

#if SHADING
uniform vec4 cutNormals[kMaxClipPlanes];      // of the clip planes, in the view frame
uniform mat3 viewFromGradient;                // from differences per voxel of the drawn level; any scale
uniform vec3 voxelSize;                       // 1 / samples per axis of the drawn level
uniform vec3 gradientPeriodic;                // 1 on axes that wrap

#if GRADIENT_TEXTURE
layout(binding = 4) uniform sampler3D gradients;

vec3 gradientAt(vec3 position) { return textureLod(gradients, position, 0.0).rgb; }
#else
// Central differences over one voxel to both sides; taps do not leave the samples on axes that do not wrap.
vec3 gradientAt(vec3 position) {
    vec3 low = mix(max(position - voxelSize, 0.5 * voxelSize), position - voxelSize, gradientPeriodic);
    vec3 high = mix(min(position + voxelSize, 1.0 - 0.5 * voxelSize), position + voxelSize, gradientPeriodic);
    vec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
        vec3 before = position;
        vec3 after = position;
        before[axis] = low[axis];
        after[axis] = high[axis];
        float distance = (high[axis] - low[axis]) / voxelSize[axis];
        gradient[axis] = distance > 0.0 ? (texelAt(after) - texelAt(before)) / distance : 0.0;
    }
    return gradient;
}
#endif

// Whether a sample at `depth` lies within one voxel behind a cut, and then the cut's normal.
bool cutNormal(Ray ray, KeptSpan span, float depth, float depthPerVoxel,
#if CLIP_OBJECT
               ClipRay clip, bool nearObject,
#endif
               out vec3 normal) {
    normal = vec3(0.0);
#if CLIP_OBJECT
    if (nearObject) {
        float before = max(depth - depthPerVoxel, span.begin);
        float measureBefore = keptMeasure(clip, before);
        if (measureBefore < 0.0) {
            float crossing = clipCrossing(before, depth, measureBefore, max(keptMeasure(clip, depth), 0.0));
            normal = clipSurfaceNormal(clip.origin + crossing * clip.direction);
            return true;
        }
    }
#endif
    if (span.cutPlane < 0 || depth - span.begin > depthPerVoxel) return false;
    normal = cutNormals[max(span.cutPlane, 0)].xyz; // never below 0, but a compiler that knows of no planes (NVIDIA) refuses -1
    return true;
}

// Of a point inside the volume.
vec3 gradientNormal(vec3 position) { return viewFromGradient * gradientAt(position); }

// Of a sample at `depth` inside the volume: the cut's normal within one voxel behind a cut, else the gradient's.
vec3 sampleNormal(Ray ray, KeptSpan span, float depth, float depthPerVoxel
#if CLIP_OBJECT
                  , ClipRay clip, bool nearObject
#endif
) {
    vec3 normal;
#if CLIP_OBJECT
    bool behindCut = cutNormal(ray, span, depth, depthPerVoxel, clip, nearObject, normal);
#else
    bool behindCut = cutNormal(ray, span, depth, depthPerVoxel, normal);
#endif
    return behindCut ? normal : gradientNormal(ray.origin + depth * ray.direction);
}
#endif
