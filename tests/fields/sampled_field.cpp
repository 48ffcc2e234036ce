#include "fields/sampled_field.h"

#include "fields/trilinear.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace voxsheet::fields {
namespace {

template <typename T>
void store(std::vector<std::byte>& bytes, std::size_t index, double stored) {
    T number{};
    if constexpr (std::numeric_limits<T>::is_integer) {
        constexpr double low = static_cast<double>(std::numeric_limits<T>::lowest());
        constexpr double high = static_cast<double>(std::numeric_limits<T>::max());
        number = static_cast<T>(std::clamp(std::round(stored), low, high));
    } else {
        number = static_cast<T>(stored);
    }
    std::memcpy(bytes.data() + index * sizeof(T), &number, sizeof(T));
}

void setQuantisation(FieldMeta& meta, const AnalyticField& field) {
    if (isFloat(meta.storedType)) return;
    visitScalar(meta.storedType, [&]<typename T>() {
        const double low = static_cast<double>(std::numeric_limits<T>::lowest());
        const double high = static_cast<double>(std::numeric_limits<T>::max());
        meta.valueScale = (field.high - field.low) / (high - low);
        meta.valueOffset = field.low - low * meta.valueScale;
    });
}

} // namespace

SampledField sampleField(const AnalyticField& field, const Grid& grid, ScalarType type,
                         const std::string& key) {
    SampledField result;
    result.meta.key = key;
    result.meta.format = "analytic";
    result.meta.grid = grid;
    result.meta.sourceType = type;
    FieldMeta fieldMeta;
    fieldMeta.name = field.name;
    fieldMeta.storedType = type;
    setQuantisation(fieldMeta, field);

    std::vector<std::byte> bytes(static_cast<std::size_t>(sampleCount(grid.dims)) * scalarBytes(type));
    std::size_t index = 0;
    for (int z = 0; z < grid.dims.z; ++z)
        for (int y = 0; y < grid.dims.y; ++y)
            for (int x = 0; x < grid.dims.x; ++x) {
                const auto texture = (glm::dvec3(x, y, z) + 0.5) / glm::dvec3(grid.dims);
                const double value = field.value(2.0 * texture - 1.0);
                const double stored = (value - fieldMeta.valueOffset) / fieldMeta.valueScale;
                visitScalar(type, [&]<typename T>() { store<T>(bytes, index, stored); });
                ++index;
            }
    result.meta.fields.push_back(std::move(fieldMeta));
    result.arrays.push_back(std::move(bytes));
    return result;
}

Interpolant::Interpolant(const VolumeProvider& provider, const VolumeKey& key) {
    const auto meta = provider.describe(key.dataset);
    const auto& field = meta->fields.at(static_cast<std::size_t>(key.field));
    dims_ = levelDims(meta->grid.dims, key.level);
    periodic_ = meta->grid.periodic;
    const auto type = levelType(field.storedType, key.level);
    const auto count = static_cast<std::size_t>(sampleCount(dims_));
    std::vector<std::byte> bytes(count * scalarBytes(type));
    provider.readSlices(key, 0, dims_.z, bytes);
    values_.resize(count);
    visitScalar(type, [&]<typename T>() {
        for (std::size_t i = 0; i < count; ++i) {
            T stored{};
            std::memcpy(&stored, bytes.data() + i * sizeof(T), sizeof(T));
            values_[i] = field.valueScale * static_cast<double>(stored) + field.valueOffset;
        }
    });
}

double Interpolant::at(const glm::dvec3& texture) const {
    return trilinear(values_, dims_, periodic_, texture);
}

double Interpolant::nearest(const glm::dvec3& texture) const {
    const auto wrapped = glm::mix(texture, glm::fract(texture), periodic_);
    const auto sample = glm::ivec3(
        glm::clamp(glm::floor(wrapped * glm::dvec3(dims_)), glm::dvec3(0.0), glm::dvec3(dims_ - 1)));
    return values_[static_cast<std::size_t>((static_cast<long>(sample.z) * dims_.y + sample.y) * dims_.x +
                                            sample.x)];
}

} // namespace voxsheet::fields
