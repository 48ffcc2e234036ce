// The folders in which Linux states what this process's control groups allow.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace voxsheet {

/// Control groups come in two versions, which may be mixed: one tree for all controllers (2), or one each
/// (1).
struct ControlGroups {
    std::vector<std::filesystem::path> unified;    ///< version 2: this process's group and those above it
    std::vector<std::filesystem::path> controller; ///< version 1: the same, of the controller asked for
};

/// Groups that this process belongs to, innermost first, up to where the file system is mounted (in a
/// container that is the container's own group). Empty where there are none or they can not be read. \param
/// controller  "cpu", "memory", … \param root        folder that /proc and /sys are read below; "/" but in
/// tests
[[nodiscard]] ControlGroups controlGroups(const std::string& controller,
                                          const std::filesystem::path& root = "/");

} // namespace voxsheet
