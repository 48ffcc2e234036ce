// What a dataset holds, in the words of `voxsheet info --json` and `GET /api/v1/datasets`.
#pragma once

#include "engine/camera_frame.h"
#include "volume/dataset.h"

#include <nlohmann/json.hpp>

namespace voxsheet::engine {

/// {kind: "grid", format, dims, spacing, origin, direction (3x3, row-major; its columns are the grid's
/// axes), type (of the source), range (first field and step, raw source numbers), value_scale,
/// value_offset, units: {length, value}, periodic, periodic_axes, centring, box (describeBox), fields:
/// [{name, quantity, unit, type, range, mean, stddev, nan}], steps, times, levels, notes}, and for crystals
/// lattice (rows a, b, c) and atoms [{element, number, position}]. Ranges inside `fields` are in values
/// (after slope and intercept); a field without a finite value has range null.
[[nodiscard]] nlohmann::json describeDataset(const DatasetMeta& meta);

/// {origin, edges: [a, b, c], voxels, firstSample}: the drawn box in the world, from its first corner along
/// the grid's axes; how many voxels long each edge is, and how many from the first corner the first sample
/// sits.
[[nodiscard]] nlohmann::json describeBox(const Grid& grid);

/// Rows a, b, c in world units.
[[nodiscard]] nlohmann::json describeLattice(const glm::dmat3& lattice);

/// {centre, radius, size}: what camera.target and camera.distance are measured from and in, world units; size
/// of the upright box that planes show, null where it is the cell's own.
[[nodiscard]] nlohmann::json describeFrame(const CameraFrame& frame);

/// {low, high, counts, mean, min, max, stddev, nan} of one field and step. Throws NotFound if there is none
/// such.
[[nodiscard]] nlohmann::json describeHistogram(const DatasetMeta& meta, int field, int step);

} // namespace voxsheet::engine
