// Sampled fields as VTK's image data.
#pragma once

#include "fields/sampled_field.h"

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

namespace voxsheet::image {

/// The stored numbers, without slope and intercept, with spacing and origin. Throws Unsupported for grids
/// with rotation or shear and for types other than u8, u16 and f32.
[[nodiscard]] vtkSmartPointer<vtkImageData> vtkImageOf(const fields::SampledField& sampled);

} // namespace voxsheet::image
