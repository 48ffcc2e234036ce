// Gaussian cube files, plain or compressed. The file has its last axis fastest; the arrays have the first
// axis fastest, so that index axes and voxel vectors stay in the order of the file. Positions become Å;
// values are the file's, stored as F64. Not periodic unless the option says so. Several values at a voxel
// (orbitals, or a density and its gradient) become fields.
#pragma once

#include "import/source_reader.h"

namespace voxsheet::import {

class CubeReader final : public SourceReader {
public:
    [[nodiscard]] const char* format() const override { return "cube"; }
    [[nodiscard]] const char* description() const override { return "Gaussian cube (.cube, .cub)"; }
    [[nodiscard]] bool recognises(const FileHead& head, const ImportOptions& options) const override;
    [[nodiscard]] SourceHeader readHeader(const std::filesystem::path& path, const ImportOptions& options,
                                          const ImportLimits& limits) const override;
    /// Holds all fields at once, as the file interleaves them.
    [[nodiscard]] std::vector<std::string> readData(const SourceHeader& header, const ArraySink& sink,
                                                    const ReadProgress& progress) const override;
};

} // namespace voxsheet::import
