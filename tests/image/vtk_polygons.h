// VTK's way to an isosurface: triangles by flying edges, then drawn as polygons.
#pragma once

#include "fields/picture.h"
#include "fields/sampled_field.h"
#include "stages/tile_spec.h"

#include <memory>

namespace voxsheet::image {

class VtkPolygons {
public:
    /// Throws as VtkPeer.
    explicit VtkPolygons(const fields::SampledField& sampled);
    ~VtkPolygons();
    VtkPolygons(const VtkPolygons&) = delete;
    VtkPolygons& operator=(const VtkPolygons&) = delete;

    /// The first surface of the tile in its colour, opaque, with normals from gradients, under a head light
    /// as the tile's shading says. Extracts it anew when the value is another.
    [[nodiscard]] fields::Picture draw(const TileSpec& tile);
    /// Milliseconds of the last draw(), extraction included.
    [[nodiscard]] double lastMs() const;
    [[nodiscard]] long triangles() const; ///< of the last draw()

private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace voxsheet::image
