// A cell's style with every key present and typed: what the engine turns into a picture.
#pragma once

#include "sheet/style_value.h"
#include "volume/transfer_function.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace voxsheet::sheet {

enum class Technique { Slices, Raycast, Mip, Surface, Isosurface, Plane };
enum class Projection { Perspective, Orthographic };
enum class RangeMode { Auto, Own, Shared, Fixed, Percentile, Symmetric };
/// Level of detail of a picture at rest: full = level 0, half = level 1, quarter = level 2, eighth = level 3
/// (or the coarsest that there is).
enum class Quality { Full, Half, Quarter, Eighth };
enum class Annotations { None, Names, All };

/// Whose centre and size the camera's lengths refer to.
enum class FrameMode {
    Fit,    ///< the cell's own
    Centre, ///< its own centre, and the largest size of the cells with this mode
    World   ///< one centre and size for all of them
};

/// Lengths in bounding radii about a centre, by default the cell's own, so that heads and crystals can be
/// linked.
struct CameraStyle {
    double azimuthDegrees = 0.0;
    double elevationDegrees = 0.0; ///< [-90, 90]
    double rollDegrees = 0.0;
    double distanceRadii = 1.0;  ///< > 0
    glm::dvec3 targetRadii{0.0}; ///< offset of the looked-at point from the centre, along the world axes
    double fovDegrees = 30.0;    ///< full vertical angle
    Projection projection = Projection::Perspective;
    FrameMode frame = FrameMode::Fit;
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
    bool symmetric = false; ///< widened to reach as far below 0 as above; not if Fixed
    bool operator==(const RangeStyle&) const = default;
};

/// Lengths and positions of clip planes, box and object.
enum class ClipUnits {
    Fraction, ///< of the cell's own box, so that volumes of different size and place can be linked
    World
};
enum class ClipMode { Probe, Clip };
enum class ClipRepresentation { Distance, Binary };

/// With `fraction`: a plane's position runs from 0 at the box's first corner along the normal to 1 at its
/// last; the box's ends are fractions along the volume's own axes; the clip object's unit is half the
/// shortest edge of the box and its origin the box's centre. With `world`: world units, the box along the
/// world axes, the object in its own coordinates.
struct ClipStyle {
    struct Plane {
        glm::dvec3 normal{1.0, 0.0, 0.0}; ///< along the world axes, not zero, of any length
        double position = 0.5;            ///< what lies beyond it, along the normal, is kept
        bool operator==(const Plane&) const = default;
    };
    struct Box {
        glm::dvec3 low{0.0};
        glm::dvec3 high{1.0};
        bool operator==(const Box&) const = default;
    };
    /// Scale first, then rotation about x, y, z in this order, then translation.
    struct Transform {
        glm::dvec3 translation{0.0};
        glm::dvec3 rotationDegrees{0.0};
        glm::dvec3 scale{1.0};
        bool operator==(const Transform&) const = default;
    };

    ClipUnits units = ClipUnits::Fraction;
    std::vector<Plane> planes; ///< at most eight
    std::optional<Box> box;
    /// Empty: none. A shape (sphere, ellipsoid, box, cylinder, torus), a dataset that was made from a mesh,
    /// or a comparison of a cell or dataset with a number ("B1 > 0.4", "'scan 2' <= -100").
    std::string shape;
    ClipMode mode = ClipMode::Clip;
    ClipRepresentation representation = ClipRepresentation::Distance;
    Transform transform;
    bool operator==(const ClipStyle&) const = default;
};

enum class IsosurfaceMethod { Refined, AlphaTest };

struct IsosurfaceStyle {
    std::vector<double> values;         ///< 1 to 8; empty: chosen from the data
    bool mirror = false;                ///< every value v also as -v
    std::vector<Colour> colours;        ///< by surface, the last one repeats; empty: the transfer function's
    std::vector<double> opacities{1.0}; ///< by surface, the last one repeats
    std::string colourBy;               ///< empty: none; a cell ("B1") or a dataset's name
    bool caps = false;
    IsosurfaceMethod method = IsosurfaceMethod::Refined;
    bool operator==(const IsosurfaceStyle&) const = default;
};

/// Volumes that are blended with the cell's own (raycast only).
struct LayersStyle {
    std::string volumes;              ///< empty: none; else as parseLayers()
    std::vector<double> weights{1.0}; ///< the cell's own first, the last one repeats; [0, 1]
    bool operator==(const LayersStyle&) const = default;
};

/// Values shown as categories.
struct LabelsStyle {
    bool show = false;
    std::string names; ///< empty: none; else as parseLabelNames()
    std::set<std::int64_t> hidden;
    double opacity = 1.0; ///< per unit length
    bool operator==(const LabelsStyle&) const = default;
};

