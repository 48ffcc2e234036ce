#include "base/control_group.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>

namespace voxsheet {

namespace fs = std::filesystem;

namespace {

bool listed(const std::string& commaSeparated, const std::string& name) {
    std::istringstream in(commaSeparated);
    for (std::string each; std::getline(in, each, ',');)
        if (each == name) return true;
    return false;
}

/// A mounted tree of control groups: `group` is the one that its mount point shows.
struct Mount {
    fs::path point;
    fs::path group;
};

/// A line of /proc/self/mountinfo (proc_pid_mountinfo(5)): id, parent, device, root, mount point, options,
/// optional fields, "-", type, source, options of the file system.
std::optional<Mount> mountOf(const std::string& line, const std::string& type,
                             const std::string& controller) {
    std::istringstream in(line);
    std::string id, parent, device, group, point, word, fileSystem, source, options;
    if (!(in >> id >> parent >> device >> group >> point)) return std::nullopt;
    while (in >> word && word != "-") {
    }
    if (!(in >> fileSystem >> source >> options) || fileSystem != type) return std::nullopt;
    if (type == "cgroup" && !listed(options, controller)) return std::nullopt;
    return Mount{point, group};
}

std::vector<fs::path> foldersUpwards(const Mount& mount, const fs::path& group, const fs::path& root) {
    // In a container, groups may be named as the host sees them while the mount begins at the container's
    // own.
    auto inner = group.lexically_relative(mount.group);
    if (inner.empty() || *inner.begin() == "..") inner = ".";
    std::vector<fs::path> folders;
    const auto top = root / mount.point.relative_path();
    for (auto folder = (top / inner).lexically_normal();; folder = folder.parent_path()) {
        if (!folder.has_filename()) folder = folder.parent_path(); // "a/." becomes "a/"
        folders.push_back(folder);
        if (folder == top || folder.native().size() <= top.native().size()) break;
    }
    return folders;
}

} // namespace

ControlGroups controlGroups(const std::string& controller, const fs::path& root) {
    std::optional<Mount> unified;
    std::optional<Mount> own;
    std::ifstream mounts(root / "proc/self/mountinfo");
    for (std::string line; std::getline(mounts, line);) {
        if (!unified) unified = mountOf(line, "cgroup2", controller);
        if (!own) own = mountOf(line, "cgroup", controller);
    }
    ControlGroups groups;
    std::ifstream memberships(root / "proc/self/cgroup");
    for (std::string line; std::getline(memberships, line);) { // hierarchy:controllers:group
        const auto first = line.find(':');
        const auto second = first == std::string::npos ? first : line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const auto controllers = line.substr(first + 1, second - first - 1);
        const fs::path group = line.substr(second + 1);
        if (controllers.empty() && unified) groups.unified = foldersUpwards(*unified, group, root);
        if (listed(controllers, controller) && own) groups.controller = foldersUpwards(*own, group, root);
    }
    return groups;
}

} // namespace voxsheet
