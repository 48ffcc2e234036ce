// Voxels without a header: described by the options rawDims and rawType, or by a JSON file beside them.
//
// The sidecar of "x.raw" is "x.json" or "x.raw.json"; either may be opened. An object with
//   dims        [x, y, z], needed                     type        "u8" … "f64" (also "uint8", "float32", …),
//   needed file        name of the data; default: the sidecar's name without .json, or with .raw in its place
//   endian      "little" (default) or "big"           skip        bytes before the first voxel, default 0
//   components  interleaved values, default 1         steps       whole volumes after each other, default 1
//   fields      names, one per component              times       one per step
//   spacing     [x, y, z], default 1                  origin      [x, y, z], default 0
//   direction   9 numbers, row-major, columns are the grid's axes (as `info --json`), default identity
//   periodic    [x, y, z] of true/false               centring    "point" (default) or "cell"
//   units       of length, e.g. "mm"                  anatomical  true: the world is RAS+
//   value_scale, value_offset                         value = value_scale * stored + value_offset
// The data's size must be exact.
#pragma once

#include "import/source_reader.h"

namespace voxsheet::import {

class RawReader final : public SourceReader {
public:
    [[nodiscard]] const char* format() const override { return "raw"; }
    [[nodiscard]] const char* description() const override {
        return "raw voxels with a JSON sidecar (.raw with .json)";
    }
    [[nodiscard]] bool recognises(const FileHead& head, const ImportOptions& options) const override;
    [[nodiscard]] SourceHeader readHeader(const std::filesystem::path& path, const ImportOptions& options,
                                          const ImportLimits& limits) const override;
    [[nodiscard]] std::vector<std::string> readData(const SourceHeader& header, const ArraySink& sink,
                                                    const ReadProgress& progress) const override;
};

} // namespace voxsheet::import
