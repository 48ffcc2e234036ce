// An analytic field as a dataset of stored samples, and the trilinear interpolant of samples in double
// precision.
#pragma once

#include "fields/analytic_field.h"
#include "volume/dataset.h"
#include "volume/volume_provider.h"

#include <cstddef>
#include <vector>

namespace voxsheet::fields {

struct SampledField {
    DatasetMeta meta;                           ///< one field, one step
    std::vector<std::vector<std::byte>> arrays; ///< as MemoryVolumeProvider::add takes them
};

/// The field over the grid's texture frame: texture coordinate t is the point 2 t - 1. Integer types use
/// their full range over [low, high] of the field, with valueScale and valueOffset set so that the values
/// come back; floats store values.
[[nodiscard]] SampledField sampleField(const AnalyticField& field, const Grid& grid, ScalarType type,
                                       const std::string& key);

/// Values (not stored numbers) of one level, interpolated as the renderer defines it.
class Interpolant {
public:
    /// Reads the level through the provider. Throws what it throws.
    Interpolant(const VolumeProvider& provider, const VolumeKey& key);

    /// Trilinear between texel centres (i + 1/2) / dims; wraps on periodic axes, else clamps; NaN if a sample
    /// that counts is NaN.
    [[nodiscard]] double at(const glm::dvec3& texture) const;
    /// The value of the sample whose voxel holds the coordinate; clamped to the first and last sample.
    [[nodiscard]] double nearest(const glm::dvec3& texture) const;
    [[nodiscard]] const glm::ivec3& dims() const { return dims_; }

private:
    glm::ivec3 dims_{1};
    glm::bvec3 periodic_{false};
    std::vector<double> values_;
};

} // namespace voxsheet::fields
