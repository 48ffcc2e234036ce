// What an XSF file (XCrySDen) holds: a structure and grids of numbers.
// Format: http://www.xcrysden.org/doc/XSF.html.
#pragma once

#include "import/formats/geometry.h"
#include "import/formats/input_file.h"
#include "import/formats/text_scanner.h"
#include "import/source_reader.h"
#include "volume/dataset.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace voxsheet::import {

/// A DATAGRID_3D. Its samples lie on both ends of the spanning vectors.
struct XsfGrid {
    std::string name;                      ///< what follows DATAGRID_3D_; may be empty
    std::array<std::int64_t, 3> samples{}; ///< as in the file, each >= 1, the first fastest
    glm::dvec3 origin{0.0};                ///< Å
    AxisColumns spanning{};                ///< Å, from the first to the last sample
    std::uint64_t dataPosition = 0;        ///< of the first value, in the decompressed text

    [[nodiscard]] std::uint64_t values() const {
        return static_cast<std::uint64_t>(samples[0] * samples[1] * samples[2]);
    }
};

struct XsfContents {
    int periodicAxes = 0;                 ///< 0 molecule, 1 polymer (along a), 2 slab (a and b), 3 crystal
    std::optional<AxisColumns> primitive; ///< Å
    std::vector<Atom> atoms;              ///< Å
    std::vector<XsfGrid> grids;           ///< at least one
    std::vector<std::string> notes;
};

/// The first 64 KiB begin with keywords of XSF.
[[nodiscard]] bool looksLikeXsf(std::string_view head);

/// Reads the whole text and passes over the values. Throws InvalidInput, Unsupported (an animation; no
/// three-dimensional grid), LimitExceeded.
[[nodiscard]] XsfContents readXsfContents(const InputFile& file, TextScanner& text,
                                          const ImportLimits& limits);

} // namespace voxsheet::import
