// What a VTK XML image or rectilinear grid file says about itself, and whether its data are all there. VTK's
// own reader loads truncated files without an error, so this stands before it.
#pragma once

#include "import/formats/input_file.h"
#include "volume/grid.h"
#include "volume/scalar_type.h"

#include <cstdint>
#include <string>
#include <vector>

namespace voxsheet::import {

enum class VtiEncoding { Ascii, Inline, Appended };

struct VtiArray {
    std::string name;
    ScalarType type = ScalarType::F32;
    int components = 1;
    bool ofCells = false;
    bool isVector = false; ///< marked as Vectors or Normals
    VtiEncoding encoding = VtiEncoding::Ascii;
    std::uint64_t appendedOffset = 0; ///< Appended: from the start of the appended data
    std::uint64_t inlineCount = 0;    ///< Ascii: numbers; Inline: base64 digits
    std::string inlineHead;           ///< Inline: the first base64 digits
};

struct VtiHeader {
    Grid points; ///< of a rectilinear grid: dims alone
    bool rectilinear = false;
    std::vector<VtiArray> coordinates; ///< of a rectilinear grid: along x, y, z, in their order
    bool bigEndian = false;
    std::size_t headerIntegerBytes = 4; ///< of the lengths before binary data
    bool compressed = false;
    bool appendedBase64 = false;
    std::uint64_t appendedStart = 0; ///< file position of offset 0; 0 = there is none
    std::vector<VtiArray> arrays;    ///< numeric, points and cells
    std::vector<std::string> notes;
};

/// Parses the XML around the data; inline data are counted, not kept. Throws InvalidInput (damaged, a
/// document type, no VTK file), Unsupported (neither image nor rectilinear grid; several
/// pieces).
[[nodiscard]] VtiHeader parseVtiHeader(const InputFile& file);

/// Compares the lengths that stand before an array's data with `expectedBytes` and with what the file holds.
/// Throws InvalidInput.
void checkVtiArray(const InputFile& file, const VtiHeader& header, const VtiArray& array,
                   std::uint64_t expectedBytes);

} // namespace voxsheet::import
