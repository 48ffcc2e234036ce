// Real scans as scenes of the comparison with VTK.
#pragma once

#include "fields/sampled_field.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace voxsheet::bench {

/// A scan as the benches draw it: whole numbers of 8 or 16 bits from 0 on, on a grid without rotation or
/// mirroring, so that VTK's image data can hold the same.
struct ScanField {
    std::string name;
    fields::SampledField sampled;
    double low = 0.0; ///< the percentiles 50 and 99.8 of its values: most of a scan is air
    double high = 0.0;
};

/// The scans that lie in `folder` (as in the project's test data: FullHead, frog, a quarter of headsq,
/// neghip). `missing` is told of each that does not. Throws NotFound when there is none, and what the readers
/// throw.
[[nodiscard]] std::vector<ScanField> readScans(const std::filesystem::path& folder,
                                               const std::function<void(const std::string&)>& missing);

} // namespace voxsheet::bench
