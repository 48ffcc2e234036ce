// Colours of solids, opaque, for blending under a picture (techniques/overlay/solids_overlay.h).
layout(binding = 16) uniform sampler2D solids;

layout(location = 0) out vec4 colour;

const float kNoSolid = 1e29;

void main() {
    vec4 solid = texelFetch(solids, ivec2(gl_FragCoord.xy), 0);
    if (solid.a > kNoSolid) discard;
    colour = vec4(solid.rgb, 1.0);
}
