// VASP's volumetric files: the structure (as in POSCAR) and the grids that follow.
// Formats: https://www.vasp.at/wiki/index.php/CHGCAR, …/LOCPOT, …/POSCAR.
#pragma once

#include "import/formats/text_scanner.h"
#include "volume/dataset.h"

#include <cstdint>
#include <optional>
#include <string>

namespace voxsheet::import {

struct ChgcarStructure {
    Crystal crystal; ///< world: Cartesian Ångström as in the file
    std::string firstLine;
    std::vector<std::string> notes;
};

/// What a file of the family holds; by its name, as its contents do not tell.
struct ChgcarKind {
    std::string quantity;
    std::string unit;           ///< after division, where values are divided
    bool divideByVolume = true; ///< the file holds value * cell volume
    bool told = true;           ///< the name said it
    std::vector<std::string> oneGrid;
    std::vector<std::string> twoGrids; ///< field names of a spin-polarised file
};

/// The first 64 KiB look like a structure: scale, three vectors, numbers of atoms, coordinate system.
[[nodiscard]] bool looksLikeChgcar(std::string_view head);
/// The file name holds one of VASP's names: "CHGCAR_3", "LOCPOT.gz", "NaMgF3_AECCAR0".
[[nodiscard]] bool namedLikeChgcar(const std::string& fileName);
[[nodiscard]] ChgcarKind chgcarKind(const std::string& fileName);

/// Reads up to the last atom. Throws InvalidInput (subject `name`).
[[nodiscard]] ChgcarStructure readChgcarStructure(const std::string& name, TextScanner& text);

/// Passes over augmentation data and blank lines to the next line of three whole numbers. The first grid:
/// any; later ones: only `expected`. nullopt at the end of the file. `frameLine`: a line that begins a new
/// frame; sets `newFrame` and stops.
[[nodiscard]] std::optional<glm::ivec3> findChgcarGrid(TextScanner& text,
                                                       const std::optional<glm::ivec3>& expected,
                                                       const std::string& frameLine, bool& newFrame);

} // namespace voxsheet::import