/// A second volume painted over technique plane.
struct OverlayStyle {
    std::string volume; ///< empty: none; a cell ("B1") or a dataset's name
    std::string map;    ///< "labels": categories
    double opacity = 0.6;
    std::optional<double> threshold; ///< smaller values are not shown
    std::optional<double> min;       ///< of its range; not set: the data's
    std::optional<double> max;       ///< likewise; min < max where both are set
    bool operator==(const OverlayStyle&) const = default;
};

/// Normals along z, y and x of the world, PlaneStyle::normal, or that of the lattice planes PlaneStyle::hkl.
enum class PlaneAxis { Axial, Coronal, Sagittal, Custom, Hkl };
enum class PlaneInterpolation { Linear, Nearest };

/// Of the crosshair: fractions of the drawn box's extents along the world's axes, or world coordinates.
enum class PlaneUnits { Fraction, World };

/// The cut that technique plane shows.
struct PlaneStyle {
    PlaneAxis axis = PlaneAxis::Axial;
    glm::dvec3 normal{0.0, 0.0, 1.0}; ///< Custom: along the world axes, not zero, of any length
    double position = 0.5; ///< from 0 at the drawn box's first corner along the normal to 1 at its last
    PlaneInterpolation interpolation = PlaneInterpolation::Linear;
    std::optional<glm::dvec3> crosshair; ///< set: the plane passes through it, wherever `position` is
    PlaneUnits units = PlaneUnits::Fraction;
    glm::dvec3 hkl{1.0}; ///< Hkl: Miller indices, whole numbers, not all zero
    bool operator==(const PlaneStyle&) const = default;
};

/// Which stretch of a periodic volume is drawn.
struct PeriodicStyle {
    glm::dvec3 shift{0.0};     ///< moves the data inside the box, in fractions of the cell
    glm::dvec3 replicate{1.0}; ///< periods per axis, whole numbers in [1, 8]
    bool operator==(const PeriodicStyle&) const = default;
};

enum class BondReach { None, Inside, Across };

/// What of a crystal stands in the picture.
struct CrystalStyle {
    bool cell = false;
    bool atoms = false;
    BondReach bonds = BondReach::None;
    double radius = 0.5; ///< of covalent radii
    bool operator==(const CrystalStyle&) const = default;
};

enum class ShadingModel { Auto, None, Phong }; ///< Auto: Phong for isosurfaces, none otherwise
enum class GradientSource { Auto, Texture, OnTheFly };
enum class LightFrame { View, World };

struct ShadingStyle {
    ShadingModel model = ShadingModel::Auto;
    GradientSource gradient = GradientSource::Auto;
    double ambient = 0.25;
    double diffuse = 0.75;
    double specular = 0.25;
    double shininess = 24.0;
    bool operator==(const ShadingStyle&) const = default;
};

struct LightStyle {
    double head = 1.0;                  ///< intensity of the head light
    std::vector<glm::dvec3> directions; ///< towards each light, not zero, of any length; at most four
    LightFrame frame = LightFrame::View;
    double intensity = 1.0; ///< of each directional light
    bool operator==(const LightStyle&) const = default;
};

enum class TextureFormat { Auto, Half };

/// A field by name or by index.
using FieldChoice = std::variant<std::int64_t, std::string>;

struct TypedStyle {
    Technique technique = Technique::Raycast;
    CameraStyle camera;
    TransferStyle transfer;
    RangeStyle range;
    double sampleDistanceVoxels = 0.5; ///< voxels of the drawn level
    bool preIntegrated = false;
    bool adaptiveSampling = true;
    Quality quality = Quality::Full;
    std::optional<int> level; ///< of the live picture; not set: by policy
    Colour background;
    Annotations annotations = Annotations::All;
    PeriodicStyle periodic;
    CrystalStyle crystal;
    ClipStyle clip;
    IsosurfaceStyle isosurface;
    LabelsStyle labels;
    LayersStyle layers;
    OverlayStyle overlay;
    PlaneStyle plane;
    ShadingStyle shading;
    LightStyle light;
    TextureFormat textureFormat = TextureFormat::Auto;
    /// Picking takes the first sample at least this opaque; not set: where the accumulated opacity passes one
    /// half.
    std::optional<double> probeOpacity;
    FieldChoice field{std::int64_t{0}};
    int timeStep = 0;
    bool operator==(const TypedStyle&) const = default;
};

/// Keys that must agree: transfer.cut1 < transfer.cut2; range.min < range.max; percentiles within [0, 100];
/// periodic.replicate whole; normals (of a plane only where plane.axis is custom), directions and scales not
/// zero; where plane.axis is hkl, plane.hkl whole and not zero; overlay.min < overlay.max; labels.names as
/// parseLabelNames(); clip.box low < high. Throws InvalidInput with the field at fault.
void requireConsistent(const TypedStyle& style);

} // namespace voxsheet::sheet
