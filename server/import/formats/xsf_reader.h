// XSF files (XCrySDen), plain or compressed: their three-dimensional grids become fields. Positions are Å.
// XSF's "general" grids repeat the first samples at the far end of a period: where a spanning vector is a
// lattice translation the repeated samples are dropped and the axis is periodic. Of molecules every sample
// is kept and no axis is periodic.
#pragma once

#include "import/source_reader.h"

namespace voxsheet::import {

class XsfReader final : public SourceReader {
public:
    [[nodiscard]] const char* format() const override { return "xsf"; }
    [[nodiscard]] const char* description() const override { return "XCrySDen grids (.xsf)"; }
    [[nodiscard]] bool recognises(const FileHead& head, const ImportOptions& options) const override;
    /// Also throws Unsupported where the grids differ in size or place.
    [[nodiscard]] SourceHeader readHeader(const std::filesystem::path& path, const ImportOptions& options,
                                          const ImportLimits& limits) const override;
    /// A note says when dropped samples did not repeat the first ones.
    [[nodiscard]] std::vector<std::string> readData(const SourceHeader& header, const ArraySink& sink,
                                                    const ReadProgress& progress) const override;
};

} // namespace voxsheet::import
