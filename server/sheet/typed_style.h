// A cell's style with every key present and typed: what the engine turns into a picture.
#pragma once

#include "sheet/style_value.h"
#include "volume/transfer_function.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace voxsheet::sheet {

enum class Technique { Slices, Raycast, Mip };
enum class Projection { Perspective, Orthographic };
enum class RangeMode { Auto, Own, Shared, Fixed, Percentile, Symmetric };
/// Level of detail of a picture at rest: full = level 0, half = level 1, quarter = level 2, eighth = level 3
/// (or the coarsest that there is).
enum class Quality { Full, Half, Quarter, Eighth };
enum class Annotations { None, Names, All };

/// Lengths in bounding radii of the cell's own dataset about its own centre, so that heads and crystals can
/// be linked.
struct CameraStyle {
    double azimuthDegrees = 0.0;
    double elevationDegrees = 0.0; ///< [-90, 90]
    double rollDegrees = 0.0;
    double distanceRadii = 1.0;  ///< > 0
    glm::dvec3 targetRadii{0.0}; ///< offset of the looked-at point from the centre, along the world axes
    double fovDegrees = 30.0;    ///< full vertical angle
    Projection projection = Projection::Perspective;
    bool operator==(const CameraStyle&) const = default;
};

struct TransferStyle {
    std::string map;
    std::optional<OpacityStops> opacity; ///< not set: the map's own if it brings any, else opacityRamp()
    std::optional<ColourStops> points;   ///< set: used instead of the map
    double cut1 = 0.25;                  ///< < cut2
    double cut2 = 0.75;
    TransferShape shape = TransferShape::Piecewise;
    std::optional<double> unitLengthWorld; ///< not set: the mean level-0 voxel edge
    Colour nan;
    std::optional<Colour> below;
    std::optional<Colour> above;
    bool operator==(const TransferStyle&) const = default;
};

/// Clear in the lowest tenth of the range, then rising to 0.25 per unit length: a first look at unknown data.
[[nodiscard]] OpacityStops opacityRamp();

struct RangeStyle {
    RangeMode mode = RangeMode::Auto;
    std::optional<double> min; ///< Fixed: a value; Percentile: 0 to 100; not set: the data's, or 0.5 %
    std::optional<double> max; ///< Fixed: a value; Percentile: 0 to 100; not set: the data's, or 99.5 %
    ValueScale scale = ValueScale::Linear;
    bool operator==(const RangeStyle&) const = default;
};

/// A field by name or by index.
using FieldChoice = std::variant<std::int64_t, std::string>;

struct TypedStyle {
    Technique technique = Technique::Raycast;
    CameraStyle camera;
    TransferStyle transfer;
    RangeStyle range;
    double sampleDistanceVoxels = 0.5; ///< voxels of the drawn level
    Quality quality = Quality::Full;
    Colour background;
    Annotations annotations = Annotations::All;
    FieldChoice field{std::int64_t{0}};
    int timeStep = 0;
    bool operator==(const TypedStyle&) const = default;
};

/// Keys that must agree: transfer.cut1 < transfer.cut2; range.min < range.max; percentiles within [0, 100].
/// Throws InvalidInput with the field at fault.
void requireConsistent(const TypedStyle& style);

} // namespace voxsheet::sheet
