// NRRD, attached (.nrrd) and detached (.nhdr): raw, text, hex, gzip and bzip2; one file, a list or a pattern
// of files. Raw data that are longer than the header says (by more than a line end) are an error: they mostly
// mean a wrong header.
#pragma once

#include "import/source_reader.h"

namespace voxsheet::import {

class NrrdReader final : public SourceReader {
public:
    [[nodiscard]] const char* format() const override { return "nrrd"; }
    [[nodiscard]] const char* description() const override { return "NRRD (.nrrd, .nhdr)"; }
    [[nodiscard]] bool recognises(const FileHead& head, const ImportOptions& options) const override;
    [[nodiscard]] SourceHeader readHeader(const std::filesystem::path& path, const ImportOptions& options,
                                          const ImportLimits& limits) const override;
    [[nodiscard]] std::vector<std::string> readData(const SourceHeader& header, const ArraySink& sink,
                                                    const ReadProgress& progress) const override;
};

} // namespace voxsheet::import
