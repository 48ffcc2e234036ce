// Many volumes in one window of VTK's, a renderer each: its way to a sheet.
#pragma once

#include "fields/picture.h"
#include "fields/sampled_field.h"
#include "image/vtk_peer.h"

#include <memory>
#include <vector>

namespace voxsheet::image {

class VtkSheet {
public:
    /// \param volumes  one per cell, as many as columns times rows. Throws as VtkPeer.
    VtkSheet(const std::vector<const fields::SampledField*>& volumes, glm::ivec2 cells, VtkMapper mapper);
    ~VtkSheet();
    VtkSheet(const VtkSheet&) = delete;
    VtkSheet& operator=(const VtkSheet&) = delete;

    /// One tile per cell, row by row from the top, all of one size: the whole window.
    [[nodiscard]] fields::Picture draw(const std::vector<TileSpec>& tiles);
    /// Milliseconds of the last draw(), from the change of the cameras to the pixels on the host.
    [[nodiscard]] double lastMs() const;

private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace voxsheet::image
