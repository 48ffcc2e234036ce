#include "import/formats/own_readers.h"

#include "base/errors.h"
#include "import/formats/bit_mask.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

namespace voxsheet::import {

namespace {

void setSpacing(Grid& grid, const glm::dvec3& spacing) {
    const auto before = spacingWorld(grid);
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(spacing[axis]) || spacing[axis] <= 0.0)
            throw InvalidInput("option spacing", "three finite lengths above 0 are needed")
                .withField("spacing");
        grid.worldFromIndex[axis] *= spacing[axis] / before[axis];
    }
}

glm::dvec3 towards(char side) {
    switch (side) {
    case 'R':
        return {1, 0, 0};
    case 'L':
        return {-1, 0, 0};
    case 'A':
        return {0, 1, 0};
    case 'P':
        return {0, -1, 0};
    case 'S':
        return {0, 0, 1};
    default:
        return {0, 0, -1};
    }
}

/// The grid's axes lead to these sides; the first sample and the lengths of the voxel edges stay.
void orient(DatasetMeta& meta, const std::string& sides) {
    auto& grid = meta.grid;
    const auto refuse = [&](const std::string& why) {
        throw InvalidInput("option orientation " + sides, why, "leave it out")
            .withField("options.orientation");
    };
    if (meta.crystal) refuse("a crystal has no sides of a patient");
    const auto spacing = spacingWorld(grid);
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        const auto next = (axis + 1) % 3;
        const auto along =
            glm::dot(glm::dvec3(grid.worldFromIndex[axis]), glm::dvec3(grid.worldFromIndex[next]));
        if (std::abs(along) > 1e-6 * spacing[axis] * spacing[next])
            refuse("the axes of the file's grid are not perpendicular");
    }
    for (glm::length_t axis = 0; axis < 3; ++axis)
        grid.worldFromIndex[axis] =
            glm::dvec4(spacing[axis] * towards(sides[static_cast<std::size_t>(axis)]), 0.0);
    meta.anatomical = true;
    if (meta.lengthUnit.empty()) meta.lengthUnit = "mm";
}

void setOrigin(Grid& grid, const glm::dvec3& origin) {
    for (glm::length_t axis = 0; axis < 3; ++axis)
        if (!std::isfinite(origin[axis]))
            throw InvalidInput("option origin", "three finite numbers are needed").withField("origin");
    grid.worldFromIndex[3] = glm::dvec4(origin, 1.0);
}

/// Mirrors within the drawn box: index p goes to where low + high - p was.
void flipAxes(Grid& grid, const glm::bvec3& flip) {
    const auto box = boxIndex(grid);
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        if (!flip[axis]) continue;
        grid.worldFromIndex[3] += (box.low[axis] + box.high[axis]) * grid.worldFromIndex[axis];
        grid.worldFromIndex[axis] = -grid.worldFromIndex[axis];
    }
}

/// Atoms keep their place among the samples.
void moveWithGrid(Crystal& crystal, const Grid& from, const Grid& to) {
    if (from.worldFromIndex == to.worldFromIndex) return;
    const auto moved = to.worldFromIndex * glm::inverse(from.worldFromIndex);
    crystal.lattice = glm::dmat3(moved) * crystal.lattice;
    for (Atom& atom : crystal.atoms)
        atom.positionWorld = glm::dvec3(moved * glm::dvec4(atom.positionWorld, 1.0));
}

/// A float type that holds every number of `type`, up to F64's 53 bits.
ScalarType floatFor(ScalarType type) {
    switch (type) {
    case ScalarType::U8:
    case ScalarType::I8:
    case ScalarType::U16:
    case ScalarType::I16:
    case ScalarType::F32:
        return ScalarType::F32;
    default:
        return ScalarType::F64;
    }
}

