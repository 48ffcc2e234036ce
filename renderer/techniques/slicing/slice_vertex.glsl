// Corners of polygons, already projected (techniques/slicing/slicing.cpp).
layout(location = 0) in vec3 corner; // normalised device x, y and the depth where the polygon's first slab begins

flat out float firstDepth;

void main() {
    firstDepth = corner.z;
    gl_Position = vec4(corner.xy, 0.0, 1.0);
}
