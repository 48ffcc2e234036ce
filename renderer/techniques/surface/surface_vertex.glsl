// Corners of faces (techniques/surface/surface.cpp).
layout(location = 0) in vec4 position;
layout(location = 1) in float faceIndex;

flat out int face;

void main() {
    face = int(faceIndex);
    gl_Position = position;
}
