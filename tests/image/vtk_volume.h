// One volume of VTK's and its mapper, set up as a tile says.
#pragma once

#include "fields/sampled_field.h"
#include "image/vtk_peer.h"

#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkNew.h>
#include <vtkOpenGLGPUVolumeRayCastMapper.h>
#include <vtkSmartPointer.h>
#include <vtkVolume.h>

#include <memory>
#include <vector>

namespace voxsheet::image {

class VtkVolume {
public:
    /// Throws as VtkPeer.
    VtkVolume(const fields::SampledField& sampled, VtkMapper kind);

    [[nodiscard]] vtkVolume* prop() const { return volume_; }
    [[nodiscard]] const Grid& grid() const { return grid_; }

    /// Everything in the tile that is not its camera: what is the same from frame to frame in a rotation.
    void prepare(const TileSpec& tile);
    void crop(const glm::dvec3& low, const glm::dvec3& high);
    void mask(const std::vector<unsigned char>& kept);

private:
    [[nodiscard]] vtkVolumeMapper* mapper() const;
    void setBlend(const TileSpec& tile);

    Grid grid_;
    FieldMeta field_;
    std::shared_ptr<const TransferTable> table_;
    vtkNew<vtkVolume> volume_;
    vtkSmartPointer<vtkOpenGLGPUVolumeRayCastMapper> gpu_;
    vtkSmartPointer<vtkFixedPointVolumeRayCastMapper> cpu_;
};

} // namespace voxsheet::image
