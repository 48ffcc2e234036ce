// The header of a PLY file (Turk 1994): which elements follow, and which numbers each has.
#pragma once

#include "volume/scalar_type.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace voxsheet::import {

struct PlyProperty {
    std::string name;
    ScalarType type = ScalarType::F32;
    std::optional<ScalarType> countType; ///< of a list: the type of its length
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties; ///< at least one
};

enum class PlyEncoding { Ascii, LittleEndian, BigEndian };

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::Ascii;
    std::vector<PlyElement> elements;
    std::size_t bytes = 0; ///< of the header itself

    /// The fewest bytes that an element can take in the file.
    [[nodiscard]] std::uint64_t leastBytes(const PlyElement& element) const;
};

/// Throws InvalidInput (subject `file`): damaged; or an element count that the file has no bytes for.
[[nodiscard]] PlyHeader parsePlyHeader(std::string_view bytes, const std::string& file);

} // namespace voxsheet::import
