// The surface of a solid on a grid, as a net of quadrilaterals: one for each edge of the grid that leaves the
// solid, between the vertices of the four cells about that edge (surface nets: Gibson 1998). Since each
// vertex stays in its cell, the net separates samples inside from samples outside. Positions are in units of
// the grid's samples.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace voxsheet {

class SurfaceNet {
public:
    /// Names an edge from sample s to the next one along an axis: 3 s + axis.
    using Edge = std::uint32_t;
    /// Whether a position is inside.
    using Solid = std::function<bool(const glm::dvec3&)>;

    /// \param dims    samples per axis, fewer than 2^30 in all
    /// \param inside  called for samples and points on the edges between them, from several threads
    /// The outermost samples must be outside.
    SurfaceNet(const glm::ivec3& dims, const Solid& inside);

    [[nodiscard]] bool inside(std::size_t sample) const { return inside_[sample] != 0; }
    [[nodiscard]] bool crosses(Edge edge) const { return crossings_[edge] != 0; }
    [[nodiscard]] bool empty() const { return vertices_.empty(); }

    [[nodiscard]] bool hasVertex(std::size_t cell) const { return vertexIndex_[cell] != noVertex; }
    /// Of a cell (named by its lowest sample) that has one.
    [[nodiscard]] const glm::vec3& vertex(std::size_t cell) const { return vertices_[vertexIndex_[cell]]; }

    /// To the quadrilateral of an edge that crosses.
    [[nodiscard]] float squaredDistance(Edge edge, const glm::vec3& position) const;

private:
    static constexpr std::uint32_t noVertex = std::numeric_limits<std::uint32_t>::max();

    void sampleSolid(const Solid& inside);
    void findCrossings(const Solid& inside);
    void placeVertices();
    [[nodiscard]] glm::dvec3 meanCrossing(std::size_t cell, int crossings) const;
    [[nodiscard]] int crossingsOf(std::size_t cell) const;
    [[nodiscard]] glm::dvec3 positionOf(std::size_t sample) const;

    glm::ivec3 dims_;
    std::array<std::size_t, 3> stride_;
    std::vector<unsigned char> inside_;      ///< per sample
    std::vector<std::uint16_t> crossings_;   ///< per edge: 0, or 1 + position * 65534
    std::vector<std::uint32_t> vertexIndex_; ///< per cell
    std::vector<glm::vec3> vertices_;
};

} // namespace voxsheet
