// Rays of pixels in the texture frame (stages/ray_frame.h). The parameter of a ray is the view depth beyond the plane through
// the box's centre, in bounding radii.
uniform vec4 pictureOfPixel; // q = pixel * xy + zw
uniform vec3 rayOrigin;
uniform vec3 rayOriginX;
uniform vec3 rayOriginY;
uniform vec3 rayDirection;
uniform vec3 rayDirectionX;
uniform vec3 rayDirectionY;
uniform float rayNearest;           // depth of the eye
uniform float rayLengthPerspective; // 1 perspective, 0 orthographic

struct Ray {
    vec3 origin;
    vec3 direction;
    float radiiPerDepth; // world length of a unit of depth along this ray, in bounding radii
    vec3 toEye;          // unit direction from any of its points to the eye, in the view frame
};

// `pixel` in pixels from the lower left corner of the picture; centres at halves.
Ray cameraRay(vec2 pixel) {
    vec2 q = pixel * pictureOfPixel.xy + pictureOfPixel.zw;
    Ray ray;
    ray.origin = rayOrigin + q.x * rayOriginX + q.y * rayOriginY;
    ray.direction = rayDirection + q.x * rayDirectionX + q.y * rayDirectionY;
    ray.radiiPerDepth = sqrt(1.0 + rayLengthPerspective * dot(q, q));
    ray.toEye = vec3(-rayLengthPerspective * q, 1.0) / ray.radiiPerDepth;
    return ray;
}
