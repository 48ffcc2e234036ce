// The JSON beside a raw file; its members are documented in raw_reader.h.
#pragma once

#include "import/formats/input_file.h"
#include "volume/grid.h"
#include "volume/scalar_type.h"

#include <cstdint>
#include <string>
#include <vector>

namespace voxsheet::import {

struct RawDescription {
    std::vector<std::int64_t> dims{0, 0, 0};
    ScalarType type = ScalarType::U8;
    std::string file; ///< empty: not said
    bool bigEndian = false;
    std::int64_t skip = 0;
    std::int64_t components = 1;
    std::int64_t steps = 1;
    std::vector<std::string> fields;
    std::vector<double> times;
    glm::dmat4 worldFromIndex{1.0};
    glm::bvec3 periodic{false};
    Centring centring = Centring::Point;
    std::string units;
    bool anatomical = false;
    double valueScale = 1.0;
    double valueOffset = 0.0;
    std::vector<std::string> unknownMembers;
};

/// Throws InvalidInput (subject: the file's name; field: the member at fault).
[[nodiscard]] RawDescription parseRawSidecar(const InputFile& file);

} // namespace voxsheet::import
