// Whether a bend in a time-N curve is the sheet's own: a machine that is slower for some seconds, as when its
// neighbours on the same host are busy, bends a curve as surely as a full budget does.
#pragma once

#include <optional>

namespace voxsheet::bench {

/// Of one segment of a curve, which may be measured several times. A bend is believed when two passes, one
/// after the other, find it at about the same N, or when kMostPasses have not agreed.
class SecondLook {
public:
    static constexpr int kMostPasses = 4;

    /// This pass found that the rule breaks after lastN. True: measure the segment again.
    /// \param spacing  N between the points there, >= 1
    [[nodiscard]] bool wantsAnother(int lastN, int spacing);

private:
    std::optional<int> foundAfterN_; ///< by the pass before
    int passes_ = 1;
};

} // namespace voxsheet::bench
