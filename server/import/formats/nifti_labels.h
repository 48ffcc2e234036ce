// Label tables within NIfTI files.
#pragma once

#include "import/formats/byte_stream.h"
#include "import/formats/nifti_header.h"
#include "volume/dataset.h"

#include <string>
#include <vector>

namespace voxsheet::import {

/// The table of an extension after the header: XML as Connectome Workbench (extension code 30) and
/// TotalSegmentator (code 0) write it,
///   <CaretExtension><VolumeInformation Index="0"><LabelTable>
///     <Label Key="1" Red="1" Green="0" Blue="0" Alpha="1">spleen</Label> …
/// or the attributes of AFNI (code 4; label_markup.h). The first table counts. No labels if there is none, or
/// none that can be read, which is said in `notes`. \param file  the one that holds the header. Throws
/// IoError.
[[nodiscard]] std::vector<LabelMeta> niftiLabels(const InputFile& file, Compression compression,
                                                 const NiftiHeader& header, std::vector<std::string>& notes);

} // namespace voxsheet::import
