// Keys of what is shown besides plain values: categories, and a second volume over a plane.
#include "sheet/style_key_builders.h"

#include <algorithm>

namespace voxsheet::sheet {

namespace {

constexpr double kLargest = 1e300;

} // namespace

void addLabelKeys(std::vector<KeySpec>& keys) {
    const std::string group = "Labels";
    keys.push_back(
        choice("labels.show", {"off", "on"}, "off", group,
               "Shows whole numbers as categories: a colour of its own for each value, no value "
               "between two of them (the nearest sample), a legend instead of the colour bar. 0 is "
               "the background, clear unless labels.names names it. Not with mip and isosurface; unlit."));
    const auto add = [&](KeySpec key) { keys.push_back(when(std::move(key), "labels.show", {"on"})); };
    KeySpec names =
        withNone(typed("labels.names", KeyType::Text, None{}, group, "text",
                       "Names and colours of the values, as in 1: liver; 2: spleen #aa3300. Values "
                       "without a colour keep their own."));
    names.maxBytes = 8000;
    add(std::move(names));
    add(withNone(numberRows("labels.hide", {{"value"}, 1, 256, -kLargest, kLargest}, None{}, group,
                            "Values that are not shown.")));
    add(number("labels.opacity", "", 0, 1, 1.0, group,
               "Opacity of the categories per unit length in volumes; in planes they are opaque."));
}

void addOverlayKeys(std::vector<KeySpec>& keys, const std::vector<std::string>& maps) {
    const std::string group = "Overlay";
    const auto add = [&](KeySpec key) { keys.push_back(when(std::move(key), "technique", {"plane"})); };
    add(withNone(
        typed("overlay.dataset", KeyType::Text, None{}, group, "text",
              "Another cell (B1) or dataset that is painted over the plane at the same place in the "
              "world. A cell that shows labels (labels.show) is painted as labels. A cell that names "
              "itself has no overlay.")));
    std::vector<std::string> choices = maps;
    choices.push_back("labels");
    std::string initial = maps.front();
    for (const char* preferred : {"viridis", "plasma", "inferno"})
        if (std::find(maps.begin(), maps.end(), preferred) != maps.end()) initial = preferred;
    add(choice(
        "overlay.map", std::move(choices), std::move(initial), group,
        "Colour map of the overlay over its own range; labels: its values as categories, with the names, "
        "colours and hidden values of labels.*."));
    add(number("overlay.opacity", "", 0, 1, 0.6, group, "Opacity of the overlay."));
    add(withNone(number("overlay.threshold", "value", -kLargest, kLargest, None{}, group,
                        "Values of the overlay below it are not shown; none: all are.", "number")));
    add(withNone(number("overlay.min", "value", -kLargest, kLargest, None{}, group,
                        "Lower end of the overlay's range; none: chosen from its data.", "number")));
    add(withNone(number("overlay.max", "value", -kLargest, kLargest, None{}, group,
                        "Upper end of the overlay's range; none: chosen from its data.", "number")));
}

} // namespace voxsheet::sheet
