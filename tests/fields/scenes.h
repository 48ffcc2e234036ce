// Grids, transfer functions and cameras that the image tests and benches share.
#pragma once

#include "stages/tile_spec.h"
#include "volume/grid.h"

#include <memory>
#include <string>

namespace voxsheet::fields {

enum class Geometry { Isotropic, Anisotropic, Sheared };

[[nodiscard]] const char* nameOf(Geometry geometry);
[[nodiscard]] const char* nameOf(Technique technique);
[[nodiscard]] const char* nameOf(Projection projection);

/// `samples` per axis; spacing 1 (isotropic), 1 x 0.7 x 1.6 (anisotropic), or a triclinic cell (sheared).
[[nodiscard]] Grid gridOf(Geometry geometry, int samples);

/// Over [low, high]: thin material everywhere.
[[nodiscard]] std::shared_ptr<const TransferTable> filledTable(double low, double high);
/// Over [low, high]: only the top of the range can be seen.
[[nodiscard]] std::shared_ptr<const TransferTable> sparseTable(double low, double high);

/// Over [low, high]: nothing but three thin shells, whose opacity rises and falls within 1.2 % of the range.
[[nodiscard]] std::shared_ptr<const TransferTable> peaksTable(double low, double high);

/// Looks at the centre of the grid's box from an oblique direction; the box fills most of the picture.
[[nodiscard]] CameraSpec cameraOf(const Grid& grid, Projection projection, double azimuthDegrees = 30.0,
                                  double elevationDegrees = 25.0);

/// A square picture of the dataset `key` on `grid`.
[[nodiscard]] TileSpec tileOf(const std::string& key, const Grid& grid, Technique technique, int pixels);

} // namespace voxsheet::fields
