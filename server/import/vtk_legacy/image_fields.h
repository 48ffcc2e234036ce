// What VTK's image data have in common, legacy or XML: one grid of points or cells, arrays whose components
// are fields.
#pragma once

#include "import/formats/rectilinear_axes.h"
#include "import/source_reader.h"
#include "volume/dataset.h"

#include <optional>
#include <string>
#include <vector>

namespace voxsheet::import {

/// Names of the fields that an array becomes: its own for one component; with " x", " y", " z" for three of a
/// vector, else with " 1", " 2", …. A name that `fields` has already gets " (2)", " (3)", …; an empty one is
/// "array".
void appendFields(std::vector<FieldMeta>& fields, const std::string& array, ScalarType type, int components,
                  bool isVector);

/// The last step of a header, when all fields are in it: their types after a resampling, their number and
/// their size. Throws LimitExceeded (subject `name`).
void finishFields(const std::string& name, const std::optional<UniformResampling>& resampling,
                  const ImportLimits& limits, SourceHeader& source);
/// The last part of it, for headers that are resampled otherwise.
void checkTotalBytes(const std::string& name, const ImportLimits& limits, const SourceHeader& source);

/// Cells of an image sit half a voxel in from its points, along the axes that have more than one.
[[nodiscard]] Grid cellGrid(const Grid& points);

} // namespace voxsheet::import
