// Keys that look inside a volume: isosurfaces, planes, further volumes, clipping, light.
#include "sheet/style_key_builders.h"

namespace voxsheet::sheet {

namespace {

constexpr double kLargest = 1e300;

} // namespace

void addIsosurfaceKeys(std::vector<KeySpec>& keys) {
    const std::string group = "Isosurface";
    const auto add = [&](KeySpec key) { keys.push_back(when(std::move(key), "technique", {"isosurface"})); };
    add(withAuto(numberRows(
        "isovalue", {{"value"}, 1, 8, -kLargest, kLargest}, Automatic{}, group,
        "Values whose surfaces are shown; auto: chosen from the data, one on each side of 0 if signed.")));
    add(choice("isosurface.mirror", {"off", "on"}, "off", group,
               "Shows every isovalue v also as -v: one control for both signs."));
    KeySpec colours = typed("isosurface.colors", KeyType::Colours, Automatic{}, group, "swatches",
                            "Colours of the surfaces in the order of the isovalues, the last one for all "
                            "that follow; auto: those of the "
                            "transfer function, of a diverging one those further out.");
    add(withAuto(std::move(colours)));
    add(numberRows(
        "isosurface.opacity", {{"opacity"}, 1, 8, 0.0, 1.0}, NumberTable{{{1.0}}}, group,
        "Opacities of the surfaces in the order of the isovalues, the last one for all that follow."));
    add(withNone(typed("isosurface.colorBy", KeyType::Text, None{}, group, "text",
                       "Another cell (B1) or dataset whose values at the same place colour the surfaces.")));
    add(choice("isosurface.caps", {"off", "on"}, "off", group,
               "Closes surfaces that a clip opens, with the transfer function's colours on the cut."));
    add(choice(
        "isosurface.method", {"refined", "alphatest"}, "refined", group,
        "Crossings found and refined, or, for comparison, the plain test per sample, which leaves gaps."));
}

void addPlaneKeys(std::vector<KeySpec>& keys) {
    const std::string group = "Plane";
    const std::vector<std::string> plane{"plane"};
    keys.push_back(when(
        choice("plane.axis", {"axial", "coronal", "sagittal", "custom", "hkl"}, "axial", group,
               "The plane's normal: z (axial), y (coronal), x (sagittal) of the world, plane.normal, or, in "
               "crystals, that of the lattice planes plane.hkl. "
               "Patients (RAS+ axes) are shown as radiologists do, their right on the left of the "
               "picture, sagittal planes from their left; other data with x or y to the right and y or "
               "z up. camera.distance zooms (3.9 shows all), camera.target moves the picture, the "
               "camera's angles and clip keys do nothing here."),
        "technique", plane));
    KeySpec normal = typed("plane.normal", KeyType::Vector3, glm::dvec3(0.0, 0.0, 1.0), group, "vector",
                           "Normal of a custom plane along the world axes, towards the eye; z is up in the "
                           "picture, or y where the normal is z.");
    normal.min = -1e6;
    normal.max = 1e6;
    keys.push_back(when(std::move(normal), "plane.axis", {"custom"}));
    KeySpec hkl =
        typed("plane.hkl", KeyType::Vector3, glm::dvec3(1.0), group, "vector",
              "Miller indices of a plane of a crystal's lattice: three whole numbers, not all zero. "
              "The normal is h a* + k b* + l c*, the lattice that of the file. The wheel steps by about "
              "a voxel, so that a whole number of steps leads to the next plane of the set.");
    hkl.min = -99.0;
    hkl.max = 99.0;
    keys.push_back(when(std::move(hkl), "plane.axis", {"hkl"}));
    keys.push_back(when(number("plane.position", "of the box", 0, 1, 0.5, group,
                               "Where the plane lies: 0 to 1 through the drawn box along the normal. With a "
                               "crosshair it passes through that instead."),
                        "technique", plane));
    keys.push_back(when(choice("plane.interpolation", {"linear", "nearest"}, "linear", group,
                               "Values between samples, or the samples as they are, voxel by voxel."),
                        "technique", plane));
    const std::string crosshairs = "Crosshair";
    KeySpec crosshair = withNone(typed(
        "plane.crosshair", KeyType::Vector3, None{}, crosshairs, "vector",
        "The point that planes pass through, in all cells that are linked, drawn as lines on planes and "
        "volumes; none: planes lie at plane.position. Fractions along the world's axes of the drawn box, "
        "so that different volumes stay linked, or world coordinates (plane.units)."));
    crosshair.min = -kLargest;
    crosshair.max = kLargest;
    keys.push_back(std::move(crosshair));
    keys.push_back(
        choice("plane.units", {"fraction", "world"}, "fraction", crosshairs,
               "Of plane.crosshair: fractions of each cell's own box, or one place in the world."));
}

void addLayerKeys(std::vector<KeySpec>& keys) {
    const std::string group = "Layers";
    // Shown with every technique: one that cannot blend them is an error, which "none" resolves.
    keys.push_back(withNone(typed(
        "layers", KeyType::Text, None{}, group, "text",
        "Up to three other cells or datasets that are blended into the picture (raycast only), as in B1; "
        "C1: each with that cell's own transfer function, at the same place in the world. A cell that "
        "names itself is not blended twice.")));
    keys.push_back(when(
        numberRows("layers.weights", {{"weight"}, 1, 4, 0.0, 1.0}, NumberTable{{{1.0}}}, group,
                   "Factors on the densities of the cell's own volume and of the layers in their order, the "
                   "last one for all that follow."),
        "technique", {"raycast"}));
}

void addPeriodicKeys(std::vector<KeySpec>& keys) {
    const std::string group = "Periodic";
    KeySpec shift = typed(
        "periodic.shift", KeyType::Vector3, glm::dvec3(0.0), group, "vector",
        "Moves the data of a periodic volume inside its box, which stays where it is: what lay at "
        "fraction f of the cell is drawn at f + shift, so 0.5, 0.5, 0.5 centres what was at the corner. "
        "Clips, layers and colouring volumes stay where they are.");
    shift.unit = "of the cell";
    shift.min = -1.0;
    shift.max = 1.0;
    keys.push_back(shift);
    KeySpec replicate = typed("periodic.replicate", KeyType::Vector3, glm::dvec3(1.0), group, "vector",
                              "How many periods of a periodic volume are drawn along its axes: three whole "
                              "numbers. The box grows from its origin, camera and clips follow it.");
    replicate.unit = "periods";
    replicate.min = 1.0;
    replicate.max = 8.0;
    keys.push_back(replicate);
}

void addCrystalKeys(std::vector<KeySpec>& keys) {
    const std::string group = "Crystal";
    keys.push_back(
        choice("crystal.atoms", {"off", "on"}, "off", group,
               "Shows the atoms of the file as spheres in the customary colours of their elements, at "
               "their depth in the volume, with images in opposite faces of a periodic box. "
               "A clip takes an atom as a whole, by its centre; a plane shows those it cuts."));
    keys.push_back(choice("crystal.bonds", {"none", "inside", "across"}, "none", group,
                          "Joins atoms that are nearer than their covalent radii and 0.45 Å: those in the "
                          "box (inside), or also "
                          "with the images beyond its periodic faces (across). Metals are not joined with "
                          "each other where there "
                          "are other elements."));
    keys.push_back(choice("crystal.cell", {"off", "on"}, "off", group,
                          "Shows the edges of the unit cells, in a plane their outlines. They stay with the "
                          "box when periodic.shift moves the data."));
    keys.push_back(number("crystal.radius", "of the covalent radius", 0.05, 4, 0.5, group,
                          "Radius of the atoms; bonds keep in proportion."));
}

void addClipKeys(std::vector<KeySpec>& keys) {
    const std::string group = "Clip";
    keys.push_back(withNone(
        numberRows("clip.planes", {{"nx", "ny", "nz", "position"}, 1, 8, -kLargest, kLargest}, None{}, group,
                   "Planes by normal (world axes) and position; what lies beyond each along its normal is "
                   "kept. Position: 0 to 1 through "
                   "the box along the normal, or world units from the origin (clip.units).")));
    keys.push_back(withNone(numberRows(
        "clip.box", {{"x0", "x1", "y0", "y1", "z0", "z1"}, 1, 1, -kLargest, kLargest}, None{}, group,
        "A box whose inside is kept: fractions along the volume's own axes, or world coordinates "
        "(clip.units).")));
    keys.push_back(choice("clip.units", {"fraction", "world"}, "fraction", group,
                          "Of planes, box and shape: fractions of the cell's own box, so that different "
                          "volumes can be linked, or "
                          "world units."));
    KeySpec shape =
        withNone(typed("clip.shape", KeyType::Text, None{}, group, "text",
                       "A clip object: sphere, ellipsoid, box, cylinder, torus; the dataset of a closed mesh "
                       "(STL, PLY, OBJ); or where "
                       "another volume compares with a number, as in B1 > 0.4 or 'run 2' <= -1."));
    shape.suggestions = {"sphere", "ellipsoid", "box", "cylinder", "torus"};
    keys.push_back(std::move(shape));
    keys.push_back(choice("clip.mode", {"probe", "clip"}, "clip", group,
                          "Keeps the inside of the clip object (probe) or its outside (clip)."));
    keys.push_back(
        choice("clip.representation", {"distance", "binary"}, "distance", group,
               "The clip object as signed distances, or, for comparison, as inside or outside per voxel."));
    keys.push_back(numberRows(
        "clip.transform", {{"tx", "ty", "tz", "rx", "ry", "rz", "sx", "sy", "sz"}, 1, 1, -kLargest, kLargest},
        NumberTable{{{0, 0, 0, 0, 0, 0, 1, 1, 1}}}, group,
        "Moves the clip object: scale, then rotation about x, y and z in degrees, then translation (in half "
        "the shortest edge "
        "of the box, or world units)."));
}

void addLightKeys(std::vector<KeySpec>& keys) {
    const std::string shading = "Shading";
    keys.push_back(
        withAuto(typed("shading.model", KeyType::Choice, Automatic{}, shading, "select",
                       "Light on what is drawn (Phong) or none; auto: Phong for isosurfaces, else none.")));
    keys.back().choices = {"none", "phong"};
    keys.push_back(withAuto(typed(
        "shading.gradient", KeyType::Choice, Automatic{}, shading, "select",
        "Normals from a gradient texture (8 bytes a voxel) or from six taps on the fly; auto: the texture "
        "for volumes, on the fly for isosurfaces.")));
    keys.back().choices = {"texture", "onthefly"};
    keys.push_back(number("shading.ambient", "", 0, 1, 0.25, shading, "Light from everywhere."));
    keys.push_back(number("shading.diffuse", "", 0, 1, 0.75, shading, "Light that is scattered evenly."));
    keys.push_back(number("shading.specular", "", 0, 1, 0.25, shading, "Highlights."));
    keys.push_back(
        number("shading.shininess", "", 1, 1000, 24.0, shading, "How small and sharp highlights are."));
    const std::string light = "Light";
    keys.push_back(number("light.head", "", 0, 1, 1.0, light, "Intensity of the light at the eye."));
    keys.push_back(withNone(numberRows("light.direction", {{"x", "y", "z"}, 1, 4, -kLargest, kLargest},
                                       None{}, light, "Directions towards directional lights.")));
    keys.push_back(
        choice("light.frame", {"view", "world"}, "view", light,
               "Directional lights stay with the viewer (x right, y up, z to the eye) or with the world."));
    keys.push_back(number("light.intensity", "", 0, 1, 1.0, light, "Intensity of each directional light."));
}

} // namespace voxsheet::sheet
