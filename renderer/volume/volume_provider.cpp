#include "volume/volume_provider.h"

#include "base/errors.h"

namespace voxsheet {

namespace {

void checkIndex(const DatasetMeta& meta, const char* thing, int index, int count) {
    if (index >= 0 && index < count) return;
    throw NotFound(std::string(thing) + " " + std::to_string(index) + " of dataset '" + meta.key + "'",
                   "there are " + std::to_string(count) + ", counted from 0");
}

} // namespace

void validateVolumeKey(const DatasetMeta& meta, const VolumeKey& key) {
    checkIndex(meta, "field", key.field, static_cast<int>(meta.fields.size()));
    checkIndex(meta, "time step", key.step, meta.stepCount());
    checkIndex(meta, "level", key.level, meta.levels());
}

ByteRange sliceBytes(const DatasetMeta& meta, const VolumeKey& key, int zBegin, int zCount) {
    validateVolumeKey(meta, key);
    const auto dims = levelDims(meta.grid.dims, key.level);
    if (zBegin < 0 || zCount < 0 || zBegin > dims.z || zCount > dims.z - zBegin)
        throw InvalidInput("slices " + std::to_string(zBegin) + " and on, " + std::to_string(zCount) +
                               " of them",
                           "the level has " + std::to_string(dims.z) + " slices");
    const auto type = levelType(meta.fields[static_cast<std::size_t>(key.field)].storedType, key.level);
    const auto slice =
        static_cast<std::size_t>(dims.x) * static_cast<std::size_t>(dims.y) * scalarBytes(type);
    return {static_cast<std::size_t>(zBegin) * slice, static_cast<std::size_t>(zCount) * slice};
}

void VolumeProvider::dropPages(const VolumeKey&, int, int) const {}

bool VolumeProvider::isAtHand(const VolumeKey&) const { return true; }

void VolumeProvider::readAhead(const VolumeKey&, int, int, std::optional<FloatTexels>) const {}

void VolumeProvider::setAwaited(const std::vector<VolumeKey>&) const {}

void VolumeProvider::endAwaited(const VolumeKey&) const {}

void VolumeProvider::readSlicesOnce(const VolumeKey& key, int zBegin, int zCount,
                                    std::span<std::byte> out) const {
    readSlices(key, zBegin, zCount, out);
}

void VolumeProvider::keepLevel(const VolumeKey&, const HostLevel&) const {}

std::optional<UnfinishedLevel> VolumeProvider::takeUnfinished(const VolumeKey&, TexelFormat) const {
    return std::nullopt;
}

std::optional<HostLevel> VolumeProvider::takeLevel(const VolumeKey&, TexelFormat) const {
    return std::nullopt;
}

} // namespace voxsheet
