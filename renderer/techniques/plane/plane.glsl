// The volume's values where a plane cuts it (techniques/plane/plane.h).
//   NEAREST     1: of the voxel that holds the point; 0: trilinear
//   CATEGORIES  1: clear where the table is
#include "stages/classification.glsl"
#include "stages/kept_span.glsl"
#include "stages/layers.glsl"
#include "stages/picture_pixel.glsl"
#include "stages/solids.glsl"

uniform float planeSeen;  // 0: edge-on
uniform vec3 planeOrigin; // texture frame; as planeRight and planeUp, which are per unit of picture coordinates
uniform vec3 planeRight;
uniform vec3 planeUp;
uniform vec4 nanColour;    // not premultiplied

const float kFaceSlack = 1e-5;

float texelOnPlane(vec3 position) {
#if NEAREST
    return nearestTexel(volume, position, filterPeriodic);
#else
    return texelAt(position);
#endif
}

vec4 ownColour(vec3 position) {
    float texel = texelOnPlane(position);
#if MAY_BE_NAN
    if (isnan(texel)) return vec4(nanColour.rgb * nanColour.a, nanColour.a);
#endif
    vec4 entry = classifyTexel(texel);
#if CATEGORIES
    if (entry.a <= 0.0) return vec4(0.0);
#endif
    return vec4(entry.rgb, 1.0);
}

vec4 colourAt(vec3 position) {
    bool outside = any(lessThan(position, boxLow - kFaceSlack)) || any(greaterThan(position, boxHigh + kFaceSlack));
    if (outside || planeSeen == 0.0) return vec4(0.0);
    vec4 colour = ownColour(position);
#if LAYERS
    paintLayers(colour, position);
#endif
    return colour;
}

void main() {
    ivec2 pixel = picturePixel();
    if (any(greaterThanEqual(pixel, targetSize))) return;
    vec2 q = (vec2(pixel) + 0.5) * pictureOfPixel.xy + pictureOfPixel.zw;
    // Solids are cut by the plane, too, and go under the picture.
    bool solid = solidDepth(pixel) < kNoSolid;
    imageStore(target, pixel, solid ? vec4(0.0) : colourAt(planeOrigin + q.x * planeRight + q.y * planeUp));
}
