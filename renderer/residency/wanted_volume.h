// What is looked at, and what soon will be: decides what is evicted last and brought in first.
#pragma once

#include "volume/texture_encoding.h"
#include "volume/volume_provider.h"

#include <compare>

namespace voxsheet {

/// In ascending order. What nobody names is Recent: kept for as long as nothing else wants its place.
enum class WantedPriority { Recent, Soon, Visible };

/// In which form a volume is held.
struct TexelForm {
    FloatTexels floats = FloatTexels::Full;
    bool onHost = false; ///< in host memory instead of a texture: for kernels (techniques/render_paths.h)

    TexelForm() = default;
    TexelForm(FloatTexels floatTexels, bool inHostMemory = false) // NOLINT: a precision is a form
        : floats(floatTexels), onHost(inHostMemory) {}
    auto operator<=>(const TexelForm&) const = default;
};

struct WantedVolume {
    VolumeKey key;
    WantedPriority priority = WantedPriority::Visible;
    TexelForm form;

    bool operator==(const WantedVolume&) const = default;
};

} // namespace voxsheet
