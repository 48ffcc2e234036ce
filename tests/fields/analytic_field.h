// Scalar fields with known values, gradients and line integrals, over the cube [-1, 1]^3.
#pragma once

#include <glm/glm.hpp>

#include <functional>
#include <string>

namespace voxsheet::fields {

struct AnalyticField {
    std::string name;
    double low = 0.0; ///< bounds of the value over the cube
    double high = 1.0;
    std::function<double(const glm::dvec3&)> value;
    std::function<glm::dvec3(const glm::dvec3&)> gradient;
    /// Integral of the value over the segment from a to b, by length; empty when there is no closed form.
    std::function<double(const glm::dvec3& a, const glm::dvec3& b)> lineIntegral;
};

/// value = 1/2 + dot(slope, p).
[[nodiscard]] AnalyticField linearRamp(const glm::dvec3& slope = {0.2, 0.15, 0.1});

/// Distance from the sphere of this radius about the centre, negative inside.
[[nodiscard]] AnalyticField sphereDistance(double radius = 0.7);

/// Distance from the tube of radius `tube` about the circle of this radius around the z axis, negative
/// inside.
[[nodiscard]] AnalyticField torusDistance(double radius = 0.6, double tube = 0.25);

/// Marschner & Lobb, "An Evaluation of Reconstruction Filters for Volume Rendering", Visualization 1994,
/// section 4:
///   rho = (1 - sin(pi z / 2) + alpha (1 + cos(2 pi f cos(pi r / 2)))) / (2 (1 + alpha)), r = |(x, y)|
/// with f = 6 and alpha = 0.25 in the paper; they sample it at 40^3.
[[nodiscard]] AnalyticField marschnerLobb(double frequency = 6.0, double alpha = 0.25);

/// Sum of eight Gaussians of widths 0.12 to 0.3 inside the cube.
[[nodiscard]] AnalyticField gaussianSum();

} // namespace voxsheet::fields
