// Corners of slices, already projected (techniques/slicing/slicing.cpp).
layout(location = 0) in vec3 corner; // normalised device x, y and the slice's depth

flat out float sliceDepth;

void main() {
    sliceDepth = corner.z;
    gl_Position = vec4(corner.xy, 0.0, 1.0);
}
