// Which pixel an invocation of an 8x8 group draws, and where the picture goes (stages/banded_dispatch.h).
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f, binding = 0) writeonly uniform image2D target;

uniform ivec2 targetSize;
uniform int firstRow;

// Neighbouring invocations draw blocks of 4x2 pixels: SIMD groups of eight then hold rays that lie close together.
ivec2 picturePixel() {
    int index = int(gl_LocalInvocationIndex);
    ivec2 within = ivec2((index & 3) | ((index >> 1) & 4), ((index >> 2) & 1) | ((index >> 3) & 6));
    return ivec2(gl_WorkGroupID.xy) * 8 + within + ivec2(0, firstRow);
}
