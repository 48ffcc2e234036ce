// From scalar values to colour and opacity. One optical model everywhere: emission-absorption with emitted radiance =
// density x chromaticity; a sample's alpha over a path of length d is 1 - (1 - opacity)^(d / unitLength).
#pragma once

#include <glm/glm.hpp>

#include <memory>
#include <string>
#include <vector>

namespace voxsheet {

enum class ValueScale { Linear, Log, SymLog };

/// The shape of R, G, B over the range (seed 002, figure 2: a picture only; our formulas are in README, "Transfer
/// functions"). Piecewise: colours come from the colour map (`map`, or control points).
enum class TransferShape { Piecewise, Linear, Exponential, Parabolic };

struct ColourPoint {
    double position; ///< in [0, 1] over the range
    glm::dvec3 rgb;  ///< display sRGB, [0, 1]
};

struct OpacityPoint {
    double position; ///< in [0, 1] over the range
    double opacity;  ///< in [0, 1], per unitLength
};

struct TransferFunction {
    TransferShape shape = TransferShape::Piecewise;
    std::vector<ColourPoint> colours;    ///< sorted; used when shape is Piecewise; at least one
    std::vector<OpacityPoint> opacities; ///< sorted; at least one; beyond the ends the end values hold
    double cut1 = 0.25;                  ///< R_CUT1 as a fraction of the range, < cut2
    double cut2 = 0.75;                  ///< R_CUT2 as a fraction of the range
    double low = 0.0;                    ///< value at position 0
    double high = 1.0;                   ///< value at position 1, > low
    ValueScale scale = ValueScale::Linear;
    double symLogThreshold = 0.0;       ///< SymLog: linear within +-threshold; 0 = 1e-3 of the largest magnitude
    bool hasBelow = false;              ///< values < low: `below` instead of the colour at low
    bool hasAbove = false;              ///< values > high: `above` instead of the colour at high
    glm::dvec4 below{0.0};              ///< rgb and opacity per unitLength
    glm::dvec4 above{0.0};              ///< rgb and opacity per unitLength
    glm::dvec4 nan{0.0};                ///< for planes and clip faces only: in volume rendering NaN is absent
};

/// Position in [0, 1] over the range (outside: < 0 or > 1), by `scale`. Log with low <= 0 uses the smallest positive
/// value that the range allows: max(low, high * 1e-6).
[[nodiscard]] double transferPosition(const TransferFunction& function, double value);
/// Inverse of transferPosition.
[[nodiscard]] double transferValue(const TransferFunction& function, double position);

/// rgb (chromaticity, not multiplied) and opacity per unit length at a value; double precision, no table. NaN gives `nan`.
[[nodiscard]] glm::dvec4 evaluateTransfer(const TransferFunction& function, double value);

/// What the GPU samples: `entries` texels over the *values'* affine range, so that classification is
/// table(clamp((value - low) / (high - low))), whatever the scale. 32-bit float: 8-bit tables cost tens of dB.
struct TransferTable {
    double low = 0.0;
    double high = 1.0;
    std::vector<glm::vec4> entries;       ///< rgb and opacity per unit length; entry i at low + (high-low) * i/(n-1)
    glm::vec4 below{0.0F};                ///< for values < low
    glm::vec4 above{0.0F};                ///< for values > high
    glm::vec4 nan{0.0F};

    bool operator==(const TransferTable&) const = default;
};

inline constexpr int kTransferTableEntries = 4096;

/// Throws InvalidInput (with field) if points are unsorted or out of range, low >= high, cut1 >= cut2, or not finite.
[[nodiscard]] std::shared_ptr<const TransferTable> buildTransferTable(const TransferFunction& function,
                                                                      int entries = kTransferTableEntries);

/// Largest opacity over values in [low, high], conservative: what empty-space skipping asks per brick.
[[nodiscard]] float maxOpacity(const TransferTable& table, double low, double high);

} // namespace voxsheet
