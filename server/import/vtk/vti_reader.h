// VTK XML image data (.vti) and rectilinear grids (.vtr), decoded by VTK after a check of our own.
#pragma once

#include "import/source_reader.h"

#include <memory>

namespace voxsheet::import {

/// Single-piece files of every encoding (ascii, binary, appended raw and base64; zlib, LZ4, LZMA). Point
/// data, or cell data where there is none; each component of each numeric array is a field. Rectilinear grids
/// are resampled to uniform ones (formats/rectilinear_axes.h). Other VTK XML files are Unsupported.
[[nodiscard]] std::unique_ptr<SourceReader> makeVtiReader();

inline constexpr const char* kVtkGhosts = "vtkGhostType"; ///< marks what finer patches cover: not for people

/// For data sets that are made of several such files. The first two: whichever there are.
enum class VtiData { PointsFirst, CellsFirst, Points, Cells };

/// As the reader's. Throws Unsupported, too, if there are no arrays of what is wanted.
[[nodiscard]] SourceHeader readVtiHeader(const std::filesystem::path& path, const ImportLimits& limits,
                                         VtiData wanted);
/// Points along the axes of what readVtiHeader described.
[[nodiscard]] glm::ivec3 vtiPointDims(const SourceHeader& header);
/// One field of it. Throws InvalidInput.
[[nodiscard]] std::vector<std::byte> readVtiField(const SourceHeader& header, int field);

} // namespace voxsheet::import
