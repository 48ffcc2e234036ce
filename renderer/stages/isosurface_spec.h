// Which isosurfaces a picture shows, and how they are coloured.
#pragma once

#include "volume/transfer_function.h"

#include <glm/glm.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace voxsheet {

struct Isosurface {
    double value = 0.0;     ///< in values of the volume
    glm::vec4 colour{1.0F}; ///< sRGB, not premultiplied; alpha = opacity of the surface, whatever the path

    bool operator==(const Isosurface&) const = default;
};

/// Another volume whose values colour the surfaces, matched in the world; outside it, and where it has no
/// value, they keep their own colour.
struct ColourVolume {
    std::string dataset; ///< DatasetMeta::key
    int field = 0;
    int step = 0;
    int level = 0;
    std::shared_ptr<const TransferTable> transfer; ///< never null; its opacities are not used

    /// By content of the table.
    bool operator==(const ColourVolume& other) const {
        return dataset == other.dataset && field == other.field && step == other.step &&
               level == other.level &&
               (transfer == other.transfer || (transfer && other.transfer && *transfer == *other.transfer));
    }
};

enum class IsosurfaceMethod {
    Refined,  ///< each crossing is found and refined
    AlphaTest ///< for comparison, the plain test of Khanduja & Karki 2007, section 3, which leaves gaps
};

inline constexpr std::size_t kMaxIsosurfaces = 8;

struct IsosurfaceSpec {
    std::vector<Isosurface>
        surfaces; ///< at most kMaxIsosurfaces, in any order, values finite; empty: nothing is drawn
    std::optional<ColourVolume> colouredBy;
    /// Where a cut (clip planes or clip object, not the volume's own faces) opens a region whose value is at
    /// or above the smallest positive isovalue, or at or below the largest negative one, the cut face shows
    /// the transfer function's opaque colours. IsosurfaceMethod::Refined only.
    bool caps = false;
    IsosurfaceMethod method = IsosurfaceMethod::Refined;

    bool operator==(const IsosurfaceSpec&) const = default;
};

} // namespace voxsheet
