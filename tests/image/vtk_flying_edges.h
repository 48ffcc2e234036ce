// VTK's isosurface of a sampled field, as triangles (vtkFlyingEdges3D; Schroeder, Maynard & Geveci 2015).
#pragma once

#include "fields/sampled_field.h"

#include <glm/glm.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace voxsheet::image {

class VtkFlyingEdges {
public:
    /// \param isovalue  in values of the field
    /// Throws as vtkImageOf.
    VtkFlyingEdges(const fields::SampledField& sampled, double isovalue);
    ~VtkFlyingEdges();
    VtkFlyingEdges(const VtkFlyingEdges&) = delete;
    VtkFlyingEdges& operator=(const VtkFlyingEdges&) = delete;

    struct Vertex {
        glm::dvec3 position{0.0}; ///< world: on an edge between two samples
        glm::dvec3 normal{0.0};   ///< unit length, against the gradient
    };
    [[nodiscard]] const std::vector<Vertex>& vertices() const { return vertices_; }

    /// Where the segment from a to b first meets a triangle.
    [[nodiscard]] std::optional<glm::dvec3> firstMeeting(const glm::dvec3& a, const glm::dvec3& b) const;

private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
    std::vector<Vertex> vertices_;
};

} // namespace voxsheet::image
