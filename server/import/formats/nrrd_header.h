// NRRD headers. Format: http://teem.sourceforge.net/nrrd/format.html (sections "Basic field specifications",
// "Per-axis field specifications", "Space and orientation information", "Detached headers").
#pragma once

#include "import/formats/input_file.h"
#include "volume/scalar_type.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace voxsheet::import {

enum class NrrdEncoding { Raw, Ascii, Hex, Gzip, Bzip2 };

struct NrrdAxis {
    std::int64_t size = 0;
    std::string kind;  ///< lower case; empty when not given
    std::string unit;  ///< of the spacing; empty when not given
    bool cell = false; ///< centring "cell"
    std::optional<double> spacing;
    std::optional<double> min;
    std::optional<double> max;
    std::optional<glm::dvec3> direction; ///< in the file's space; 2D directions have z = 0; none: not spatial
};

struct NrrdHeader {
    std::vector<NrrdAxis> axes; ///< fastest first
    ScalarType type = ScalarType::U8;
    NrrdEncoding encoding = NrrdEncoding::Raw;
    bool bigEndian = false;
    std::int64_t lineSkip = 0;
    std::int64_t byteSkip = 0; ///< -1: the voxels are at the end
    std::string space;         ///< long lower-case name ("left-posterior-superior") without "-time"; or empty
    std::string spaceUnit;     ///< if all axes of the space have the same
    glm::dvec3 spaceOrigin{0.0};
    bool hasDirections = false;
    std::string sampleUnit;
    std::vector<std::string> dataFiles;           ///< as named; empty: the voxels follow the header
    std::map<std::string, std::string> keyValues; ///< free pairs (`KEY:=VALUE`) of segments, as written
    std::uint64_t dataOffset = 0;                 ///< of an attached header, after its blank line
};

/// Throws InvalidInput or Unsupported (subject: the file's name).
[[nodiscard]] NrrdHeader parseNrrdHeader(const InputFile& file);

} // namespace voxsheet::import
