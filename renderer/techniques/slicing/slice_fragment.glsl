// One sample of one slice (techniques/slicing/slicing.h). The position comes from the pixel's ray and not from interpolated
// texture coordinates, which rasterisers keep in fewer bits.
#include "stages/camera_rays.glsl"
#include "stages/classification.glsl"
#include "stages/opacity.glsl"

flat in float sliceDepth;
layout(location = 0) out vec4 colour;

uniform float exponentPerRadius; // (distance of planes) / unitLength

void main() {
    Ray ray = cameraRay(gl_FragCoord.xy);
    vec4 entry = classifyTexel(texelAt(ray.origin + sliceDepth * ray.direction));
    colour = overStretch(entry, ray.radiiPerDepth * exponentPerRadius);
}
