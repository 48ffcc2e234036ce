// MetaImage (.mha, .mhd): voxels in the file, in one file beside it, or in a list or pattern of files; raw,
// zlib or text. Raw data that are longer than the header says are an error: they mostly mean a wrong header
// (HeaderSize skips bytes).
#pragma once

#include "import/source_reader.h"

namespace voxsheet::import {

class MetaImageReader final : public SourceReader {
public:
    [[nodiscard]] const char* format() const override { return "metaimage"; }
    [[nodiscard]] const char* description() const override { return "MetaImage (.mha, .mhd)"; }
    [[nodiscard]] bool recognises(const FileHead& head, const ImportOptions& options) const override;
    [[nodiscard]] SourceHeader readHeader(const std::filesystem::path& path, const ImportOptions& options,
                                          const ImportLimits& limits) const override;
    [[nodiscard]] std::vector<std::string> readData(const SourceHeader& header, const ArraySink& sink,
                                                    const ReadProgress& progress) const override;
};

} // namespace voxsheet::import
