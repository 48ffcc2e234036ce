// The readers written for this project, and what is common to all readers before and after them.
#pragma once

#include "import/source_reader.h"

#include <memory>
#include <vector>

namespace voxsheet::import {

/// NRRD, MetaImage, NIfTI, SLC, XSF, Gaussian cube, CHGCAR family, raw + JSON: in the order in which they
/// should be asked.
[[nodiscard]] std::vector<std::unique_ptr<SourceReader>> makeOwnReaders();

/// Throws NotFound, IoError (unreadable), InvalidInput (a folder, a device, an empty file, a Git LFS
/// pointer).
[[nodiscard]] FileHead readFileHead(const std::filesystem::path& path);

/// The options that hold for every format (spacing, orientation, origin, flip, periodic, bitMask,
/// noDataValue): changes the header (noDataValue makes integer fields F32 or F64) and returns the sink to
/// hand to readData, which converts arrays on their way to `sink`. Throws InvalidInput if an option does not
/// fit.
[[nodiscard]] ArraySink applyOptions(SourceHeader& header, const ImportOptions& options, ArraySink sink);

} // namespace voxsheet::import
