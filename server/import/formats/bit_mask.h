// Whole numbers that carry flags in some of their bits.
#pragma once

#include "volume/dataset.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace voxsheet::import {

/// Says in the notes which bits are kept. Throws InvalidInput (field "options.bit_mask") unless a field holds
/// whole numbers and the mask leaves each such type some of its bits.
void checkBitMask(DatasetMeta& meta, std::uint64_t mask);

/// Keeps these bits of every stored number, bit 0 being the lowest; two's complement. Floats stay as they
/// are.
void keepBits(std::span<std::byte> voxels, ScalarType type, std::uint64_t mask);

} // namespace voxsheet::import
