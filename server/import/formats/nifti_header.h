// NIfTI-1 and NIfTI-2 headers. Formats: nifti1.h and nifti2.h of https://nifti.nimh.nih.gov (the comments are
// the standard).
#pragma once

#include "volume/grid.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace voxsheet::import {

/// The members of both versions that a volume needs, in native byte order.
struct NiftiHeader {
    int version = 1;
    bool bigEndian = false;
    bool singleFile =
        true; ///< "n+1", "n+2": the voxels are in the header's file at voxOffset; else in the .img file
    int datatype = 0;
    int bitsPerVoxel = 0;
    std::array<std::int64_t, 8> dim{}; ///< dim[0] axes used
    std::array<double, 8> pixdim{};    ///< pixdim[0] is the sign of the qform's third axis
    double voxOffset = 0.0;
    double slope = 0.0;
    double intercept = 0.0;
    int unitsCode = 0;
    double timeOffset = 0.0;
    int qformCode = 0;
    int sformCode = 0;
    std::array<double, 3> quaternion{}; ///< b, c, d
    std::array<double, 3> qOffset{};
    std::array<double, 12> sform{}; ///< three rows of four
};

inline constexpr std::size_t kNifti1Bytes = 348;
inline constexpr std::size_t kNifti2Bytes = 540;

enum class NiftiKind { None, Nifti, Analyze };

/// By size field and magic. Analyze: the size is right, the magic is missing.
[[nodiscard]] NiftiKind niftiKind(std::string_view head);

/// `head`: at least the first 540 bytes, or all there are. Throws InvalidInput or Unsupported (subject
/// `name`).
[[nodiscard]] NiftiHeader parseNiftiHeader(const std::string& name, std::string_view head);

/// worldFromIndex in the header's length unit, and whether it is anatomical (RAS+).
struct NiftiPlacement {
    glm::dmat4 worldFromIndex{1.0};
    bool anatomical = false;
    std::string note; ///< empty when nothing is odd
};

/// sform, else qform, else pixdim alone. Throws InvalidInput (subject `name`) if the one that is used is
/// impossible.
[[nodiscard]] NiftiPlacement niftiPlacement(const std::string& name, const NiftiHeader& header);

} // namespace voxsheet::import
