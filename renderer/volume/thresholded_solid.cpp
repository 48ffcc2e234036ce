#include "volume/thresholded_solid.h"

#include <algorithm>
#include <cmath>

namespace voxsheet {

namespace {

// Positions come through matrices, and faces of the box must not depend on their rounding; in voxels.
constexpr double positionTolerance = 1e-7;

} // namespace

ThresholdedSolid::ThresholdedSolid(const Grid& field, std::span<const float> values,
                                   const Threshold& threshold)
    : field_(field), values_(values), threshold_(threshold),
      indexFromWorld_(glm::inverse(field.worldFromIndex)), box_(boxIndex(field)) {}

bool ThresholdedSolid::contains(const glm::dvec3& world) const {
    const glm::dvec3 index(indexFromWorld_ * glm::dvec4(world, 1.0));
    for (int axis = 0; axis < 3; ++axis)
        if (!(index[axis] >= box_.low[axis] - positionTolerance &&
              index[axis] <= box_.high[axis] + positionTolerance))
            return false;
    return satisfied(interpolant(index));
}

bool ThresholdedSolid::satisfied(double value) const {
    switch (threshold_.comparison) { // false for NaN
    case Comparison::Greater:
        return value > threshold_.value;
    case Comparison::GreaterOrEqual:
        return value >= threshold_.value;
    case Comparison::Less:
        return value < threshold_.value;
    case Comparison::LessOrEqual:
        break;
    }
    return value <= threshold_.value;
}

ThresholdedSolid::Taps ThresholdedSolid::taps(int axis, double index) const {
    const long last = field_.dims[axis] - 1;
    if (!field_.periodic[axis]) index = std::clamp(index, 0.0, static_cast<double>(last));
    double below = std::floor(index);
    double fraction = index - below;
    if (fraction > 1.0 - positionTolerance) {
        below += 1.0;
        fraction = 0.0;
    } else if (fraction < positionTolerance) {
        fraction = 0.0;
    }
    auto first = static_cast<long>(below);
    auto second = first + 1;
    if (field_.periodic[axis]) {
        const long n = last + 1;
        first = ((first % n) + n) % n;
        second = ((second % n) + n) % n;
    }
    return {{first, std::min(second, last)}, fraction};
}

double ThresholdedSolid::interpolant(const glm::dvec3& index) const {
    const auto x = taps(0, index.x);
    const auto y = taps(1, index.y);
    const auto z = taps(2, index.z);
    double sum = 0.0;
    for (std::size_t corner = 0; corner < 8; ++corner) {
        const std::size_t i = corner & 1U;
        const std::size_t j = (corner >> 1U) & 1U;
        const std::size_t k = corner >> 2U;
        const double weight = (i ? x.fraction : 1.0 - x.fraction) * (j ? y.fraction : 1.0 - y.fraction) *
                              (k ? z.fraction : 1.0 - z.fraction);
        if (weight == 0.0) continue; // a NaN there is not touched
        const long at = (z.sample[k] * field_.dims.y + y.sample[j]) * field_.dims.x + x.sample[i];
        sum += weight * static_cast<double>(values_[static_cast<std::size_t>(at)]);
    }
    return sum;
}

} // namespace voxsheet
