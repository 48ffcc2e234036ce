// Labels as readers collect them from files.
#pragma once

#include "volume/dataset.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

namespace voxsheet::import {

inline constexpr std::size_t kMostLabels = 4096;

/// By value, each once.
class LabelSet {
public:
    /// False, and nothing happens, for a value that it has, a value beyond 2^53 (a double holds all smaller
    /// ones), or more than kMostLabels. Names are cut after 200 bytes; what is not UTF-8 in them is replaced.
    bool add(std::int64_t value, std::string_view name, std::optional<glm::dvec3> rgb);

    [[nodiscard]] bool empty() const { return labels_.empty(); }
    [[nodiscard]] std::vector<LabelMeta> list() const;

private:
    std::map<std::int64_t, LabelMeta> labels_;
};

/// `#rrggbb`; [0, 1].
[[nodiscard]] std::optional<glm::dvec3> hexColour(std::string_view text);
/// Three numbers from 0 to `full`; [0, 1].
[[nodiscard]] std::optional<glm::dvec3> colourOf(std::string_view numbers, double full);

} // namespace voxsheet::import
