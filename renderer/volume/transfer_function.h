// From scalar values to colour and opacity. One optical model everywhere: emission-absorption with emitted
// radiance = density x chromaticity; a sample's alpha over a path of length d is 1 - (1 - opacity)^(d /
// unitLength).
#pragma once

#include <glm/glm.hpp>

#include <memory>
#include <string>
#include <vector>

namespace voxsheet {

enum class ValueScale { Linear, Log, SymLog };

/// Where the colours come from. Piecewise: from the colour map (control points). The others: the R, G, B
/// functions with two cuts after Khanduja & Karki 2007, figure 2 (a picture only, so these are our formulas).
/// With s the position in the range, c1 = cut1, c2 = cut2, m = (c1 + c2) / 2 and u1 = clamp((s - c1) / (m -
/// c1)), u2 = clamp((s - m) / (c2 - m)):
///   B = 1 - f(u1)      G = f(u1) - f(u2)      R = f(u2)
/// with the ramp f(u) = u (Linear), (e^(3u) - 1) / (e^3 - 1) (Exponential), u^2 (Parabolic). So blue holds up
/// to the first cut, green peaks midway, red holds from the second cut on, R + G + B = 1, and all change of
/// colour lies between the cuts.
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
    std::vector<ColourPoint> colours; ///< sorted; used when shape is Piecewise; at least one
    std::vector<OpacityPoint>
        opacities;      ///< sorted; at least one; beyond the ends the end values hold. Two points at one
                        ///< position make a step: the second holds from there on (colours likewise)
    double cut1 = 0.25; ///< R_CUT1 as a fraction of the range, < cut2
    double cut2 = 0.75; ///< R_CUT2 as a fraction of the range
    double low = 0.0;   ///< value at position 0
    double high = 1.0;  ///< value at position 1, > low
    ValueScale scale = ValueScale::Linear;
    double symLogThreshold = 0.0; ///< SymLog: linear within +-threshold; 0 = 1e-3 of the largest magnitude
    bool hasBelow = false;        ///< values < low: `below` instead of the colour at low
    bool hasAbove = false;        ///< values > high: `above` instead of the colour at high
    glm::dvec4 below{0.0};        ///< rgb and opacity per unitLength
    glm::dvec4 above{0.0};        ///< rgb and opacity per unitLength
    glm::dvec4 nan{0.0};          ///< for planes and clip faces only: in volume rendering NaN is absent
};

/// Position in [0, 1] over the range (outside: < 0 or > 1), by `scale`:
///   (g(value) - g(low)) / (g(high) - g(low))
/// with g(v) = v (Linear), ln v (Log; v <= 0 gives -infinity), and for SymLog g(v) = v / t within +-t and
/// sign(v) * (1 + ln(|v| / t)) beyond (t = symLogThreshold). Log with low <= 0 starts at high * 1e-6 instead
/// of low.
[[nodiscard]] double transferPosition(const TransferFunction& function, double value);
/// Inverse of transferPosition.
[[nodiscard]] double transferValue(const TransferFunction& function, double position);

/// rgb (chromaticity, not multiplied) and opacity per unit length at a value; double precision, no table. NaN
/// gives `nan`.
[[nodiscard]] glm::dvec4 evaluateTransfer(const TransferFunction& function, double value);

/// What the GPU samples: entries at equal steps of transferPosition, so that a logarithmic range is resolved
/// over all its decades. 32-bit float: 8-bit tables cost tens of dB.
struct TransferTable {
    double low = 0.0;  ///< value of the first entry (Log: > 0)
    double high = 1.0; ///< value of the last entry
    ValueScale scale = ValueScale::Linear;
    double symLogThreshold = 1.0; ///< SymLog: > 0
    std::vector<glm::vec4>
        entries;           ///< rgb and opacity per unit length; entry i at position i / (n - 1); n >= 2
    glm::vec4 below{0.0F}; ///< for values < low; the first entry unless asked for
    glm::vec4 above{0.0F}; ///< for values > high; the last entry unless asked for
    glm::vec4 nan{0.0F};

    bool operator==(const TransferTable&) const = default;
};

/// Position of a value over the table, as transferPosition.
[[nodiscard]] double tablePosition(const TransferTable& table, double value);

/// Inverse of tablePosition.
[[nodiscard]] double tableValue(const TransferTable& table, double position);

/// rgb and opacity per unit length at a value, linear between entries. What techniques draw, up to the
/// distance of two entries. NaN gives `nan`.
[[nodiscard]] glm::dvec4 classify(const TransferTable& table, double value);

inline constexpr int kTransferTableEntries = 4096;

/// Throws InvalidInput (with field) if points are absent, unsorted or out of range, low >= high, cut1 >= cut2
/// or outside [0, 1], a number is not finite, a Log range has high <= 0, symLogThreshold < 0, or entries < 2.
[[nodiscard]] std::shared_ptr<const TransferTable> buildTransferTable(const TransferFunction& function,
                                                                      int entries = kTransferTableEntries);

/// Largest opacity over values in [low, high], conservative by one entry at each end: what empty-space
/// skipping asks per brick. An empty interval (low > high, a brick of NaN) gives 0.
[[nodiscard]] float maxOpacity(const TransferTable& table, double low, double high);

/// Largest opacity of the table, below and above included.
[[nodiscard]] float largestOpacity(const TransferTable& table);

} // namespace voxsheet
