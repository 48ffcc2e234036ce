#include "image/vtk_peer.h"

#include "image/vtk_volume.h"
#include "image/vtk_window.h"

namespace voxsheet::image {

class VtkPeer::Implementation {
public:
    Implementation(const fields::SampledField& sampled, VtkMapper kind) : volume(sampled, kind) {
        window.renderer().AddVolume(volume.prop());
    }

    VtkWindow window;
    VtkVolume volume;
};

VtkPeer::VtkPeer(const fields::SampledField& sampled, VtkMapper mapper)
    : implementation_(std::make_unique<Implementation>(sampled, mapper)) {}

VtkPeer::~VtkPeer() = default;

fields::Picture VtkPeer::draw(const TileSpec& tile) {
    auto& [window, volume] = *implementation_;
    window.makeCurrent();
    volume.prepare(tile);
    return window.draw(tile, volume.grid());
}

void VtkPeer::crop(const glm::dvec3& lowWorld, const glm::dvec3& highWorld) {
    implementation_->volume.crop(lowWorld, highWorld);
}

void VtkPeer::mask(const std::vector<unsigned char>& kept) { implementation_->volume.mask(kept); }

double VtkPeer::lastMs() const { return implementation_->window.lastMs(); }

} // namespace voxsheet::image
