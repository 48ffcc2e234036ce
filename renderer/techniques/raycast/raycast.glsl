// Emission and absorption along one ray per pixel, front to back (techniques/raycast/raycast.h).
//   CHUNK_SAMPLES  samples that one look-up of empty space answers for
//   SKIP_EMPTY     1: stretches that cannot show anything are left out
#include "stages/box.glsl"
#include "stages/classification.glsl"
#include "stages/empty_space.glsl"
#include "stages/opacity.glsl"
#include "stages/picture_pixel.glsl"

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

vec4 composite(Ray ray, vec2 span) {
    float spacing = sampleDistanceVoxels / length(ray.direction * voxelsPerTexture);
    float stretchLength = spacing * ray.radiiPerDepth * unitsPerRadius;
    float stretches = (span.y - span.x) / spacing;
    int whole = int(stretches);
    vec3 stride = spacing * ray.direction;
    vec3 first = ray.origin + (span.x + 0.5 * spacing) * ray.direction;

    vec3 colour = vec3(0.0);
    float transmittance = 1.0;
    int chunks = (whole + CHUNK_SAMPLES - 1) / CHUNK_SAMPLES;
    int chunk = 0;
    while (transmittance > kOpaque) {
        // Every lane of a SIMD group seeks its own next stretch, so that all of them then have samples to take.
        while (chunk < chunks &&
               !mayShow(first + (float(chunk * CHUNK_SAMPLES) + 0.5 * float(CHUNK_SAMPLES - 1)) * stride))
            ++chunk;
        if (chunk >= chunks) break;
        int begin = chunk * CHUNK_SAMPLES;
        for (int k = 0; k < CHUNK_SAMPLES; ++k) {
            vec4 entry = classifyTexel(texelAt(first + float(begin + k) * stride));
            vec4 rgba = overLength(entry, begin + k < whole ? stretchLength : 0.0);
            colour += transmittance * rgba.rgb;
            transmittance *= 1.0 - rgba.a;
        }
        ++chunk;
    }
    // The rest of the path is shorter than a whole stretch: its sample sits in its middle and counts for its length.
    float rest = stretches - float(whole);
    vec4 entry = classifyTexel(texelAt(first + (float(whole) + 0.5 * (rest - 1.0)) * stride));
    vec4 rgba = overLength(entry, rest * stretchLength);
    colour += transmittance * rgba.rgb;
    transmittance *= 1.0 - rgba.a;
    return vec4(colour, 1.0 - transmittance);
}

void main() {
    ivec2 pixel = picturePixel();
    if (any(greaterThanEqual(pixel, targetSize))) return;
    Ray ray = cameraRay(vec2(pixel) + 0.5);
    vec2 span = boxSpan(ray);
    vec4 rgba = span.x < span.y ? composite(ray, span) : vec4(0.0);
    imageStore(target, pixel, rgba);
}
