// Where a pixel's ray meets a solid (techniques/overlay/solids_overlay.h).
//   FLAT_CUT  1: where a plane passes through it
#include "techniques/overlay/kept_point.glsl"
#include "stages/light.glsl"

flat in vec4 capsuleStart; // as solid_vertex.glsl gives them
flat in vec4 capsuleEnd;
flat in vec3 startColour;
flat in vec3 endColour;

layout(location = 0) out vec4 solid; // lit rgb, depth on the ray

uniform mat3 viewFromSolid;
uniform vec2 centreInView;
uniform vec4 cutPlane; // dot(xyz, p) = w

const float kMiss = 1e30;
const float kParallel = 1e-10;
const float kEdgeCosine = 0.7; // its outer thirds
const float kEdgeShade = 0.25;

struct ViewRay {
    vec3 origin; // at the depth of the box's centre
    vec3 direction;
    float nearest; // depth of the eye
};

ViewRay viewRay(vec2 q) {
    bool perspective = rayLengthPerspective > 0.5;
    return ViewRay(vec3(perspective ? -rayNearest * q : q, 0.0), vec3(rayLengthPerspective * q, 1.0), perspective ? rayNearest : -kMiss);
}

// Both ends of the ray's way through a sphere. Distances are taken from the point of the ray that is next to the centre: they are
// small there, and their differences exact.
vec2 throughSphere(ViewRay ray, vec3 centre, float radius) {
    float square = dot(ray.direction, ray.direction);
    vec3 toCentre = centre - ray.origin;
    float middle = dot(toCentre, ray.direction) / square;
    vec3 away = middle * ray.direction - toCentre;
    float inside = radius * radius - dot(away, away);
    if (inside < 0.0) return vec2(kMiss);
    float halfWay = sqrt(inside / square);
    return vec2(middle - halfWay, middle + halfWay);
}

// Of a sphere around the eye its inner wall is seen.
float sphereDepth(ViewRay ray, vec3 centre, float radius) {
    vec2 ends = throughSphere(ray, centre, radius);
    return ends.x > ray.nearest ? ends.x : ends.y > ray.nearest ? ends.y : kMiss;
}

// Where the ray comes into the tube between two points; their ends are left to spheres.
float tubeDepth(ViewRay ray, vec3 start, vec3 end, float radius) {
    vec3 axis = end - start;
    float extent = length(axis);
    if (extent < 1e-7) return kMiss;
    axis /= extent;
    vec3 crossed = cross(ray.direction, axis);
    float square = dot(crossed, crossed);
    if (square < kParallel) return kMiss;
    vec3 middle = 0.5 * (start + end);
    float next = dot(middle - ray.origin, ray.direction) / dot(ray.direction, ray.direction);
    vec3 from = ray.origin + next * ray.direction - middle;
    float apart = dot(from, crossed);
    float inside = radius * radius - apart * apart / square;
    if (inside < 0.0) return kMiss;
    // `from` is at right angles to the ray.
    float entry = dot(from, axis) * dot(ray.direction, axis) / square - sqrt(inside / square);
    float along = dot(from, axis) + entry * dot(ray.direction, axis);
    float depth = next + entry;
    return abs(along) <= 0.5 * extent && depth > ray.nearest ? depth : kMiss;
}

// The point of the capsule's segment next to a point, as a part of its length.
float partAlong(vec3 point) {
    vec3 axis = capsuleEnd.xyz - capsuleStart.xyz;
    float square = dot(axis, axis);
    return square > 0.0 ? clamp(dot(point - capsuleStart.xyz, axis) / square, 0.0, 1.0) : 0.0;
}

// Cosine of the angle between a line's surface and the eye, seen along the line: 1 in its middle, 0 at its edges,
// however it slants.
float acrossLine(vec3 outwards, vec3 toEye) {
    vec3 alongAway = capsuleEnd.xyz - capsuleStart.xyz;
    vec3 along = normalize(vec3(alongAway.xy, -alongAway.z));
    return dot(normalize(outwards), normalize(toEye - dot(toEye, along) * along));
}

void main() {
    ViewRay ray = viewRay(gl_FragCoord.xy * pictureOfPixel.xy + pictureOfPixel.zw);
    float radius = capsuleStart.w;
    bool line = capsuleEnd.w > 0.5;
#if FLAT_CUT
    float depth = (cutPlane.w - dot(cutPlane.xyz, ray.origin)) / dot(cutPlane.xyz, ray.direction);
#else
    float depth = min(sphereDepth(ray, capsuleStart.xyz, radius), sphereDepth(ray, capsuleEnd.xyz, radius));
    depth = min(depth, tubeDepth(ray, capsuleStart.xyz, capsuleEnd.xyz, radius));
    if (depth >= kMiss) discard;
#endif
    vec3 point = ray.origin + depth * ray.direction;
    float part = partAlong(point);
    vec3 normal = point - mix(capsuleStart.xyz, capsuleEnd.xyz, part);
    vec3 rgb = part < 0.5 ? startColour : endColour;
#if FLAT_CUT
    float nearness = length(normal) / radius;
    if (!(nearness <= 1.0)) discard;
    gl_FragDepth = (line ? 0.0 : 0.5) + 0.25 * nearness;
#else
    bool crosshair = capsuleEnd.w > 1.5;
    if (line && !crosshair && !isKept(transpose(viewFromSolid) * (point - vec3(centreInView, 0.0)), 0.0)) discard;
    vec2 q = gl_FragCoord.xy * pictureOfPixel.xy + pictureOfPixel.zw;
    vec3 toEye = normalize(vec3(-rayLengthPerspective * q, 1.0));
    vec3 outwards = vec3(normal.xy, -normal.z);
    if (!line) rgb = lit(rgb, outwards, toEye);
    // Dark edges, so that it is seen before bright volumes, too.
    if (crosshair && acrossLine(outwards, toEye) < kEdgeCosine) rgb *= kEdgeShade;
    gl_FragDepth = clamp(0.5 + depth / 16.0, 0.0, 1.0);
#endif
    solid = vec4(rgb, depth);
}
