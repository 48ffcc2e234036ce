// What ImageJ and OME write into the ImageDescription of a TIFF file about the stack that its pages make.
// Sources: ij.io.FileInfo and TiffDecoder of ImageJ; The OME Data Model and XML File, 2016-06.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace voxsheet::import {

struct StackDescription {
    enum class Writer { Unknown, ImageJ, Ome };
    Writer writer = Writer::Unknown;
    std::string pageOrder = "CZT"; ///< what varies from page to page, fastest first: channel, slice, time
    std::optional<std::int64_t> images;
    std::optional<std::int64_t> channels;
    std::optional<std::int64_t> slices;
    std::optional<std::int64_t> frames;
    /// Of the voxels along x, y, z, > 0, in lengthUnit. ImageJ leaves x and y to the resolution tags.
    std::optional<double> spacingX, spacingY, spacingZ;
    std::optional<double> frameInterval; ///< > 0
    std::string lengthUnit;              ///< "µm", "mm", …; empty: not said, or pixels
    double lengthScale = 1.0;            ///< lengthUnits per unit of the file: 10 for cm, which become mm
    double valueScale = 1.0;             ///< value = valueScale * stored + valueOffset
    double valueOffset = 0.0;
    std::string valueUnit;
};

/// Counts as written: >= 1, not compared with the pages. Throws InvalidInput (subject `name`) for counts and
/// lengths that are not possible.
[[nodiscard]] StackDescription parseStackDescription(const std::string& name, const std::string& text);

} // namespace voxsheet::import
