#include "import/vtk_legacy/image_fields.h"

#include "base/errors.h"
#include "import/formats/field_names.h"

#include <algorithm>
#include <array>

namespace voxsheet::import {

namespace {

std::string uniqueName(const std::vector<FieldMeta>& fields, const std::string& wanted) {
    auto name = wanted;
    const auto taken = [&] {
        return std::any_of(fields.begin(), fields.end(), [&](auto& f) { return f.name == name; });
    };
    for (int copy = 2; taken(); ++copy)
        name = wanted + " (" + std::to_string(copy) + ")";
    return name;
}

} // namespace

void appendFields(std::vector<FieldMeta>& fields, const std::string& array, ScalarType type, int components,
                  bool isVector) {
    constexpr std::array<const char*, 3> axes{" x", " y", " z"};
    const auto base = array.empty() ? std::string("array") : array;
    for (int c = 0; c < components; ++c) {
        auto name = base;
        if (components == 3 && isVector)
            name += axes[static_cast<std::size_t>(c)];
        else if (components > 1)
            name += " " + std::to_string(c + 1);
        FieldMeta field;
        field.name = uniqueName(fields, name);
        field.storedType = type;
        fields.push_back(std::move(field));
    }
}

void finishFields(const std::string& name, const std::optional<UniformResampling>& resampling,
                  const ImportLimits& limits, SourceHeader& source) {
    if (resampling)
        for (auto& field : source.meta.fields)
            field.storedType = resampling->resultType(field.storedType);
    checkTotalBytes(name, limits, source);
}

void checkTotalBytes(const std::string& name, const ImportLimits& limits, const SourceHeader& source) {
    checkFieldsAndSteps(name, static_cast<std::int64_t>(source.meta.fields.size()), 1);
    if (source.totalBytes() > limits.maxBytes)
        throw LimitExceeded(name, "its arrays need " + std::to_string(source.totalBytes()) +
                                      " bytes, more than the limit of " + std::to_string(limits.maxBytes));
}

Grid cellGrid(const Grid& points) {
    Grid cells = points;
    cells.centring = Centring::Cell;
    for (int axis = 0; axis < 3; ++axis) {
        if (points.dims[axis] == 1) continue;
        cells.dims[axis] = points.dims[axis] - 1;
        cells.worldFromIndex[3] += 0.5 * points.worldFromIndex[axis];
    }
    return cells;
}

} // namespace voxsheet::import
