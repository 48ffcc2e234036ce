// Rows of the key table in the making. Private to this room.
#pragma once

#include "sheet/style_keys.h"

#include <string>
#include <vector>

namespace voxsheet::sheet {

[[nodiscard]] KeySpec choice(std::string name, std::vector<std::string> choices, std::string initial,
                             std::string group, std::string doc);
[[nodiscard]] KeySpec number(std::string name, std::string unit, double min, double max, StyleValue initial,
                             std::string group, std::string doc, std::string widget = "slider");
[[nodiscard]] KeySpec typed(std::string name, KeyType type, StyleValue initial, std::string group,
                            std::string widget, std::string doc);

/// Rows of numbers, one per column name.
struct RowsShape {
    std::vector<std::string> columnNames;
    std::size_t minRows = 1;
    std::size_t maxRows = 1;
    double min = 0.0;
    double max = 0.0;
};
[[nodiscard]] KeySpec numberRows(std::string name, RowsShape shape, StyleValue initial, std::string group,
                                 std::string doc);

[[nodiscard]] KeySpec withNone(KeySpec key);
[[nodiscard]] KeySpec withAuto(KeySpec key);
[[nodiscard]] KeySpec when(KeySpec key, std::string other, std::vector<std::string> values);

void addIsosurfaceKeys(std::vector<KeySpec>& keys);
void addPlaneKeys(std::vector<KeySpec>& keys);
void addPeriodicKeys(std::vector<KeySpec>& keys);
void addCrystalKeys(std::vector<KeySpec>& keys);
void addClipKeys(std::vector<KeySpec>& keys);
void addLayerKeys(std::vector<KeySpec>& keys);
void addLabelKeys(std::vector<KeySpec>& keys);
/// \param maps  names of colour maps
void addOverlayKeys(std::vector<KeySpec>& keys, const std::vector<std::string>& maps);
void addLightKeys(std::vector<KeySpec>& keys);

} // namespace voxsheet::sheet
