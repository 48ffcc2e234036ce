#include "sheet/style_keys.h"

#include "base/errors.h"
#include "sheet/style_key_builders.h"
#include "sheet/typed_style.h"

#include <algorithm>

namespace voxsheet::sheet {

namespace {

void addTechnique(std::vector<KeySpec>& keys) {
    keys.push_back(choice(
        "technique", {"slices", "raycast", "mip", "surface", "isosurface", "plane"}, "raycast", "Technique",
        "How the volume is drawn: view-aligned slices blended back to front, a ray through every "
        "pixel, the largest value along each ray, the outer and cut faces, isosurfaces, or one plane through "
        "the volume in a flat view."));
}

void addCamera(std::vector<KeySpec>& keys) {
    const std::size_t first = keys.size();
    const std::string group = "Camera";
    // The default looks from the front right of a patient in RAS+ axes, whose front is +y: a head shows its
    // face.
    keys.push_back(number(
        "camera.azimuth", "degrees", -36000, 36000, 150.0, group,
        "Turns the eye about the z axis, counter-clockwise seen from above; at 0 it looks along +y, at "
        "90 along -x."));
    keys.push_back(number("camera.elevation", "degrees", -90, 90, 20.0, group,
                          "Height of the eye above the horizon; at 90 it looks straight down."));
    keys.push_back(number("camera.roll", "degrees", -36000, 36000, 0.0, group,
                          "Turns the eye clockwise about its line of sight."));
    keys.push_back(
        number("camera.distance", "bounding radii", 0.001, 1000, 3.9, group,
               "From the eye to the point looked at, in bounding radii of the cell's own volume; 3.9 shows "
               "all of it at 30 degrees from every side."));
    KeySpec target = typed(
        "camera.target", KeyType::Vector3, glm::dvec3(0.0), group, "vector",
        "The point looked at: an offset from the centre of the cell's own volume along the world axes.");
    target.unit = "bounding radii";
    target.min = -100.0;
    target.max = 100.0;
    keys.push_back(target);
    keys.push_back(
        number("camera.fov", "degrees", 1, 150, 30.0, group,
               "Full vertical angle of view. Orthographic pictures show the height that perspective shows at "
               "the point looked at."));
    keys.push_back(choice("camera.projection", {"perspective", "orthographic"}, "perspective", group,
                          "Perspective, or parallel lines of sight."));
    keys.push_back(choice(
        "camera.frame", {"fit", "centre", "world"}, "fit", group,
        "What distance and target refer to: the cell's own centre and size (fit: every volume fills its "
        "picture); its own centre and the largest size of the cells that are linked so (centre: one scale "
        "for "
        "all); or one centre and size for all of them (world: every cell shows the same place)."));
    for (std::size_t i = first; i < keys.size(); ++i)
        keys[i].scope = KeyScope::View;
}

void addTransfer(std::vector<KeySpec>& keys, std::vector<std::string> maps) {
    const std::string group = "Transfer function";
    const std::vector<std::string> cutShapes{"linear", "exponential", "parabolic"};
    std::string initial = maps.front();
    for (const char* preferred : {"viridis", "auto"})
        if (std::find(maps.begin(), maps.end(), preferred) != maps.end()) initial = preferred;
    keys.push_back(
        when(choice("transfer.map", std::move(maps), std::move(initial), group,
                    "Named colour map over the range; auto: a diverging one for signed data, else viridis."),
             "transfer.shape", {"piecewise"}));
    keys.push_back(
        withAuto(typed("transfer.opacity", KeyType::OpacityPoints, Automatic{}, group, "curve",
                       "Opacity per unit length as points [position, opacity], positions in 0 to 1 over the "
                       "range; auto: the map's own if it brings any, else a ramp.")));
    keys.push_back(
        when(withNone(typed("transfer.points", KeyType::ColourPoints, None{}, group, "curve",
                            "Own colours as points [position, colour] instead of the map; none: the map.")),
             "transfer.shape", {"piecewise"}));
    keys.push_back(choice(
        "transfer.shape", {"piecewise", "linear", "exponential", "parabolic"}, "piecewise", group,
        "ColourList from the map or points (piecewise), or red, green and blue as functions of value with "
        "two cuts."));
    keys.push_back(when(number("transfer.cut1", "of the range", 0, 1, 0.25, group,
                               "Lower cut of the red, green and blue functions; less than transfer.cut2."),
                        "transfer.shape", cutShapes));
    keys.push_back(when(number("transfer.cut2", "of the range", 0, 1, 0.75, group,
                               "Upper cut of the red, green and blue functions; greater than transfer.cut1."),
                        "transfer.shape", cutShapes));
    keys.push_back(withAuto(
        number("transfer.unitLength", "world units", 1e-9, 1e9, Automatic{}, group,
               "Path length over which the opacities hold; auto: the mean edge of a voxel.", "number")));
    keys.push_back(typed(
        "transfer.nanColor", KeyType::Colour, Colour{{0, 0, 0, 0}}, group, "swatch",
        "Colour of samples without a value on planes and cut faces; volume rendering leaves them out."));
    keys.push_back(
        withNone(typed("transfer.belowColor", KeyType::Colour, None{}, group, "swatch",
                       "Colour and opacity of values below the range; none: as at its lower end.")));
    keys.push_back(
        withNone(typed("transfer.aboveColor", KeyType::Colour, None{}, group, "swatch",
                       "Colour and opacity of values above the range; none: as at its upper end.")));
}

void addRange(std::vector<KeySpec>& keys) {
    const std::string group = "Range";
    const std::vector<std::string> bounded{"fixed", "percentile"};
    constexpr double largest = 1e300;
    keys.push_back(choice(
        "range.mode", {"auto", "own", "shared", "fixed", "percentile", "symmetric"}, "auto", group,
        "Values that the transfer function spans: chosen from the cell's own data (auto: without a few "
        "extreme "
        "samples, and symmetric about 0 if signed), all of the cell's own, those of all cells of the same "
        "quantity and unit that share, "
        "range.min to range.max, the same as percentiles, or the largest magnitude on both sides of 0."));
    keys.push_back(
        when(withNone(number("range.min", "value, or percent", -largest, largest, None{}, group,
                             "Lower end: a value (fixed) or 0 to 100 (percentile); none: the smallest value, "
                             "or 0.5 percent.",
                             "number")),
             "range.mode", bounded));
    keys.push_back(
        when(withNone(number("range.max", "value, or percent", -largest, largest, None{}, group,
                             "Upper end: a value (fixed) or 0 to 100 (percentile); none: the largest value, "
                             "or 99.5 percent.",
                             "number")),
             "range.mode", bounded));
    keys.push_back(when(choice("range.symmetric", {"off", "on"}, "off", group,
                               "Whether the range is widened to reach as far below 0 as above it, so that "
                               "differences can share a range with zero in its middle."),
                        "range.mode", {"auto", "own", "shared", "percentile"}));
    keys.push_back(choice(
        "range.scale", {"linear", "log", "symlog"}, "linear", group,
        "Positions over the range by value, by its logarithm, or by its logarithm on both sides of 0."));
}

void addPicture(std::vector<KeySpec>& keys) {
    const std::string group = "Picture";
    keys.push_back(number("sampling.distance", "voxels", 0.05, 64, 0.5, group,
                          "Distance of samples along a ray, or of slices, in voxels of the drawn level."));
    keys.push_back(when(
        choice("sampling.transfer", {"samples", "mean"}, "samples", group,
               "What ray casting asks the transfer function for: its entries at the samples, or its mean "
               "between the values at the ends of each stretch (pre-integrated), which does not miss sharp "
               "peaks. Volumes that are blended with others or cut by a clip object are sampled."),
        "technique", {"raycast"}));
    keys.push_back(when(
        choice("sampling.adaptive", {"off", "on"}, "on", group,
               "Ray casting takes fewer samples than sampling.distance says, up to four voxels apart, where "
               "the colours of a part of the volume change little. Not of volumes that are blended with "
               "others, and not with means."),
        "technique", {"raycast"}));
    keys.push_back(
        choice("quality", {"full", "half", "quarter", "eighth"}, "full", group,
               "Level of detail of the picture at rest: every voxel, or every second, fourth or eighth."));
    KeySpec level = withAuto(number(
        "level", "", 0, 8, Automatic{}, group,
        "Level of detail of the live picture, each with half the samples per axis: 0 (every voxel) to 8, "
        "or auto: by the sheet's policy. Exported pictures are at full level unless level or quality is "
        "set for the export itself.",
        "number"));
    level.type = KeyType::Integer;
    keys.push_back(level);
    keys.push_back(choice(
        "texture.format", {"auto", "half"}, "auto", group,
        "Volumes of 32-bit floats as textures: as they are, or (half) as 16-bit floats over their range, in "
        "half the memory."));
    keys.push_back(withAuto(number(
        "probe.opacity", "", 0, 1, Automatic{}, group,
        "Picking in a volume takes the first sample at least this opaque per unit length; auto: where the "
        "accumulated opacity passes one half.",
        "number")));
    keys.push_back(typed("background", KeyType::Colour, Colour{{0x10, 0x13, 0x16, 255}}, group, "swatch",
                         "Behind the volume: #rrggbb or transparent."));
    keys.push_back(choice("annotations", {"none", "names", "all"}, "all", group,
                          "What exported pictures carry: nothing, names, or names, colour bars and axes."));
    keys.push_back(typed("field", KeyType::FieldName, std::int64_t{0}, "Data", "text",
                         "Which field of the dataset is shown: its name, or its index from 0."));
    KeySpec time = number("time", "steps", 0, 1'000'000, std::int64_t{0}, "Data",
                          "Which time step is shown, counted from 0.");
    time.type = KeyType::Integer;
    keys.push_back(time);
}

} // namespace

KeyTable makeKeyTable(std::vector<std::string> colourMapNames) {
    if (colourMapNames.empty()) throw InvalidInput("colour maps", "there are none", "give at least one");
    std::vector<KeySpec> keys;
    addTechnique(keys);
    addIsosurfaceKeys(keys);
    addPlaneKeys(keys);
    addTransfer(keys, colourMapNames);
    addRange(keys);
    addLabelKeys(keys);
    addLayerKeys(keys);
    addOverlayKeys(keys, colourMapNames);
    addPeriodicKeys(keys);
    addCrystalKeys(keys);
    addClipKeys(keys);
    addLightKeys(keys);
    addPicture(keys);
    addCamera(keys);
    return KeyTable(std::move(keys));
}

} // namespace voxsheet::sheet
