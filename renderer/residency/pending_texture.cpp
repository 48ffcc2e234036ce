#include "residency/pending_texture.h"

#include <algorithm>
#include <utility>

namespace voxsheet {

namespace {

/// Texels per step of building gradients: about a millisecond on two cores.
constexpr long kGradientsPerStep = 1L << 17;

} // namespace

PendingTexture::PendingTexture(const VolumeProvider& provider, const TextureKey& key, bool exactR8Filtering,
                               FloatTexels floatTexels, bool clipObject)
    : key_(key), clipObject_(clipObject) {
    upload_.emplace(provider, key.volume, exactR8Filtering, floatTexels, isOnHost(key.kind));
    bytes_ = upload_->bytes();
    meta_ = upload_->volume().meta;
    dims_ = upload_->volume().dims;
}

PendingTexture::PendingTexture(const TextureKey& key, std::shared_ptr<const DatasetMeta> meta,
                               DerivedTextureBuilder build)
    : key_(key), meta_(std::move(meta)), build_(std::move(build)),
      dims_(levelDims(meta_->grid.dims, key.volume.level)) {
    bytes_ = static_cast<std::uint64_t>(sampleCount(dims_)) * gpu::texelBytes(GL_RGBA16F);
}

std::uint64_t PendingTexture::remainingBytes() const {
    if (upload_) return upload_->remainingBytes();
    const auto slices = static_cast<std::uint64_t>(dims_.z);
    return bytes_ / slices * (slices - static_cast<std::uint64_t>(nextSlice_));
}

bool PendingTexture::exceedsDevice(const gpu::Context& context) const {
    return upload_ && upload_->exceedsDevice(context);
}

void PendingTexture::begin(gpu::Context& context) {
    if (upload_) {
        texture_ = upload_->begin(context);
    } else {
        texture_.emplace(context, GL_TEXTURE_3D, GL_RGBA16F, dims_);
        setVolumeSampling(*texture_, meta_->grid);
    }
    begun_ = true;
}

bool PendingTexture::advance(Deadline deadline, SliceReader& reader, const ResidentVolume* source) {
    if (upload_) return upload_->advance(texture_, reader, deadline);
    const auto start = std::chrono::steady_clock::now();
    source_ = *source;
    const long sliceTexels = static_cast<long>(dims_.x) * dims_.y;
    const int step = static_cast<int>(std::clamp(kGradientsPerStep / sliceTexels / 4 * 4, 4L, 64L));
    while (nextSlice_ < dims_.z) {
        const int slices = std::min(step, dims_.z - nextSlice_);
        build_(source_, *texture_, nextSlice_, slices);
        nextSlice_ += slices;
        if (std::chrono::steady_clock::now() >= deadline) break;
    }
    buildMs_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return nextSlice_ == dims_.z;
}

std::shared_ptr<TextureEntry> PendingTexture::finish() {
    auto entry = std::make_shared<TextureEntry>();
    entry->texture = std::move(texture_);
    texture_.reset();
    entry->volume = upload_ ? upload_->volume() : source_;
    entry->volume.texture = entry->texture ? &*entry->texture : nullptr;
    entry->bytes = bytes_;
    entry->clipObject = clipObject_;
    entry->uploadMs = upload_ ? upload_->uploadMs() : buildMs_;
    entry->readMs = upload_ ? upload_->readMs() : 0.0;
    return entry;
}

} // namespace voxsheet
