// Lookup tables of labels between angle brackets, as AFNI and FSL write them:
//
//   AFNI   <VALUE_LABEL_DTABLE ni_type="2*String" ni_dimen="2">   (3drefit -labeltable, 3dinfo -labeltable,
//            "0" "Unknown"                                         *.niml.lt): pairs of a value and a name
//            "17" "Left-Hippocampus"
//          </VALUE_LABEL_DTABLE>
//   FSL    <atlas><header><type>Label</type>…</header>            (*.xml of its atlases)
//            <data><label index="1" x="5" y="5" z="5">name</label>…</data></atlas>
//          The value is the attribute "value" if there is one, else the index, plus 1 in atlases of
//          probabilities, whose volumes of largest probability begin with 1.
#pragma once

#include "import/formats/label_lookup.h"

#include <optional>
#include <string_view>

namespace voxsheet::import {

/// The first AFNI table in the text; nothing if there is none.
[[nodiscard]] std::optional<LabelLookup> parseNimlLabels(std::string_view text);

/// Nothing if the text is no XML, or no atlas.
[[nodiscard]] std::optional<LabelLookup> parseFslAtlas(std::string_view xml);

/// The table that AFNI puts into the header of a NIfTI file (extension code 4), where the text of an
/// attribute holds it with its own brackets escaped. Nothing if there is none.
[[nodiscard]] std::optional<LabelLookup> parseAfniAttributes(std::string_view xml);

} // namespace voxsheet::import