template <typename From, typename To>
void replaceValue(std::span<const std::byte> in, double noData, std::span<std::byte> out) {
    for (std::size_t index = 0; index < in.size() / sizeof(From); ++index) {
        From value{};
        std::memcpy(&value, in.data() + index * sizeof(From), sizeof(From));
        // A float file stores the float nearest to the number that a user types.
        const bool absent = value == static_cast<From>(noData) &&
                            static_cast<double>(value) == static_cast<double>(static_cast<From>(noData));
        const To result = absent ? std::numeric_limits<To>::quiet_NaN() : static_cast<To>(value);
        std::memcpy(out.data() + index * sizeof(To), &result, sizeof(To));
    }
}

/// Whether a value of the type can be `number` at all (also keeps the conversion below defined).
bool representable(ScalarType type, double number) {
    return visitScalar(type, [&]<typename T>() {
        if constexpr (std::is_floating_point_v<T>)
            return std::isfinite(number) &&
                   std::abs(number) <= static_cast<double>(std::numeric_limits<T>::max());
        else
            return number == std::floor(number) &&
                   number >= static_cast<double>(std::numeric_limits<T>::min()) &&
                   number < std::ldexp(1.0, std::numeric_limits<T>::digits);
    });
}

std::vector<std::byte> withoutValue(std::span<const std::byte> in, ScalarType from, double noData) {
    const auto count = in.size() / scalarBytes(from);
    std::vector<std::byte> out(count * scalarBytes(floatFor(from)));
    visitScalar(from, [&]<typename From>() {
        if (floatFor(from) == ScalarType::F32)
            replaceValue<From, float>(in, noData, out);
        else
            replaceValue<From, double>(in, noData, out);
    });
    return out;
}

/// Integer fields that can hold the number become floats.
ArraySink withoutNoData(DatasetMeta& meta, double noData, ArraySink sink) {
    std::vector<std::optional<ScalarType>>
        changed; // the stored type in the file, for fields that are converted
    for (auto& field : meta.fields) {
        const bool possible = representable(field.storedType, noData);
        changed.push_back(possible ? std::optional(field.storedType) : std::nullopt);
        if (possible) field.storedType = floatFor(field.storedType);
    }
    return [changed = std::move(changed), noData, sink = std::move(sink)](int field, int step,
                                                                          std::vector<std::byte>&& voxels) {
        const auto from = changed.at(static_cast<std::size_t>(field));
        if (!from)
            sink(field, step, std::move(voxels));
        else
            sink(field, step, withoutValue(voxels, *from, noData));
    };
}

ArraySink withBitsOnly(const std::vector<ScalarType>& types, std::uint64_t mask, ArraySink sink) {
    return [types, mask, sink = std::move(sink)](int field, int step, std::vector<std::byte>&& voxels) {
        keepBits(voxels, types.at(static_cast<std::size_t>(field)), mask);
        sink(field, step, std::move(voxels));
    };
}

} // namespace

ArraySink applyOptions(SourceHeader& header, const ImportOptions& options, ArraySink sink) {
    auto& grid = header.meta.grid;
    const Grid inFile = grid;
    if (options.spacing) setSpacing(grid, *options.spacing);
    if (options.orientation) orient(header.meta, *options.orientation);
    if (options.origin) setOrigin(grid, *options.origin);
    if (options.periodic) grid.periodic = *options.periodic;
    flipAxes(grid, options.flip);
    validateGrid(grid);
    if (header.meta.crystal) moveWithGrid(*header.meta.crystal, inFile, grid);

    std::vector<ScalarType> typesInFile;
    for (const auto& field : header.meta.fields)
        typesInFile.push_back(field.storedType);
    if (options.bitMask) checkBitMask(header.meta, *options.bitMask);
    if (options.noDataValue) sink = withoutNoData(header.meta, *options.noDataValue, std::move(sink));
    if (options.bitMask) sink = withBitsOnly(typesInFile, *options.bitMask, std::move(sink));
    return sink;
}

} // namespace voxsheet::import
