// Which path each technique takes on this device: forced by the user, else calibrated (measured by
// `voxsheet bench calibrate`), else by rule. Pure.
#pragma once

#include "resolution/measured_median.h"
#include "techniques/render_paths.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace voxsheet {

enum class PathReason { Rule, Calibrated, Forced };

/// "rule", "calibrated", "forced".
[[nodiscard]] const char* reasonName(PathReason reason);

/// What a calibration found best.
struct CalibratedPath {
    Technique technique = Technique::Raycast;
    RenderPath path = RenderPath::Shader;
    double ratio = 1.0; ///< time of the fastest other path / time of this one, > 0; 1 without another
    std::string date;   ///< of the measurement: "2026-01-31"

    bool operator==(const CalibratedPath&) const = default;
};

struct PathChoice {
    Technique technique = Technique::Raycast;
    RenderPath path = RenderPath::Shader;
    PathReason reason = PathReason::Rule;
    std::vector<RenderPath> candidates;       ///< never empty
    std::optional<CalibratedPath> calibrated; ///< Calibrated only
};

using ForcedPaths = std::map<Technique, RenderPath>;

/// One for each technique. What is calibrated counts where it names a candidate. Throws InvalidInput (field
/// --path) if a forced path is none.
[[nodiscard]] std::vector<PathChoice>
choosePaths(const RenderPaths& rule, std::span<const CalibratedPath> calibrated, const ForcedPaths& forced);
[[nodiscard]] RenderPaths pathsOf(std::span<const PathChoice> choices);

/// Of "raycast=shader", one each; a later one of the same technique counts. Throws InvalidInput (field
/// --path), naming what there is.
[[nodiscard]] ForcedPaths parseForcedPaths(const std::vector<std::string>& texts);

/// Pixels of a path's picture that are more than 1/255 from those of the shaders' one.
struct PictureDistance {
    std::size_t pixelsApart = 0;
    std::size_t pixels = 0;

    /// A few may be: rays that touch the edge of a face, a voxel or a cut, or graze a surface, which 32-bit
    /// floats rounded in another order decide differently. No more than 2 and 0.4 %, as the image tests
    /// allow.
    [[nodiscard]] bool isSamePicture() const;
};

struct MeasuredPath {
    RenderPath path = RenderPath::Shader;
    MeasuredMedian ms; ///< of a picture of each scene, from state to host pixels
    PictureDistance distance;
};

/// The path that a calibration takes, and its ratio; no date. The rule's, unless it draws another picture
/// than the shaders, or a path that draws the same one is more than 5 % faster even by the nearest ends of
/// the confidence intervals. Throws InternalError if the rule's path or the shaders were not measured.
[[nodiscard]] CalibratedPath fastestPath(Technique technique, RenderPath rule,
                                         std::span<const MeasuredPath> measured);

} // namespace voxsheet
