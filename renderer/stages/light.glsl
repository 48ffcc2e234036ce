// Light on a surface of known normal (stages/shading_spec.h).
//   SHADING  1: lit
//   LIGHTS   directional lights
#if SHADING
uniform vec4 material; // ambient, diffuse, specular, shininess
uniform float headLight;
const int kMaxLights = 4;
uniform vec4 lights[kMaxLights]; // unit directions towards them in the view frame; w: intensity

// What light makes of a colour: min(matte rgb + shine, 1).
struct Reflection {
    float matte;
    float shine;
};

vec3 reflected(Reflection reflection, vec3 rgb) { return min(reflection.matte * rgb + reflection.shine, 1.0); }

// What a light of unit intensity adds; `facing` is the cosine between normal and light, `mirrored` that between the mirrored light
// and the eye.
Reflection reflectionOfOne(float facing, float mirrored) {
    return Reflection(material.y * facing, material.z * pow(max(mirrored, 0.0), material.w));
}

void add(inout Reflection sum, float intensity, Reflection more) {
    sum.matte += intensity * more.matte;
    sum.shine += intensity * more.shine;
}

// `normal` in the view frame, of any length and sign; where it has none, colours stay.
Reflection reflectionOf(vec3 normal, vec3 toEye) {
    float square = dot(normal, normal);
    float towardsEye = dot(normal, toEye);
    vec3 unit = normal * (towardsEye < 0.0 ? -inversesqrt(square) : inversesqrt(square));
    float facing = abs(towardsEye) * inversesqrt(square);
    Reflection sum = Reflection(material.x, 0.0);
    add(sum, headLight, reflectionOfOne(facing, 2.0 * facing * facing - 1.0));
#if LIGHTS
    for (int i = 0; i < LIGHTS; ++i) {
        float towards = dot(unit, lights[i].xyz);
        Reflection more = reflectionOfOne(towards, 2.0 * towards * facing - dot(lights[i].xyz, toEye));
        if (towards > 0.0) add(sum, lights[i].w, more);
    }
#endif
    if (square > 0.0) return sum;
    return Reflection(1.0, 0.0);
}

vec3 lit(vec3 rgb, vec3 normal, vec3 toEye) { return reflected(reflectionOf(normal, toEye), rgb); }
#endif
