#include "fields/analytic_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace voxsheet::fields {
namespace {

constexpr double pi = std::numbers::pi;

struct Gaussian {
    glm::dvec3 centre;
    double width;
    double height;
};

constexpr std::array<Gaussian, 8> kGaussians{{{{-0.45, -0.40, -0.35}, 0.22, 0.9},
                                              {{0.40, -0.35, -0.30}, 0.18, 0.7},
                                              {{-0.30, 0.45, -0.20}, 0.16, 1.0},
                                              {{0.35, 0.40, -0.45}, 0.25, 0.5},
                                              {{-0.40, -0.30, 0.45}, 0.30, 0.4},
                                              {{0.45, -0.45, 0.40}, 0.14, 1.0},
                                              {{-0.35, 0.35, 0.40}, 0.20, 0.8},
                                              {{0.10, 0.05, 0.05}, 0.12, 0.6}}};

double gaussianValue(const Gaussian& gaussian, const glm::dvec3& p) {
    const auto d = p - gaussian.centre;
    return gaussian.height * std::exp(-glm::dot(d, d) / (2.0 * gaussian.width * gaussian.width));
}

/// With s along the segment: exp(-(s - s0)^2 / 2w^2) times the falloff of the line's distance; integrates to
/// erf.
double gaussianLineIntegral(const Gaussian& gaussian, const glm::dvec3& a, const glm::dvec3& b) {
    const double length = glm::distance(a, b);
    const auto direction = (b - a) / length;
    const double nearest = glm::dot(gaussian.centre - a, direction);
    const auto closest = a + nearest * direction;
    const double root = gaussian.width * std::sqrt(2.0);
    return gaussianValue(gaussian, closest) * root * std::sqrt(pi) * 0.5 *
           (std::erf((length - nearest) / root) - std::erf(-nearest / root));
}

} // namespace

AnalyticField linearRamp(const glm::dvec3& slope) {
    AnalyticField field;
    field.name = "linear ramp";
    const double reach = std::abs(slope.x) + std::abs(slope.y) + std::abs(slope.z);
    field.low = 0.5 - reach;
    field.high = 0.5 + reach;
    field.value = [slope](const glm::dvec3& p) { return 0.5 + glm::dot(slope, p); };
    field.gradient = [slope](const glm::dvec3&) { return slope; };
    field.lineIntegral = [slope](const glm::dvec3& a, const glm::dvec3& b) {
        return glm::distance(a, b) * (0.5 + glm::dot(slope, 0.5 * (a + b)));
    };
    return field;
}

AnalyticField sphereDistance(double radius) {
    AnalyticField field;
    field.name = "sphere distance";
    field.low = -radius;
    field.high = std::sqrt(3.0) - radius;
    field.value = [radius](const glm::dvec3& p) { return glm::length(p) - radius; };
    field.gradient = [](const glm::dvec3& p) {
        const double length = glm::length(p);
        return length > 0.0 ? p / length : glm::dvec3(0.0);
    };
    return field;
}

AnalyticField torusDistance(double radius, double tube) {
    AnalyticField field;
    field.name = "torus distance";
    field.low = -tube;
    // Farthest from the circle: a corner of the cube, or the middle of its faces across the axis.
    field.high = std::max(std::hypot(std::sqrt(2.0) - radius, 1.0), std::hypot(radius, 1.0)) - tube;
    field.value = [=](const glm::dvec3& p) { return std::hypot(std::hypot(p.x, p.y) - radius, p.z) - tube; };
    field.gradient = [=](const glm::dvec3& p) {
        const double r = std::hypot(p.x, p.y);
        const double fromCircle = std::hypot(r - radius, p.z);
        if (!(r > 0.0) || !(fromCircle > 0.0)) return glm::dvec3(0.0);
        return glm::dvec3((r - radius) * p.x / r, (r - radius) * p.y / r, p.z) / fromCircle;
    };
    return field;
}

AnalyticField marschnerLobb(double frequency, double alpha) {
    AnalyticField field;
    field.name = "Marschner-Lobb";
    field.low = 0.0;
    field.high = 1.0;
    field.value = [=](const glm::dvec3& p) {
        const double wave = std::cos(2.0 * pi * frequency * std::cos(0.5 * pi * std::hypot(p.x, p.y)));
        return (1.0 - std::sin(0.5 * pi * p.z) + alpha * (1.0 + wave)) / (2.0 * (1.0 + alpha));
    };
    field.gradient = [=](const glm::dvec3& p) {
        const double r = std::hypot(p.x, p.y);
        const double phase = 2.0 * pi * frequency * std::cos(0.5 * pi * r);
        const double scale = 1.0 / (2.0 * (1.0 + alpha));
        const double perRadius =
            scale * alpha * std::sin(phase) * pi * pi * frequency * std::sin(0.5 * pi * r);
        const double inverse = r > 0.0 ? 1.0 / r : 0.0;
        return glm::dvec3(perRadius * p.x * inverse, perRadius * p.y * inverse,
                          -scale * 0.5 * pi * std::cos(0.5 * pi * p.z));
    };
    return field;
}

AnalyticField gaussianSum() {
    AnalyticField field;
    field.name = "Gaussian sum";
    field.low = 0.0;
    field.high = 1.1;
    field.value = [](const glm::dvec3& p) {
        double sum = 0.0;
        for (const auto& gaussian : kGaussians)
            sum += gaussianValue(gaussian, p);
        return sum;
    };
    field.gradient = [](const glm::dvec3& p) {
        glm::dvec3 sum(0.0);
        for (const auto& gaussian : kGaussians)
            sum -= gaussianValue(gaussian, p) * (p - gaussian.centre) / (gaussian.width * gaussian.width);
        return sum;
    };
    field.lineIntegral = [](const glm::dvec3& a, const glm::dvec3& b) {
        double sum = 0.0;
        for (const auto& gaussian : kGaussians)
            sum += gaussianLineIntegral(gaussian, a, b);
        return sum;
    };
    return field;
}

} // namespace voxsheet::fields
