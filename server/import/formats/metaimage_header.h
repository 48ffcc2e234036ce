// MetaImage headers. Format: https://itk.org/Wiki/ITK/MetaIO/Documentation ("Reference: Tags of MetaImage").
#pragma once

#include "import/formats/input_file.h"
#include "volume/scalar_type.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace voxsheet::import {

struct MetaImageHeader {
    std::vector<std::int64_t> dims; ///< 1 to 4, fastest first
    std::vector<double> spacing;    ///< one per axis
    std::vector<double> offset;     ///< one per axis; LPS where `oriented`
    std::vector<double> transform;  ///< NDims x NDims; row i is the direction of axis i; LPS where `oriented`
    bool oriented = false;          ///< the file says how the axes lie in the patient
    ScalarType type = ScalarType::U8;
    int channels = 1;
    bool bigEndian = false;
    bool binary = true;
    bool compressed = false;
    std::optional<std::int64_t> compressedBytes;
    std::int64_t headerSize = 0;        ///< bytes to skip in the data file; -1: the voxels are at its end
    std::vector<std::string> dataFiles; ///< as named; empty: LOCAL
    std::uint64_t dataOffset = 0;       ///< of LOCAL voxels
};

/// Throws InvalidInput or Unsupported (subject: the file's name).
[[nodiscard]] MetaImageHeader parseMetaImageHeader(const InputFile& file);

} // namespace voxsheet::import
