// What is looked at, and what soon will be: decides what is evicted last and brought in first.
#pragma once

#include "volume/texture_encoding.h"
#include "volume/volume_provider.h"

namespace voxsheet {

/// In ascending order. What nobody names is Recent: kept for as long as nothing else wants its place.
enum class WantedPriority { Recent, Soon, Visible };

struct WantedVolume {
    VolumeKey key;
    WantedPriority priority = WantedPriority::Visible;
    FloatTexels floatTexels = FloatTexels::Full;

    bool operator==(const WantedVolume&) const = default;
};

} // namespace voxsheet
