// Files beside a volume that name its labels.
#pragma once

#include "import/source_reader.h"

#include <filesystem>

namespace voxsheet::import {

/// Beside liver.nii.gz (or liver.nrrd, …), the first that there is of
///   liver.labels.json   a sidecar (label_names.h), whose labels take the place of those within the file
///   liver.label, .lut, .ctbl, .tsv, .txt, .niml.lt, .lt, .xml, liver_ColorTable.ctbl
///                       a lookup table (label_lookup.h), unless the file itself names labels. Files of these
///                       names with other contents say nothing, and nor do links that leave the folder.
/// Its labels go to `header`, its path to header.files (the store's key covers it), and what was left out of
/// it to the notes. Throws as readLabelSidecar, and InvalidInput for a sidecar that is a link out of the
/// folder.
void addLabelFiles(const std::filesystem::path& file, SourceHeader& header);

} // namespace voxsheet::import
