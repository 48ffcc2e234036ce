// From a cell's crystal style to what of its dataset's crystal stands in the picture.
#pragma once

#include "sheet/typed_style.h"
#include "stages/crystal_spec.h"
#include "volume/dataset.h"

#include <string>

namespace voxsheet::engine {

/// Empty of what the dataset does not have.
[[nodiscard]] CrystalSpec resolveCrystal(const sheet::CrystalStyle& style, const DatasetMeta& meta);

/// A sentence when the style asks for what the dataset does not have; else empty.
[[nodiscard]] std::string missingCrystalNote(const sheet::CrystalStyle& style, const DatasetMeta& meta);

} // namespace voxsheet::engine
