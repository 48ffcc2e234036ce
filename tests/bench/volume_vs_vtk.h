// Volumes drawn whole by Voxsheet and by VTK's two volume mappers in turn.
#pragma once

#include "bench/volume_bench.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace voxsheet::bench {

/// One way to draw a volume.
struct VolumeCase {
    VolumeLook look;
    Technique technique = Technique::Raycast;
    /// Pre-integrated, at the longest distance of samples that is good and no further from the integral than
    /// VTK's pictures.
    bool atEqualQuality = false;

    /// "256^3 u8 512x512 filled raycast"; what follows atEqualQuality is only known after it was tried.
    [[nodiscard]] std::string name(const VolumeBenchOptions& options, const std::string& volume) const;
};

/// Draws the cases one after the other and gives each as JSON. Throws GpuError, or Unsupported for a volume
/// that VTK's image data cannot hold.
/// \param volume  its name
[[nodiscard]] std::vector<std::string>
drawnAgainstVtk(const VolumeBenchOptions& options, const std::string& volume,
                const std::shared_ptr<const fields::SampledField>& sampled,
                const std::vector<VolumeCase>& cases);

/// The cases of the analytic volume whose names contain options.only; the volume is made if there are any.
[[nodiscard]] std::vector<std::string> volumesAgainstVtk(const VolumeBenchOptions& options);

} // namespace voxsheet::bench
