// Light on a surface of known normal (stages/shading_spec.h).
//   SHADING  1: lit
//   LIGHTS   directional lights
#if SHADING
uniform vec4 material; // ambient, diffuse, specular, shininess
uniform float headLight;
const int kMaxLights = 4;
uniform vec4 lights[kMaxLights]; // unit directions towards them in the view frame; w: intensity

// What a light of unit intensity adds; `facing` is the cosine between normal and light, `mirrored` that between the mirrored light
// and the eye.
vec3 reflected(vec3 rgb, float facing, float mirrored) {
    return material.y * facing * rgb + material.z * pow(max(mirrored, 0.0), material.w);
}

// `normal` in the view frame, of any length and sign; where it has none, the colour stays.
vec3 lit(vec3 rgb, vec3 normal, vec3 toEye) {
    float square = dot(normal, normal);
    float towardsEye = dot(normal, toEye);
    vec3 unit = normal * (towardsEye < 0.0 ? -inversesqrt(square) : inversesqrt(square));
    float facing = abs(towardsEye) * inversesqrt(square);
    vec3 colour = material.x * rgb + headLight * reflected(rgb, facing, 2.0 * facing * facing - 1.0);
#if LIGHTS
    for (int i = 0; i < LIGHTS; ++i) {
        float towards = dot(unit, lights[i].xyz);
        vec3 more = reflected(rgb, towards, 2.0 * towards * facing - dot(lights[i].xyz, toEye));
        colour += towards > 0.0 ? lights[i].w * more : vec3(0.0);
    }
#endif
    return square > 0.0 ? min(colour, 1.0) : rgb;
}
#endif
