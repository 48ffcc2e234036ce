// What one case of bench_vs_vtk gave.
#pragma once

#include "fields/picture.h"

#include <optional>
#include <string>
#include <vector>

namespace voxsheet::bench {

struct VsVtkResult {
    std::string name;
    std::vector<double> voxsheetMs, vtkGpuMs; ///< of the frames, from state to host pixels
    std::vector<double> vtkCpuMs;             ///< empty: VTK's CPU mapper cannot draw it
    fields::Difference voxsheet, vtkGpu;      ///< of the first picture from the converged integral
    std::optional<fields::Difference> vtkCpu;
};

/// Medians, ratios (VTK's time / ours) and distances, as one JSON object.
[[nodiscard]] std::string jsonOf(const VsVtkResult& result);

} // namespace voxsheet::bench
