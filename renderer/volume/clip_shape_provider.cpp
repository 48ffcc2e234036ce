#include "volume/clip_shape_provider.h"

#include <cstring>

namespace voxsheet {

namespace {

void addShape(MemoryVolumeProvider& shapes, ClipShape shape) {
    const auto samples = clipShapeSamples(shape);
    std::vector<std::byte> bytes(samples.size() * sizeof(float));
    std::memcpy(bytes.data(), samples.data(), bytes.size());
    std::vector<std::vector<std::byte>> arrays;
    arrays.push_back(std::move(bytes));
    shapes.add(clipShapeMeta(shape), std::move(arrays));
}

} // namespace

const VolumeProvider& ClipShapeProvider::providerOf(const std::string& dataset) const {
    const auto shape = clipShapeFromKey(dataset);
    if (!shape) return *others_;
    std::call_once(sampled_[static_cast<std::size_t>(*shape)], [&] { addShape(shapes_, *shape); });
    return shapes_;
}

std::shared_ptr<const DatasetMeta> ClipShapeProvider::describe(const std::string& dataset) const {
    return providerOf(dataset).describe(dataset);
}

void ClipShapeProvider::readSlices(const VolumeKey& key, int zBegin, int zCount,
                                   std::span<std::byte> out) const {
    providerOf(key.dataset).readSlices(key, zBegin, zCount, out);
}

MinMaxGrid ClipShapeProvider::readMinMax(const VolumeKey& key) const {
    return providerOf(key.dataset).readMinMax(key);
}

void ClipShapeProvider::dropPages(const VolumeKey& key, int zBegin, int zCount) const {
    providerOf(key.dataset).dropPages(key, zBegin, zCount);
}

bool ClipShapeProvider::isAtHand(const VolumeKey& key) const { return providerOf(key.dataset).isAtHand(key); }

void ClipShapeProvider::readAhead(const VolumeKey& key, int zBegin, int zCount,
                                  std::optional<FloatTexels> forRays) const {
    providerOf(key.dataset).readAhead(key, zBegin, zCount, forRays);
}

void ClipShapeProvider::setAwaited(const std::vector<VolumeKey>& levels) const {
    others_->setAwaited(levels); // shapes are in memory
}

void ClipShapeProvider::endAwaited(const VolumeKey& level) const { others_->endAwaited(level); }

void ClipShapeProvider::readSlicesOnce(const VolumeKey& key, int zBegin, int zCount,
                                       std::span<std::byte> out) const {
    providerOf(key.dataset).readSlicesOnce(key, zBegin, zCount, out);
}

void ClipShapeProvider::keepLevel(const VolumeKey& key, const HostLevel& level) const {
    providerOf(key.dataset).keepLevel(key, level);
}

std::optional<UnfinishedLevel> ClipShapeProvider::takeUnfinished(const VolumeKey& key,
                                                                 TexelFormat format) const {
    return providerOf(key.dataset).takeUnfinished(key, format);
}

std::optional<HostLevel> ClipShapeProvider::takeLevel(const VolumeKey& key, TexelFormat format) const {
    return providerOf(key.dataset).takeLevel(key, format);
}

} // namespace voxsheet
