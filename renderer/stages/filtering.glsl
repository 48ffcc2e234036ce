// Samples by the shader itself: trilinear, for drivers that do not filter 32-bit float textures, or the nearest one.

// Index of a sample beyond the ends: wrapped on periodic axes, else the nearest.
ivec3 sampleInside(ivec3 index, ivec3 size, vec3 periodic) {
    // The half keeps a division that is a little off away from whole numbers.
    ivec3 wrapped = index - size * ivec3(floor((vec3(index) + 0.5) / vec3(size)));
    return ivec3(mix(vec3(clamp(index, ivec3(0), size - 1)), vec3(wrapped), periodic));
}

// Of the voxel that holds the position. A point half-way between two samples must not fall to either by rounding, or the
// picture speckles.
float nearestTexel(sampler3D samples, vec3 position, vec3 periodic) {
    const float towardsHigher = 1.0 / 1024.0;
    ivec3 size = textureSize(samples, 0);
    return texelFetch(samples, sampleInside(ivec3(floor(position * vec3(size) + towardsHigher)), size, periodic), 0).r;
}

float filteredTexel(sampler3D samples, vec3 position, vec3 periodic) {
    ivec3 size = textureSize(samples, 0);
    vec3 index = position * vec3(size) - 0.5;
    vec3 base = floor(index);
    vec3 weight = index - base;
    ivec3 low = sampleInside(ivec3(base), size, periodic);
    ivec3 high = sampleInside(ivec3(base) + 1, size, periodic);
    float corner[8];
    for (int i = 0; i < 8; ++i)
        corner[i] = texelFetch(samples, ivec3((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z), 0).r;
    vec4 alongX = mix(vec4(corner[0], corner[2], corner[4], corner[6]), vec4(corner[1], corner[3], corner[5], corner[7]), weight.x);
    vec2 alongY = mix(alongX.xz, alongX.yw, weight.y);
    return mix(alongY.x, alongY.y, weight.z);
}

// As GPUs filter: a sample's weight along an axis is a multiple of 1/256.
float coarselyFilteredTexel(sampler3D samples, vec3 position, vec3 periodic) {
    vec3 size = vec3(textureSize(samples, 0));
    vec3 index = position * size - 0.5;
    vec3 coarse = floor(index * 256.0 + 0.5) / 256.0;
    return filteredTexel(samples, (coarse + 0.5) / size, periodic);
}
