// Names and colours that files give to the values of a label map.
#pragma once

#include "import/formats/input_file.h"
#include "volume/dataset.h"

#include <map>
#include <string>
#include <vector>

namespace voxsheet::import {

/// From the key/value pairs of a NRRD header as 3D Slicer writes segmentations (*.seg.nrrd; Slicer's manual,
/// "Segmentation file format"): SegmentN_Name, SegmentN_LabelValue and SegmentN_Color (three numbers in
/// [0, 1]). By value, each once. Segments without a valid value are left out; so are all of them where they
/// lie in several layers, since a value means different things there. Both are said in `notes`.
[[nodiscard]] std::vector<LabelMeta> segmentLabels(const std::map<std::string, std::string>& pairs,
                                                   std::vector<std::string>& notes);

/// `{"labels": {"1": "liver", "2": {"name": "spleen", "colour": "#aa3300"}}}`, by value. Throws InvalidInput
/// (subject: the file's name; field: labels), LimitExceeded for more than 4096 labels.
[[nodiscard]] std::vector<LabelMeta> readLabelSidecar(const InputFile& file);

} // namespace voxsheet::import
