// Further volumes that are blended into a cell's picture, each with its own transfer function.
#pragma once

#include "volume/texture_encoding.h"
#include "volume/transfer_function.h"

#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace voxsheet {

/// One volume besides the drawn one, matched in the world; outside of its own box, and where it has no value,
/// it is absent.
struct VolumeLayer {
    std::string dataset; ///< DatasetMeta::key
    int field = 0;
    int step = 0;
    int level = 0;
    std::shared_ptr<const TransferTable> transfer; ///< never null; content, not identity, matters
    double unitLengthWorld = 1.0;                  ///< path length over which its opacities hold, > 0
    double weight = 1.0;                           ///< factor on its density, [0, 1]
    FloatTexels floatTexels = FloatTexels::Full;
    bool categories = false; ///< as TileSpec::categories: the nearest sample
    /// Plane only: smaller values are absent.
    double threshold = -std::numeric_limits<double>::infinity();

    bool operator==(const VolumeLayer& other) const {
        return dataset == other.dataset && field == other.field && step == other.step &&
               level == other.level && unitLengthWorld == other.unitLengthWorld && weight == other.weight &&
               floatTexels == other.floatTexels && categories == other.categories &&
               threshold == other.threshold &&
               (transfer == other.transfer || (transfer && other.transfer && *transfer == *other.transfer));
    }
};

inline constexpr std::size_t kMaxLayers = 3;

/// Emission and absorption of all volumes at once, at the drawn volume's sample positions and inside its box:
/// with rho_i = weight_i * -log2(1 - opacity_i) / unitLength_i the extinction of volume i per world length
/// (an opacity of 1 counts as an extinction of 4096), and c_i its colour, lit by its own gradient,
///   rho = sum_i rho_i     colour = sum_i rho_i c_i / rho     alpha = 1 - 2^(-rho length)
/// Clip planes, box and clip object hold for all of them. In Technique::Plane each is painted over what is
/// there, in order, inside the drawn volume's box:
///   alpha = weight_i * opacity_i (of its table at the value)     colour = alpha c_i + (1 - alpha) colour
/// and ownWeight and the unit lengths count for nothing. Other techniques draw none.
struct LayersSpec {
    std::vector<VolumeLayer> volumes; ///< at most kMaxLayers
    double ownWeight = 1.0;           ///< of the drawn volume, [0, 1]; counts only where there are layers

    bool operator==(const LayersSpec&) const = default;
};

} // namespace voxsheet
