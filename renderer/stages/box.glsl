// The volume's drawn box in the texture frame.
#include "stages/camera_rays.glsl"

uniform vec3 boxLow;
uniform vec3 boxHigh;

// Depths at which the ray enters and leaves the box, in front of the eye; x >= y when it misses.
vec2 boxSpan(Ray ray) {
    // A ray parallel to a face has no crossing with it: a huge inverse keeps the sign and avoids 0 * infinity.
    vec3 safe = mix(ray.direction, vec3(1e-12), lessThan(abs(ray.direction), vec3(1e-12)));
    vec3 toLow = (boxLow - ray.origin) / safe;
    vec3 toHigh = (boxHigh - ray.origin) / safe;
    vec3 near = min(toLow, toHigh);
    vec3 far = max(toLow, toHigh);
    return vec2(max(max(near.x, near.y), max(near.z, rayNearest)), min(min(far.x, far.y), far.z));
}
