// Rectangles that cover solids in the picture (techniques/overlay/solids_overlay.h).
#include "techniques/overlay/kept_point.glsl"

struct Solid { // techniques/overlay/crystal_solids.h
    vec4 start;
    vec4 end;
    vec4 startColour;
    vec4 endColour;
};
layout(std430, binding = 0) readonly buffer Solids { Solid solids[]; };

uniform mat3 viewFromSolid;
uniform vec2 centreInView; // of the box
uniform vec2 pictureHalf;  // picture coordinates of the right and the upper edge
uniform float lineRadius;

// In the view: x right, y up, z away from the eye, from the depth of the box's centre on, bounding radii.
flat out vec4 capsuleStart; // w: radius
flat out vec4 capsuleEnd;   // w: 1 for lines, 2 for those of the crosshair
flat out vec3 startColour;
flat out vec3 endColour;

const float kSlack = 1.0001;

struct Bounds {
    vec2 low; // picture coordinates
    vec2 high;
    bool seen; // some of it lies before the eye
};

// Of the picture of a sphere: tangents from the eye, axis by axis (Mara & McGuire 2013).
Bounds boundsOf(vec3 centre, float radius) {
    if (rayLengthPerspective == 0.0) return Bounds(centre.xy - radius, centre.xy + radius, true);
    float ahead = centre.z - rayNearest;
    if (ahead <= 1.001 * radius) return Bounds(-pictureHalf, pictureHalf, ahead > -radius);
    float square = ahead * ahead - radius * radius;
    vec2 middle = centre.xy * ahead;
    vec2 reach = radius * sqrt(centre.xy * centre.xy + square);
    return Bounds((middle - reach) / square, (middle + reach) / square, true);
}

// A corner of the rectangle along the line between the middles of two others that holds both.
vec2 cornerOver(Bounds a, Bounds b, vec2 side) {
    vec2 between = 0.5 * (b.low + b.high - a.low - a.high);
    vec2 along = dot(between, between) > 1e-12 ? normalize(between) : vec2(1.0, 0.0);
    vec2 across = vec2(-along.y, along.x);
    vec2 least = vec2(1e30);
    vec2 most = vec2(-1e30);
    for (int i = 0; i < 8; ++i) {
        vec2 low = i < 4 ? a.low : b.low;
        vec2 high = i < 4 ? a.high : b.high;
        vec2 corner = vec2((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y);
        vec2 at = vec2(dot(corner, along), dot(corner, across));
        least = min(least, at);
        most = max(most, at);
    }
    vec2 middle = 0.5 * (least + most);
    vec2 at = middle + (0.5 * kSlack * side) * (most - least);
    return at.x * along + at.y * across;
}

void main() {
    Solid solid = solids[gl_InstanceID];
    float radius = solid.end.w > 0.5 ? solid.end.w * lineRadius : solid.start.w;
    capsuleStart = vec4(viewFromSolid * solid.start.xyz + vec3(centreInView, 0.0), radius);
    capsuleEnd = vec4(viewFromSolid * solid.end.xyz + vec3(centreInView, 0.0), solid.end.w);
    startColour = solid.startColour.rgb;
    endColour = solid.endColour.rgb;
    Bounds start = boundsOf(capsuleStart.xyz, radius);
    Bounds end = boundsOf(capsuleEnd.xyz, radius);
    // What reaches to the eye or behind it may be seen anywhere.
    bool shown = start.seen || end.seen;
    if (start.seen != end.seen) start = end = Bounds(-pictureHalf, pictureHalf, true);
    // Lines are clipped point by point.
    if (solid.end.w < 0.5) shown = shown && isKept(solid.start.xyz, solid.startColour.w) && isKept(solid.end.xyz, solid.endColour.w);
    vec2 side = vec2((gl_VertexID & 1) != 0 ? 1.0 : -1.0, (gl_VertexID & 2) != 0 ? 1.0 : -1.0);
    vec2 corner = cornerOver(start, end, side) / pictureHalf;
    gl_Position = shown ? vec4(corner, 0.0, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
