#include "volume/surface_net.h"

#include "volume/parallel_for.h"

#include <algorithm>

namespace voxsheet {

namespace {

constexpr double crossingSteps = 65534.0;

/// Squared distance to a triangle by the Voronoi regions of its parts (Ericson, Real-Time Collision
/// Detection, 2005, section 5.1.5). Triangles without area fall to their edges.
float squaredDistanceToTriangle(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b,
                                const glm::vec3& c) {
    const auto ab = b - a;
    const auto ac = c - a;
    const auto squared = [](const glm::vec3& v) { return glm::dot(v, v); };
    const auto ap = p - a;
    const float d1 = glm::dot(ab, ap);
    const float d2 = glm::dot(ac, ap);
    if (d1 <= 0.0F && d2 <= 0.0F) return squared(ap);
    const auto bp = p - b;
    const float d3 = glm::dot(ab, bp);
    const float d4 = glm::dot(ac, bp);
    if (d3 >= 0.0F && d4 <= d3) return squared(bp);
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0F && d1 >= 0.0F && d3 <= 0.0F && d1 > d3) return squared(ap - ab * (d1 / (d1 - d3)));
    const auto cp = p - c;
    const float d5 = glm::dot(ab, cp);
    const float d6 = glm::dot(ac, cp);
    if (d6 >= 0.0F && d5 <= d6) return squared(cp);
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0F && d2 >= 0.0F && d6 <= 0.0F && d2 > d6) return squared(ap - ac * (d2 / (d2 - d6)));
    const float va = d3 * d6 - d5 * d4;
    const float d43 = d4 - d3;
    const float d56 = d5 - d6;
    if (va <= 0.0F && d43 >= 0.0F && d56 >= 0.0F && d43 + d56 > 0.0F)
        return squared(bp - (c - b) * (d43 / (d43 + d56)));
    const float scale = 1.0F / std::max(va + vb + vc, 1e-30F);
    return squared(ap - ab * (vb * scale) - ac * (vc * scale));
}

/// Where the solid ends between two points, the first inside and the second outside: 0 .. 1.
double crossing(const SurfaceNet::Solid& inside, const glm::dvec3& in, const glm::dvec3& out) {
    double low = 0.0;
    double high = 1.0;
    for (int step = 0; step < 10; ++step) {
        const double middle = 0.5 * (low + high);
        (inside(in + (out - in) * middle) ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

} // namespace

SurfaceNet::SurfaceNet(const glm::ivec3& dims, const Solid& inside)
    : dims_(dims), stride_{1, static_cast<std::size_t>(dims.x),
                           static_cast<std::size_t>(dims.x) * static_cast<std::size_t>(dims.y)} {
    sampleSolid(inside);
    findCrossings(inside);
    placeVertices();
}

glm::dvec3 SurfaceNet::positionOf(std::size_t sample) const {
    return {sample % stride_[1], sample % stride_[2] / stride_[1], sample / stride_[2]};
}

void SurfaceNet::sampleSolid(const Solid& inside) {
    inside_.resize(stride_[2] * static_cast<std::size_t>(dims_.z));
    parallelFor(static_cast<long>(inside_.size()), 1 << 14, [&](long begin, long end) {
        for (auto s = static_cast<std::size_t>(begin); s < static_cast<std::size_t>(end); ++s)
            inside_[s] = inside(positionOf(s)) ? 1 : 0;
    });
}

void SurfaceNet::findCrossings(const Solid& inside) {
    crossings_.resize(inside_.size() * 3);
    parallelFor(static_cast<long>(inside_.size() - stride_[2]), 1 << 12, [&](long begin, long end) {
        for (auto s = static_cast<std::size_t>(begin); s < static_cast<std::size_t>(end); ++s)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto next = s + stride_[axis];
                if (inside_[s] == inside_[next]) continue;
                auto at = inside_[s] ? crossing(inside, positionOf(s), positionOf(next))
                                     : 1.0 - crossing(inside, positionOf(next), positionOf(s));
                crossings_[3 * s + axis] = static_cast<std::uint16_t>(1.5 + at * crossingSteps);
            }
    });
}

int SurfaceNet::crossingsOf(std::size_t cell) const {
    int count = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto u = stride_[(axis + 1) % 3];
        const auto v = stride_[(axis + 2) % 3];
        for (const auto from : {cell, cell + u, cell + v, cell + u + v})
            count += crossings_[3 * from + axis] != 0 ? 1 : 0;
    }
    return count;
}

glm::dvec3 SurfaceNet::meanCrossing(std::size_t cell, int crossings) const {
    glm::dvec3 sum(0.0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto u = stride_[(axis + 1) % 3];
        const auto v = stride_[(axis + 2) % 3];
        for (const auto from : {cell, cell + u, cell + v, cell + u + v}) {
            const auto stored = crossings_[3 * from + axis];
            if (stored == 0) continue;
            auto point = positionOf(from);
            point[static_cast<glm::length_t>(axis)] += (stored - 1) / crossingSteps;
            sum += point;
        }
    }
    return sum / static_cast<double>(crossings);
}

void SurfaceNet::placeVertices() {
    vertexIndex_.assign(inside_.size(), noVertex);
    std::uint32_t count = 0;
    const auto cells = inside_.size() - stride_[2] - stride_[1] - 1;
    for (std::size_t cell = 0; cell < cells; ++cell)
        if (crossingsOf(cell) > 0) vertexIndex_[cell] = count++;
    vertices_.resize(count);
    parallelFor(static_cast<long>(cells), 1 << 14, [&](long begin, long end) {
        for (auto cell = static_cast<std::size_t>(begin); cell < static_cast<std::size_t>(end); ++cell)
            if (hasVertex(cell)) vertices_[vertexIndex_[cell]] = meanCrossing(cell, crossingsOf(cell));
    });
}

float SurfaceNet::squaredDistance(Edge edge, const glm::vec3& position) const {
    const std::size_t sample = edge / 3;
    const std::size_t axis = edge % 3;
    const auto u = stride_[(axis + 1) % 3];
    const auto v = stride_[(axis + 2) % 3];
    const auto a = vertex(sample);
    const auto b = vertex(sample - u);
    const auto c = vertex(sample - u - v);
    const auto d = vertex(sample - v);
    return std::min(squaredDistanceToTriangle(position, a, b, c),
                    squaredDistanceToTriangle(position, a, c, d));
}

} // namespace voxsheet
