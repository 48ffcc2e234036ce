// VASP's grids: CHGCAR, CHG, AECCAR0..2, PARCHG, LOCPOT, ELFCAR, plain or compressed. The grid is periodic
// along all axes; positions are Å. Densities are stored times the cell volume: DatasetMeta gets valueScale =
// 1 / volume, the arrays hold the numbers of the file. Spin-polarised files give a second field
// (non-collinear ones four). Of several frames the first is read.
#pragma once

#include "import/source_reader.h"

namespace voxsheet::import {

class ChgcarReader final : public SourceReader {
public:
    [[nodiscard]] const char* format() const override { return "chgcar"; }
    [[nodiscard]] const char* description() const override {
        return "VASP grids (CHGCAR, LOCPOT, AECCAR, PARCHG, ELFCAR)";
    }
    [[nodiscard]] bool recognises(const FileHead& head, const ImportOptions& options) const override;
    [[nodiscard]] SourceHeader readHeader(const std::filesystem::path& path, const ImportOptions& options,
                                          const ImportLimits& limits) const override;
    [[nodiscard]] std::vector<std::string> readData(const SourceHeader& header, const ArraySink& sink,
                                                    const ReadProgress& progress) const override;
};

} // namespace voxsheet::import
