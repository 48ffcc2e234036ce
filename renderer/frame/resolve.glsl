#version 450 core
// From what a technique drew (premultiplied, no background, bottom row first) to what a client gets: background blended in,
// top row first, packed. Blending is in display sRGB, as the techniques composite.
layout(local_size_x = 16, local_size_y = 16) in;

layout(binding = 0) uniform sampler2D drawn;

#ifdef PACK_RGBA8
layout(std430, binding = 0) writeonly buffer Packed { uint packedPixels[]; };
#else
layout(std430, binding = 0) writeonly buffer Packed { vec4 packedPixels[]; };
#endif

uniform ivec2 sizePixels;
uniform ivec2 rows;      // this dispatch: rows [rows.x, rows.y) from the top; the buffer's range begins at rows.x
uniform vec4 background; // premultiplied

void main() {
    ivec2 fromTop = ivec2(gl_GlobalInvocationID.xy) + ivec2(0, rows.x);
    if (fromTop.x >= sizePixels.x || fromTop.y >= rows.y) return;
    vec4 colour = texelFetch(drawn, ivec2(fromTop.x, sizePixels.y - 1 - fromTop.y), 0);
    colour += (1.0 - colour.a) * background;
    int index = (fromTop.y - rows.x) * sizePixels.x + fromTop.x;
#ifdef PACK_RGBA8
    packedPixels[index] = packUnorm4x8(colour);
#else
    packedPixels[index] = colour;
#endif
}
