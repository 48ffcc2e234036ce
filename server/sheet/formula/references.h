// Formulas follow the cells that they name when those move.
#pragma once

#include "sheet/address.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace voxsheet::sheet {

/// Where a referenced range (a single cell: first == last) is now; nullopt: it is gone, and #REF! takes its
/// place. \param sheet  the reference's sheet as written; empty: the formula's own
using ReferenceMove =
    std::function<std::optional<AddressRange>(const std::string& sheet, const AddressRange& range)>;

/// The formula's text with references replaced and everything else as typed. A text that does not parse is
/// left alone.
[[nodiscard]] std::string rewriteReferences(std::string_view formula, const ReferenceMove& move);

/// The formula's text with references to sheet `from` (whatever the case) to `to`; an empty `to`: they become
/// #REF!.
[[nodiscard]] std::string rewriteSheet(std::string_view formula, std::string_view from, std::string_view to);

} // namespace voxsheet::sheet
