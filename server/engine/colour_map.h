// Named colour maps, as read from configs/colour_maps.json.
#pragma once

#include "volume/transfer_function.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace voxsheet::engine {

enum class ColourMapKind {
    Sequential, ///< stops over [0, 1]
    Diverging,  ///< stops over [0, 1], neutral at `pivot`
    Ct          ///< stops and opacities at values in Hounsfield units
};

struct ColourMap {
    std::string name;  ///< as in `transfer.map`
    std::string label; ///< for people
    std::string source;
    ColourMapKind kind = ColourMapKind::Sequential;
    double pivot = 0.5;                     ///< Diverging only
    std::vector<ColourPoint> stops;         ///< sorted, at least two
    std::vector<OpacityPoint> opacities;    ///< Ct only; positions are values in HU
    std::pair<double, double> window{0, 1}; ///< Ct only: values shown when no range was chosen
};

/// Thread-safe once built: never changes.
class ColourMapTable {
public:
    /// Throws InvalidInput (with field) if the document is not as in configs/colour_maps.json.
    [[nodiscard]] static ColourMapTable fromJson(std::string_view text);
    /// The maps that the program carries inside itself.
    [[nodiscard]] static const ColourMapTable& embedded();

    [[nodiscard]] const std::vector<ColourMap>& maps() const { return maps_; }
    [[nodiscard]] std::vector<std::string> names() const;
    /// Null if there is no such map.
    [[nodiscard]] const ColourMap* find(std::string_view name) const;

private:
    std::vector<ColourMap> maps_;
};

/// The map's colours over positions [0, 1] of the value range [low, high]. A CT map is anchored at its
/// Hounsfield values when `anchored`, otherwise its window is stretched over the range (window/level).
[[nodiscard]] std::vector<ColourPoint> coloursOverRange(const ColourMap& map, double low, double high,
                                                        bool anchored);
/// The same for the opacities of a CT map; empty for maps that bring none.
[[nodiscard]] std::vector<OpacityPoint> opacitiesOverRange(const ColourMap& map, double low, double high,
                                                           bool anchored);

/// `{"maps": [{name, label, kind, source, pivot?, window?, stops: [[position, r, g, b]...]}]}`.
[[nodiscard]] nlohmann::json describeColourMaps(const ColourMapTable& table);

} // namespace voxsheet::engine
