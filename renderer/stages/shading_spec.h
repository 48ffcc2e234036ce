// Light and material of a picture (Phong, "Illumination for Computer Generated Pictures", CACM 18(6), 1975).
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace voxsheet {

enum class GradientSource {
    Texture, ///< gradients of all samples, computed once on the GPU
    OnTheFly ///< six taps at each sample that is shaded
};

/// With N the unit normal, turned towards the eye, V the unit direction to the eye and L_i to light i with
/// intensity I_i:
///   colour = rgb (ambient + diffuse sum_i I_i max(0, N.L_i)) + specular sum_i I_i max(0, R_i.V)^shininess
///   (N.L_i > 0 only)
/// with R_i = 2 (N.L_i) N - L_i, each channel at most 1. Where there is no gradient, colour = rgb. The head
/// light shines from the eye: L = V.
struct ShadingSpec {
    bool enabled = false;
    GradientSource gradient = GradientSource::OnTheFly;
    double ambient = 0.25;   ///< [0, 1]
    double diffuse = 0.75;   ///< [0, 1]
    double specular = 0.25;  ///< [0, 1]
    double shininess = 24.0; ///< [1, 1000]
    double headLight = 1.0;  ///< intensity, [0, 1]
    /// Unit directions towards directional lights, in the view frame (x right, y up, z to the eye); at most
    /// kMaxLights.
    std::vector<glm::dvec3> lightsView;
    double lightIntensity = 1.0; ///< of each directional light, [0, 1]

    bool operator==(const ShadingSpec&) const = default;
};

inline constexpr std::size_t kMaxLights = 4;

} // namespace voxsheet
