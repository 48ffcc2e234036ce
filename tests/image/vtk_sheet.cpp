#include "image/vtk_sheet.h"

#include "image/vtk_volume.h"
#include "image/vtk_window.h"

namespace voxsheet::image {

class VtkSheet::Implementation {
public:
    Implementation(const std::vector<const fields::SampledField*>& sampled, glm::ivec2 cells, VtkMapper kind)
        : window(cells) {
        for (std::size_t i = 0; i < sampled.size(); ++i) {
            volumes.push_back(std::make_unique<VtkVolume>(*sampled[i], kind));
            window.renderer(i).AddVolume(volumes.back()->prop());
        }
    }

    VtkWindow window;
    std::vector<std::unique_ptr<VtkVolume>> volumes;
};

VtkSheet::VtkSheet(const std::vector<const fields::SampledField*>& volumes, glm::ivec2 cells,
                   VtkMapper mapper)
    : implementation_(std::make_unique<Implementation>(volumes, cells, mapper)) {}

VtkSheet::~VtkSheet() = default;

fields::Picture VtkSheet::draw(const std::vector<TileSpec>& tiles) {
    auto& [window, volumes] = *implementation_;
    window.makeCurrent();
    std::vector<VtkWindow::Cell> cells;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        volumes.at(i)->prepare(tiles[i]);
        cells.push_back({tiles[i], volumes[i]->grid()});
    }
    return window.draw(cells);
}

double VtkSheet::lastMs() const { return implementation_->window.lastMs(); }

} // namespace voxsheet::image
