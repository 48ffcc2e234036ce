// VTK's volume mappers on the same scenes, as a second opinion on pictures and a peer in benches.
#pragma once

#include "fields/picture.h"
#include "fields/sampled_field.h"
#include "stages/tile_spec.h"

#include <memory>
#include <vector>

namespace voxsheet::image {

enum class VtkMapper {
    Gpu, ///< vtkOpenGLGPUVolumeRayCastMapper, rendering into an EGL context of ours
    Cpu, ///< vtkFixedPointVolumeRayCastMapper; its picture is shown through the same context
};

/// One volume shown by one mapper, set up so that the comparison is fair: automatic sample distances off,
/// image sample distance 1, no jitter, linear interpolation, the tile's sample distance, unit
/// length, table (every entry a control point), clip planes, isosurfaces (coloured by the table), shading (a
/// full head light alone; VTK's shines along the view direction, ours from the eye), view and projection,
/// black background, no multisampling. The mappers end rays by their own fixed rule (opacity above 1 -
/// 1/255).
class VtkPeer {
public:
    /// \param sampled  a field on a grid without rotation or shear (vtkImageData with spacing), of type u8,
    /// u16 or f32 Throws GpuError without EGL, Unsupported for other grids.
    VtkPeer(const fields::SampledField& sampled, VtkMapper mapper);
    ~VtkPeer();
    VtkPeer(const VtkPeer&) = delete;
    VtkPeer& operator=(const VtkPeer&) = delete;

    /// The picture in 8 bits, as VTK gives it to the host; alpha is 1 throughout.
    [[nodiscard]] fields::Picture draw(const TileSpec& tile);
    /// From now on only what lies in this box of the world is drawn (VTK's own cropping).
    void crop(const glm::dvec3& lowWorld, const glm::dvec3& highWorld);
    /// From now on samples that are 0 here are not drawn, others are (VTK's binary mask; nearest sample).
    /// \param kept  one per sample of the volume. Throws Unsupported for the CPU mapper.
    void mask(const std::vector<unsigned char>& kept);
    /// Milliseconds of the last draw(), from the change of the camera to the pixels on the host.
    [[nodiscard]] double lastMs() const;

private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace voxsheet::image
