// Damaged and hostile files, made from valid ones.
#pragma once

#include "sample_files.h"

#include <string>
#include <vector>

namespace voxsheet::import::testing {

struct Mutant {
    std::string what; ///< was done to it
    SampleFile file;
    bool mayBeWhole =
        false; ///< only bytes without meaning may be missing: it may be read, with the same voxels
};

/// The opened file and its first data file cut at 16 offsets each, and right before the last byte that
/// counts.
[[nodiscard]] std::vector<Mutant> truncations(const SampleFile& sample);

/// Headers that lie, by the sample's name: sizes below zero and beyond 64 bits, sizes that the file cannot
/// hold, spacings that are no numbers, axes in one plane, lengths of blocks.
[[nodiscard]] std::vector<Mutant> lies(const SampleFile& sample);

/// Small files that decompress to a thousand times their size.
[[nodiscard]] std::vector<Mutant> bombs();

} // namespace voxsheet::import::testing
