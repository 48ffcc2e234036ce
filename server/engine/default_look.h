// What a dataset looks like before anyone has chosen anything: which values its colours span, whether they
// diverge about zero, and which values are opaque. Pure functions of a summary of its values.
//
// The rules, all from the distribution of the values:
//   1. Background: the narrowest interval that holds a quarter of the samples (air round a head, vacuum
//      round a molecule, no difference at all). Its middle is the one value that most of the box has, so it
//      must be transparent.
//   2. Signed: values of both signs reach beyond a tenth of the larger magnitude, the background is near
//      zero, and the samples do not pile up at one end (air of a CT at -1000 HU). Such data (differences,
//      potentials, wave functions) open with a diverging map whose neutral colour is zero. Plain integers
//      (scans, counts) never do.
//   3. Window: smallest to largest value, unless a few extreme samples (nuclei, metal) would press all others
//      into less than 60 % of the range: then the 0.2 % and 99.8 % quantiles. A side of the background with
//      few samples (a flag) is kept no wider than the other. Signed: symmetric about zero.
//   4. Opacity: zero at the background, and on a side of it that holds less than a quarter of the other
//      side's samples; it begins where Otsu's threshold splits the distances from the background, and grows
//      with the power 1.5 to the 99 % quantile. Its height makes the mean optical depth through the box
//      kTargetDepth: neither does a filled box turn solid nor a sparse one vanish.
#pragma once

#include "volume/transfer_function.h"

#include <vector>

namespace voxsheet::engine {

/// The distribution of one field's finite values.
struct ValueSummary {
    static constexpr int kQuantiles = 1025;

    double min = 0.0; ///< of the source values, all steps
    double max = 0.0;
    bool integers = false; ///< the source holds integers without a slope
    std::vector<double>
        quantiles; ///< kQuantiles values, q(i / (kQuantiles-1)), never decreasing; empty: no finite value

    /// Linear between the stored quantiles; probability in [0, 1]. 0 when there are none.
    [[nodiscard]] double quantile(double probability) const;
};

/// NaN and infinite values are left out. `values` is reordered.
[[nodiscard]] ValueSummary summariseValues(std::vector<float>& values, double min, double max);

inline constexpr double kTargetDepth = 1.2; ///< mean optical depth through the box, see rule 4

/// Of finite values; min == max for a constant.
struct ValueExtremes {
    double min = 0.0;
    double max = 0.0;

    bool operator==(const ValueExtremes&) const = default;
};

struct ValueWindow {
    double low = 0.0;
    double high = 1.0; ///< > low

    bool operator==(const ValueWindow&) const = default;
};

/// Middle of the narrowest interval that holds a quarter of the samples (rule 1).
[[nodiscard]] double backgroundValue(const ValueSummary& summary);
/// Rule 2.
[[nodiscard]] bool opensDiverging(const ValueSummary& summary);
/// Rule 3. A constant field gets a window of width 1 (or its magnitude) about its value.
[[nodiscard]] ValueWindow defaultWindow(const ValueSummary& summary);
/// [min, max], widened as defaultWindow when the field is constant.
[[nodiscard]] ValueWindow fullWindow(double min, double max);
/// [-m, m] with m = the larger magnitude of the ends.
[[nodiscard]] ValueWindow symmetricWindow(const ValueWindow& window);
/// The quantiles [1 %, 99 %].
[[nodiscard]] ValueWindow percentileWindow(const ValueSummary& summary);

/// Rule 4, over positions [0, 1] of `function` (its low, high and scale; its points are not looked at).
/// \param pathUnitLengths  mean path through the box in units of transfer.unitLength, > 0
/// \param signedData       transparent at zero, opaque towards both ends
[[nodiscard]] std::vector<OpacityPoint> defaultOpacity(const ValueSummary& summary,
                                                       const TransferFunction& function, bool signedData,
                                                       double pathUnitLengths);
/// For maximum intensity projection, where one sample makes the pixel: transparent at the background,
/// opaque soon after.
[[nodiscard]] std::vector<OpacityPoint>
defaultProjectionOpacity(const ValueSummary& summary, const TransferFunction& function, bool signedData);

/// Values whose surfaces show a structure. Signed data (rule 2): +-25 % of the larger end of the range that
/// is shown, so that both signs show alike. Others: one, where opacity begins in the default window (rule 4),
/// that is where Otsu's threshold splits the distances from the background: the skin of a head, the shell of
/// a molecule. Labels 0 and 1 give 0.5. A constant field gives a value that it does not have. Never empty.
/// \param shown  what the colours span; for signed data that it does not hold on both sides of zero, the
/// default window
[[nodiscard]] std::vector<double> defaultIsovalues(const ValueSummary& summary, const ValueWindow& shown);

} // namespace voxsheet::engine
