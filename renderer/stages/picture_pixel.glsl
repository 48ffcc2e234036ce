// Which pixel an invocation of an 8x8 group draws, and where the picture goes (stages/banded_dispatch.h).
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f, binding = 0) writeonly uniform image2D target;

uniform ivec2 targetSize;
uniform int firstRow;
uniform int rowStride; // shares no divisor with the number of rows of groups

// Neighbouring invocations draw blocks of 4x2 pixels: SIMD groups of eight then hold rays that lie close together.
ivec2 picturePixel() {
    int index = int(gl_LocalInvocationIndex);
    ivec2 within = ivec2((index & 3) | ((index >> 1) & 4), ((index >> 2) & 1) | ((index >> 3) & 6));
    // A driver may hand each thread one contiguous part of the groups: every part then gets rows from all over the picture.
    int row = int(gl_WorkGroupID.y) * rowStride % int(gl_NumWorkGroups.y);
    return ivec2(gl_WorkGroupID.x, row) * 8 + within + ivec2(0, firstRow);
}
