#include "import/formats/nrrd_axes.h"

#include "base/errors.h"
#include "import/formats/geometry.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace voxsheet::import {

namespace {

enum class Role { Unknown, Space, Fields, Time };

Role roleByKind(const std::string& kind) {
    if (kind == "domain" || kind == "space") return Role::Space;
    if (kind == "time") return Role::Time;
    if (kind.empty() || kind == "none" || kind == "???" || kind == "stub" || kind == "scalar")
        return Role::Unknown;
    return Role::Fields;
}

std::vector<Role> axisRoles(const NrrdHeader& header) {
    std::vector<Role> roles;
    for (const auto& axis : header.axes) {
        if (header.hasDirections)
            roles.push_back(axis.direction                          ? Role::Space
                            : roleByKind(axis.kind) == Role::Fields ? Role::Fields
                                                                    : roleByKind(axis.kind));
        else
            roles.push_back(roleByKind(axis.kind));
    }
    const bool told = std::any_of(roles.begin(), roles.end(), [](Role r) { return r == Role::Space; });
    if (!told)
        for (std::size_t axis = 0, found = 0; axis < roles.size() && found < 3; ++axis)
            if (roles[axis] == Role::Unknown) {
                roles[axis] = Role::Space;
                ++found;
            }
    return roles;
}

bool isAnatomical(const std::string& space) {
    return space.find("anterior") != std::string::npos || space.find("posterior") != std::string::npos;
}

/// RAS+ or right-handed from the file's space.
glm::dmat4 worldFromSpace(const NrrdHeader& header) {
    const auto mirrored = [](double x, double y, double z) {
        return glm::scale(glm::dmat4(1.0), glm::dvec3(x, y, z));
    };
    if (header.space == "left-posterior-superior") return rasFromLps();
    if (header.space == "left-anterior-superior") return mirrored(-1, 1, 1);
    if (header.space == "3d-left-handed") return mirrored(1, 1, -1);
    return glm::dmat4(1.0);
}

/// Spacing and position of the first sample along an axis without direction.
std::pair<double, double> scaleAndStart(const std::string& name, const NrrdAxis& axis) {
    const bool hasMin = axis.min && std::isfinite(*axis.min);
    const bool hasRange = hasMin && axis.max && std::isfinite(*axis.max) && *axis.max != *axis.min;
    const auto intervals = static_cast<double>(axis.cell ? axis.size : axis.size - 1);
    double spacing = 1.0;
    if (axis.spacing)
        spacing = *axis.spacing;
    else if (hasRange && intervals > 0)
        spacing = (*axis.max - *axis.min) / intervals;
    checkSpacing(name, {spacing});
    const double start = hasMin ? *axis.min + (axis.cell ? 0.5 * spacing : 0.0) : 0.0;
    return {spacing, start};
}

} // namespace

NrrdRoles nrrdRoles(const std::string& name, const NrrdHeader& header) {
    const auto roles = axisRoles(header);
    NrrdRoles result;
    for (std::size_t axis = 0; axis < roles.size(); ++axis)
        if (roles[axis] == Role::Space) result.spatial.push_back(axis);
    if (result.spatial.empty() || result.spatial.size() > 3)
        throw Unsupported(name, "it has " + std::to_string(result.spatial.size()) +
                                    " spatial axes, a volume has 1 to 3");
    const auto first = result.spatial.front();
    const auto last = result.spatial.back();
    if (last - first + 1 != result.spatial.size())
        throw Unsupported(name, "axes that are not spatial stand between the spatial ones",
                          "permute its axes (`unu permute`)");
    for (std::size_t axis = 0; axis < roles.size(); ++axis) {
        if (axis >= first && axis <= last) continue;
        if (axis < first && roles[axis] == Role::Time)
            throw Unsupported(name, "its time axis varies faster than space",
                              "permute its axes (`unu permute`)");
        if (axis < first)
            result.inner.push_back(axis);
        else if (roles[axis] == Role::Fields)
            result.outerFields.push_back(axis);
        else if (header.axes[axis].size > 1 || roles[axis] == Role::Time)
            result.time.push_back(axis);
    }
    if (result.time.size() > 1) throw Unsupported(name, "it has more than one time axis");
    if (!result.time.empty() && !result.outerFields.empty()) {
        const auto time = result.time[0];
        result.timeFastest = time < result.outerFields.front();
        if (!result.timeFastest && time < result.outerFields.back())
            throw Unsupported(name, "its time axis stands between two axes of fields");
    }
    return result;
}

void placeNrrdGrid(const std::string& name, const NrrdHeader& header, const NrrdRoles& roles,
                   DatasetMeta& meta) {
    AxisColumns columns{};
    glm::dvec3 origin = header.spaceOrigin;
    std::string unit = header.spaceUnit;
    bool cell = true;
    const auto count = static_cast<int>(roles.spatial.size());
    for (int column = 0; column < count; ++column) {
        const auto& axis = header.axes[roles.spatial[static_cast<std::size_t>(column)]];
        meta.grid.dims[column] = static_cast<int>(axis.size);
        cell = cell && axis.cell;
        auto& vector = columns[static_cast<std::size_t>(column)];
        if (header.hasDirections) {
            vector = *axis.direction;
            checkSpacing(name, {glm::length(vector)});
        } else {
            const auto [spacing, start] = scaleAndStart(name, axis);
            vector[column] = spacing;
            origin[column] += start;
        }
        if (unit.empty() && !header.hasDirections) unit = axis.unit;
    }
    completeAxes(columns, count);
    if (count < 3)
        meta.notes.push_back("The file has " + std::to_string(count) +
                             (count == 1 ? " spatial axis" : " spatial axes") +
                             "; it is shown one voxel thick.");
    meta.grid.worldFromIndex = worldFromSpace(header) * affine(columns, origin);
    meta.grid.centring = cell ? Centring::Cell : Centring::Point;
    meta.anatomical = isAnatomical(header.space);
    meta.lengthUnit = unit.empty() && meta.anatomical ? "mm" : unit;
    if (!header.hasDirections && !header.space.empty())
        meta.notes.push_back(
            "The header names the space '" + header.space +
            "' without directions; the axes of the file are taken as the axes of that space.");
    if (header.space == "3d-left-handed")
        meta.notes.emplace_back(
            "Its space is left-handed and the world right-handed: what the file calls z is "
            "shown as -z, so that nothing is mirrored.");
}

std::vector<std::string> nrrdComponentNames(const NrrdAxis& axis) {
    std::vector<std::string> names;
    if (axis.kind == "rgb-color" || axis.kind == "3-color")
        names = {"red", "green", "blue"};
    else if (axis.kind == "rgba-color" || axis.kind == "4-color")
        names = {"red", "green", "blue", "alpha"};
    else if (axis.kind == "complex")
        names = {"real", "imaginary"};
    else if (axis.kind == "2-vector")
        names = {"x", "y"};
    else if (axis.kind == "3-vector" || axis.kind == "3-gradient" || axis.kind == "3-normal")
        names = {"x", "y", "z"};
    if (static_cast<std::int64_t>(names.size()) != axis.size) names.clear();
    return names;
}

} // namespace voxsheet::import
