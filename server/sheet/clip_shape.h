// What style keys name: volumes, and for `clip.shape` an analytic shape, a dataset, or where a volume
// compares with a number.
#pragma once

#include "sheet/address.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace voxsheet::sheet {

/// "sphere", "ellipsoid", "box", "cylinder" or "torus"; also the shape's name in the renderer.
struct AnalyticShape {
    std::string name;
    bool operator==(const AnalyticShape&) const = default;
};

/// A dataset of signed distances, by its name in the workbook.
struct DatasetShape {
    std::string dataset;
    bool operator==(const DatasetShape&) const = default;
};

enum class Comparison { Greater, GreaterOrEqual, Less, LessOrEqual };

/// ">", ">=", "<", "<=".
[[nodiscard]] const char* comparisonSign(Comparison comparison);

/// A volume: a cell (its sheet's name empty: the asking cell's own sheet), or a dataset by its name.
using VolumeName = std::variant<SheetAddress, std::string>;

/// The part of a volume where its values compare with a number.
struct ComparisonShape {
    VolumeName operand;
    Comparison comparison = Comparison::Greater;
    double value = 0.0; ///< finite
    bool operator==(const ComparisonShape&) const = default;
};

using ClipShape = std::variant<AnalyticShape, DatasetShape, ComparisonShape>;

/// A text with a comparison sign outside quotes is `OPERAND SIGN NUMBER`: OPERAND a cell (`B1`, `Sheet2!B4`,
/// whatever the case) or a dataset's name in single quotes. Else the name of a shape (whatever the case) or
/// of a dataset, in single quotes or plain. Throws InvalidInput (field clip.shape).
[[nodiscard]] ClipShape parseClipShape(std::string_view text);

/// A cell (`B1`, `Sheet2!B4`, `'My sheet'!B4`) or a dataset's name (in single quotes, or plain where it does
/// not look like a cell). Throws InvalidInput (field `key`).
[[nodiscard]] VolumeName parseVolumeName(std::string_view text, const std::string& key);

inline constexpr std::size_t kMaxLayerNames = 3;

/// Volumes separated by semicolons (`B1; Sheet2!C1; 'run; 2'`), each as parseVolumeName; at most
/// kMaxLayerNames. Throws InvalidInput (field layers).
[[nodiscard]] std::vector<VolumeName> parseLayers(std::string_view text);

} // namespace voxsheet::sheet
