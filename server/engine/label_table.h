// A label map: which values have which names and colours, and the table that draws them.
#pragma once

#include "sheet/typed_style.h"
#include "volume/dataset.h"
#include "volume/transfer_function.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace voxsheet::engine {

struct Label {
    std::int64_t value = 0;
    std::string name;    ///< the value as a number where it has none
    glm::dvec3 rgb{0.0}; ///< display sRGB
    bool hidden = false;
};

struct LabelTable {
    /// For a legend, by value: the values that the data have, where these are told apart by the histogram
    /// (255 or fewer between the smallest and the largest), those that the style names, and those that the
    /// file names and the data may have. Without 0, the background, unless the style names it.
    std::vector<Label> labels;
    /// One entry for each whole number over the data's range; hidden ones have the opacity 0, and so have
    /// values outside.
    std::shared_ptr<const TransferTable> table;

    /// Of the value, which need not be among `labels`.
    [[nodiscard]] std::string nameOf(double value) const;
};

/// The same for the same value, whatever the data: hues by the golden angle in three lightnesses, so that
/// neighbours in number are far apart in colour.
[[nodiscard]] glm::dvec3 labelColour(std::int64_t value);

inline constexpr std::int64_t kMaxLabelSpan = 16000; ///< a row of a texture holds them

/// Names and colours come from the style; where it says nothing of a value, from the file.
/// \param own  the dataset's labels
/// \param opacity  of what is shown, per unit length
/// Throws InvalidInput (field `key`) if the field's samples are not whole numbers, LimitExceeded if they span
/// more than kMaxLabelSpan, InvalidInput (field labels.names) as parseLabelNames.
[[nodiscard]] LabelTable makeLabelTable(const sheet::LabelsStyle& style, const std::vector<LabelMeta>& own,
                                        const FieldMeta& field, int step, double opacity,
                                        const std::string& key);

} // namespace voxsheet::engine
