#pragma once

#include <string_view>

namespace voxsheet::import {

/// Atomic number of a chemical symbol ("Na"); 0 if it is none.
[[nodiscard]] int atomicNumber(std::string_view symbol);

} // namespace voxsheet::import
