// Lookup tables of labels, as text files that other programs write:
//
//   ITK-SNAP     0  255 0 0  1 1 1  "left kidney"      value, red, green, blue (0 to 255), opacity, two
//                                                      switches, name (its label descriptions)
//   FreeSurfer   17  Left-Hippocampus  220 216 20 0    value, name, red, green, blue, opacity (its colour
//                                                      lookup tables, colour tables of 3D Slicer)
//   BIDS         index <tab> name <tab> color          a header line with at least index and name (BIDS 1.9,
//                                                      "Imaging derivatives", *_dseg.tsv); colours are
//                                                      #rrggbb
//   AFNI, FSL    tables between angle brackets: label_markup.h
#pragma once

#include "volume/dataset.h"

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace voxsheet::import {

struct LabelLookup {
    std::vector<LabelMeta> labels; ///< by value, each once
    std::size_t linesLeftOut = 0;  ///< or rows that are none of the table, or name a value again
};

/// Empty lines and lines that begin with '#' say nothing. Nothing at all if the first other line is none of
/// the above: the text is something else.
[[nodiscard]] std::optional<LabelLookup> parseLabelLookup(std::string_view text);

} // namespace voxsheet::import
