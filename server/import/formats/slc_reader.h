// SLC, the volumes of VolVis: 8 bits per voxel, slice by slice, plain or run-length coded. A text header, a
// small picture that is passed over, then the slices. x is fastest, then y, then z; the world is the index
// times the unit lengths, nothing is mirrored (as vtkSLCReader). Source: Avila et al., VolVis: A Diversified
// Volume Visualization System, 1994; vtkSLCReader.
#pragma once

#include "import/source_reader.h"

namespace voxsheet::import {

class SlcReader final : public SourceReader {
public:
    [[nodiscard]] const char* format() const override { return "slc"; }
    [[nodiscard]] const char* description() const override { return "VolVis volumes (.slc)"; }
    [[nodiscard]] bool recognises(const FileHead& head, const ImportOptions& options) const override;
    [[nodiscard]] SourceHeader readHeader(const std::filesystem::path& path, const ImportOptions& options,
                                          const ImportLimits& limits) const override;
    [[nodiscard]] std::vector<std::string> readData(const SourceHeader& header, const ArraySink& sink,
                                                    const ReadProgress& progress) const override;
};

} // namespace voxsheet::import
