// Which image files a VTK AMR data set is made of.
#pragma once

#include "import/formats/input_file.h"

#include <string>
#include <vector>

namespace voxsheet::import {

struct AmrPatch {
    int level = 0;    ///< of refinement, 0 is the coarsest
    std::string file; ///< as written
};

/// vtkOverlappingAMR and vtkNonOverlappingAMR (.vth, .vthb, .vtm of VTK 6 and later) and
/// vtkHierarchicalBoxDataSet (before); by level, within a level as in the file. Of vtkMultiBlockDataSet, all
/// are of level 0 and as in the file, whatever their place in the tree of blocks. Throws InvalidInput,
/// LimitExceeded for more than 10,000 patches.
[[nodiscard]] std::vector<AmrPatch> parseAmrHeader(const InputFile& file);

/// Of the attribute `type` of a VTKFile.
[[nodiscard]] bool isAmrType(std::string_view type);
[[nodiscard]] bool isMultiBlockType(std::string_view type);

} // namespace voxsheet::import
