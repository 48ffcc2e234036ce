// The format that a file seems to have, from its first bytes: for lists of many files, where asking the
// importer about each would take too long. The importer decides when the file is opened.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace voxsheet::http {

/// DatasetMeta::format of the likely reader ("nrrd", "metaimage", "nifti", "vti", "vtk", "xsf", "cube",
/// "chgcar", "slc", "tiff", "raw"); nothing if none is recognised or the file cannot be read. Reads at most
/// 64 KiB.
[[nodiscard]] std::optional<std::string> guessFormat(const std::filesystem::path& file);

} // namespace voxsheet::http
