// Chemical elements: what pictures of crystals need to know of them.
#pragma once

#include <glm/glm.hpp>

#include <string_view>

namespace voxsheet {

inline constexpr int kHeaviestElement = 118;

struct Element {
    const char* symbol = "";
    /// Å: Cordero et al., "Covalent radii revisited", Dalton Trans. 2008, 2832; 1.6 for the elements beyond
    /// curium, for which there is none.
    double covalentRadius = 0.0;
    glm::dvec3 colour{0.0}; ///< sRGB, [0, 1]: the customary colours, in the version of Jmol
};

/// Any other number is an unknown element: no symbol, a radius of 1 Å, deep pink.
[[nodiscard]] Element elementOf(int atomicNumber) noexcept;

/// Of a chemical symbol ("Na"); 0 if it is none.
[[nodiscard]] int atomicNumber(std::string_view symbol) noexcept;

} // namespace voxsheet
