// Whether a point lies in the solid that a threshold cuts out of a volume.
#pragma once

#include "volume/grid.h"
#include "volume/signed_distance.h"

#include <array>
#include <span>

namespace voxsheet {

/// A view: the values must outlive it. Definition of the solid: signed_distance.h.
class ThresholdedSolid {
public:
    ThresholdedSolid(const Grid& field, std::span<const float> values, const Threshold& threshold);

    [[nodiscard]] bool contains(const glm::dvec3& world) const;

private:
    /// The two samples beside a position on one axis, and where it lies between them.
    struct Taps {
        std::array<long, 2> sample;
        double fraction;
    };

    [[nodiscard]] Taps taps(int axis, double index) const;
    [[nodiscard]] double interpolant(const glm::dvec3& index) const;
    [[nodiscard]] bool satisfied(double value) const;

    Grid field_;
    std::span<const float> values_;
    Threshold threshold_;
    glm::dmat4 indexFromWorld_;
    IndexBox box_;
};

} // namespace voxsheet
