// NIfTI-1 and NIfTI-2: .nii, .nii.gz, and pairs .hdr/.img, compressed or not; either byte order. Bytes after
// the voxels are allowed (the standard lets programs keep their own data there).
#pragma once

#include "import/source_reader.h"

namespace voxsheet::import {

class NiftiReader final : public SourceReader {
public:
    [[nodiscard]] const char* format() const override { return "nifti"; }
    [[nodiscard]] const char* description() const override { return "NIfTI (.nii, .nii.gz, .hdr with .img)"; }
    [[nodiscard]] bool recognises(const FileHead& head, const ImportOptions& options) const override;
    [[nodiscard]] SourceHeader readHeader(const std::filesystem::path& path, const ImportOptions& options,
                                          const ImportLimits& limits) const override;
    [[nodiscard]] std::vector<std::string> readData(const SourceHeader& header, const ArraySink& sink,
                                                    const ReadProgress& progress) const override;
};

} // namespace voxsheet::import
