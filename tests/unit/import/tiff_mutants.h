// Damaged and hostile TIFF files.
#pragma once

#include "mutants.h"

#include <filesystem>

namespace voxsheet::import::testing {

/// Tags of the first page that lie, and lists of pages without an end. `sample` is little-endian.
[[nodiscard]] std::vector<Mutant> tiffLies(const SampleFile& sample);

/// Stacks of 120 MiB from files of about a thousandth of that (LZW: a five hundredth) that are cut off in the
/// last place that is decompressed, or cannot hold what they say. libtiff writes them through a file in
/// `scratch`.
[[nodiscard]] std::vector<Mutant> tiffBombs(const std::filesystem::path& scratch);

} // namespace voxsheet::import::testing
