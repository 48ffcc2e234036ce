// Several files as one dataset: a stack, whose files are slices or equally thick slabs of one volume along z,
// or time steps; both in the order of the files. Unless asked otherwise, single slices (dims.z = 1, one step)
// are stacked and volumes are steps.
#pragma once

#include "import/source_reader.h"

#include <optional>
#include <string>
#include <vector>

namespace voxsheet::import {

struct SeriesPart {
    const SourceReader* reader = nullptr;
    SourceHeader header;
};

/// What the parts are together: `files` of all, no plan. Slices lie where their files say; where all files
/// say the same place, one after the other at the distance of the first file's slices, with a note. Files of
/// one step become steps at their own times if those rise, else at 0, 1, 2, …. Throws InvalidInput, naming
/// the file, if a part differs from the first in dims, type, fields, scaling or (volumes) place, or if slices
/// are not equally spaced; LimitExceeded if they are larger than `limits` together.
/// \param kind  absent: as the files suggest
[[nodiscard]] SourceHeader combinedHeader(const std::vector<SeriesPart>& parts, const ImportLimits& limits,
                                          std::optional<SeriesKind> kind = std::nullopt);

/// Reads all parts; `header` is their combinedHeader of the same kind. Slices are held until the last file is
/// read. Throws and returns as SourceReader::readData.
[[nodiscard]] std::vector<std::string> readSeries(const std::vector<SeriesPart>& parts,
                                                  const SourceHeader& header, const ArraySink& sink,
                                                  const ReadProgress& progress,
                                                  std::optional<SeriesKind> kind = std::nullopt);

} // namespace voxsheet::import
