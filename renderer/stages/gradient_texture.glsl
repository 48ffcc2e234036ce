// Central differences at every sample of a volume (stages/shading_stage.h).
layout(local_size_x = 8, local_size_y = 8, local_size_z = 4) in;
layout(binding = 0) uniform sampler3D volume;
layout(rgba16f, binding = 0) writeonly uniform image3D gradients;

uniform ivec3 periodic; // 1 on axes that wrap
uniform float scale;
uniform int firstSlice;
uniform int endSlice;

float difference(ivec3 at, int axis, ivec3 size) {
    ivec3 before = at;
    ivec3 after = at;
    before[axis] = periodic[axis] != 0 ? (at[axis] + size[axis] - 1) % size[axis] : max(at[axis] - 1, 0);
    after[axis] = periodic[axis] != 0 ? (at[axis] + 1) % size[axis] : min(at[axis] + 1, size[axis] - 1);
    int distance = periodic[axis] != 0 ? 2 : after[axis] - before[axis];
    return distance == 0 ? 0.0 : (texelFetch(volume, after, 0).r - texelFetch(volume, before, 0).r) / float(distance);
}

void main() {
    ivec3 size = textureSize(volume, 0);
    ivec3 at = ivec3(gl_GlobalInvocationID) + ivec3(0, 0, firstSlice);
    if (any(greaterThanEqual(at, size)) || at.z >= endSlice) return;
    vec3 gradient = vec3(difference(at, 0, size), difference(at, 1, size), difference(at, 2, size));
    imageStore(gradients, at, vec4(scale * gradient, 0.0));
}
