#include "techniques/tile_volumes.h"

namespace voxsheet {
namespace {

template <typename Member>
double sum(const TileVolumes& volumes, Member member) {
    double total = volumes.volume.*member;
    for (const auto* lease : {&volumes.gradients, &volumes.clipObject, &volumes.colours})
        if (*lease) total += (**lease).*member;
    for (const auto& lease : volumes.layers)
        total += lease.*member;
    return total;
}

} // namespace

double TileVolumes::uploadMs() const { return sum(*this, &VolumeLease::uploadMs); }
double TileVolumes::readMs() const { return sum(*this, &VolumeLease::readMs); }

} // namespace voxsheet
