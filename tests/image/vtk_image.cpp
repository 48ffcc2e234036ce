#include "image/vtk_image.h"

#include "base/errors.h"

#include <cstring>
#include <string>

namespace voxsheet::image {
namespace {

int vtkTypeOf(ScalarType type) {
    switch (type) {
    case ScalarType::U8:
        return VTK_UNSIGNED_CHAR;
    case ScalarType::U16:
        return VTK_UNSIGNED_SHORT;
    case ScalarType::F32:
        return VTK_FLOAT;
    default:
        throw Unsupported("comparison with VTK",
                          std::string("it does not cover samples of type ") + scalarName(type));
    }
}

} // namespace

vtkSmartPointer<vtkImageData> vtkImageOf(const fields::SampledField& sampled) {
    const auto& grid = sampled.meta.grid;
    const auto& m = grid.worldFromIndex;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            if (row != column && m[column][row] != 0.0)
                throw Unsupported("comparison with VTK", "the grid is rotated or sheared");
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(grid.dims.x, grid.dims.y, grid.dims.z);
    image->SetSpacing(m[0][0], m[1][1], m[2][2]);
    image->SetOrigin(m[3][0], m[3][1], m[3][2]);
    image->AllocateScalars(vtkTypeOf(sampled.meta.fields[0].storedType), 1);
    const auto& bytes = sampled.arrays.at(0);
    std::memcpy(image->GetScalarPointer(), bytes.data(), bytes.size());
    return image;
}

} // namespace voxsheet::image
