#include "residency/volume_upload.h"

#include "volume/texel_plan.h"

#include <algorithm>
#include <span>
#include <utility>

namespace voxsheet {

namespace {

/// Staging per chunk: one takes about a millisecond, so that uploads can stop for a frame; larger ones are
/// not faster.
constexpr std::size_t kChunkBytes = std::size_t{1} << 20;
/// One chunk is read while the one before it is converted and uploaded.
constexpr std::size_t kReadsAhead = 2;

class Stopwatch {
public:
    explicit Stopwatch(double& totalMs) : totalMs_(totalMs), start_(std::chrono::steady_clock::now()) {}
    ~Stopwatch() {
        totalMs_ +=
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
    }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

private:
    double& totalMs_;
    std::chrono::steady_clock::time_point start_;
};

GLenum internalFormat(TexelFormat format) {
    switch (format) {
    case TexelFormat::R8:
        return GL_R8;
    case TexelFormat::R16:
        return GL_R16;
    case TexelFormat::R16F:
        return GL_R16F;
    case TexelFormat::R32F:
        break;
    }
    return GL_R32F;
}

GLenum componentType(TexelFormat format) {
    switch (format) {
    case TexelFormat::R8:
        return GL_UNSIGNED_BYTE;
    case TexelFormat::R16:
        return GL_UNSIGNED_SHORT;
    case TexelFormat::R16F:
        return GL_HALF_FLOAT;
    case TexelFormat::R32F:
        break;
    }
    return GL_FLOAT;
}

GLenum wrapOf(bool periodic) { return periodic ? GL_REPEAT : GL_CLAMP_TO_EDGE; }

} // namespace

void setVolumeSampling(gpu::Texture& texture, const Grid& grid) {
    texture.setFilter(GL_LINEAR);
    texture.setWrap(wrapOf(grid.periodic.x), wrapOf(grid.periodic.y), wrapOf(grid.periodic.z));
}

VolumeUpload::VolumeUpload(const VolumeProvider& provider, VolumeKey key, bool exactR8Filtering,
                           FloatTexels floatTexels, bool onHost)
    : provider_(provider), key_(std::move(key)), onHost_(onHost) {
    // The kernels interpolate 8-bit samples exactly.
    TexelPlan plan = planTexels(provider, key_, exactR8Filtering || onHost, floatTexels);
    type_ = plan.type;
    encoding_ = plan.encoding;
    volume_.valueScale = plan.valueScale;
    volume_.valueOffset = plan.valueOffset;
    volume_.field = key_.field;
    volume_.step = key_.step;
    volume_.level = key_.level;
    volume_.dims = plan.dims;
    volume_.meta = std::move(plan.meta);
}

std::uint64_t VolumeUpload::bytes() const {
    if (onHost_) return HostTexels::bytesFor(encoding_.format, volume_.dims);
    return static_cast<std::uint64_t>(sampleCount(volume_.dims)) * texelFormatBytes(encoding_.format);
}

bool VolumeUpload::exceedsDevice(const gpu::Context& context) const {
    if (onHost_) return !HostTexels::fits(volume_.dims);
    return std::max({volume_.dims.x, volume_.dims.y, volume_.dims.z}) > context.limits().textureSize3d;
}

void VolumeUpload::takeKept() {
    if (!onHost_ || takeLevel()) return;
    if (auto begun = provider_.takeUnfinished(key_, encoding_.format)) {
        nextSlice_ = nextAsked_ = begun->slices;
        host_ = std::move(begun->texels);
        volume_.host = host_;
    } else {
        (void)takeLevel(); // its last piece was being read until just now
    }
}

bool VolumeUpload::takeLevel() {
    auto kept = provider_.takeLevel(key_, encoding_.format);
    if (!kept) return false;
    kept_ = true;
    nextSlice_ = volume_.dims.z;
    volume_.host = std::move(kept->texels);
    volume_.minMax = std::move(kept->minMax);
    volume_.rangesHash = kept->rangesHash;
    return true;
}

std::optional<gpu::Texture> VolumeUpload::begin(gpu::Context& context) {
    if (volume_.host) return std::nullopt; // taken over
    if (onHost_) {
        host_ = std::make_shared<HostTexels>(encoding_.format, volume_.dims, volume_.meta->grid.periodic);
        volume_.host = host_;
        return std::nullopt;
    }
    std::optional<gpu::Texture> texture;
    texture.emplace(context, GL_TEXTURE_3D, internalFormat(encoding_.format), volume_.dims);
    setVolumeSampling(*texture, volume_.meta->grid);
    return texture;
}

int VolumeUpload::slicesPerChunk() const {
    const std::size_t sliceSamples =
        static_cast<std::size_t>(volume_.dims.x) * static_cast<std::size_t>(volume_.dims.y);
    const std::size_t sliceBytes =
        sliceSamples * std::max(scalarBytes(type_), texelFormatBytes(encoding_.format));
    return static_cast<int>(
        std::clamp(kChunkBytes / sliceBytes, std::size_t{1}, static_cast<std::size_t>(volume_.dims.z)));
}

std::uint64_t VolumeUpload::remainingBytes() const {
    const auto slices = static_cast<std::uint64_t>(volume_.dims.z);
    return bytes() / slices * (slices - static_cast<std::uint64_t>(nextSlice_));
}

int VolumeUpload::slicesOfChunk(int zBegin) const {
    return std::min(slicesPerChunk(), volume_.dims.z - zBegin);
}

void VolumeUpload::askAhead(SliceReader& reader) {
    const std::size_t sliceBytes = static_cast<std::size_t>(volume_.dims.x) *
                                   static_cast<std::size_t>(volume_.dims.y) * scalarBytes(type_);
    while (nextAsked_ < volume_.dims.z && reads_.size() < kReadsAhead) {
        const int slices = slicesOfChunk(nextAsked_);
        spare_.resize(sliceBytes * static_cast<std::size_t>(slices));
        reads_.push_back(reader.read({key_, nextAsked_, slices, onHost_, std::move(spare_)}));
        spare_ = {};
        nextAsked_ += slices;
    }
    if (nextAsked_ == volume_.dims.z && !minMax_.valid()) minMax_ = reader.readMinMax(key_);
}

bool VolumeUpload::advance(std::optional<gpu::Texture>& texture, SliceReader& reader, Deadline deadline) {
    if (kept_) return true;
    const auto arrived = [&](const auto& read) {
        const Stopwatch watch(readMs_);
        if (deadline == Deadline::max()) {
            read.wait();
            return true;
        }
        return read.wait_until(deadline) == std::future_status::ready;
    };
    do {
        askAhead(reader);
        if (reads_.empty()) {
            if (!arrived(minMax_)) return false;
            if (host_) host_->closeBorders();
            volume_.minMax = std::make_shared<const MinMaxGrid>(minMax_.get());
            volume_.rangesHash = contentHash(*volume_.minMax);
            return true;
        }
        if (!arrived(reads_.front())) return false;
        auto stored = reads_.front().get();
        reads_.pop_front();
        uploadChunk(texture, stored);
        spare_ = std::move(stored);
    } while (std::chrono::steady_clock::now() < deadline);
    return false;
}

void VolumeUpload::uploadChunk(std::optional<gpu::Texture>& texture, const std::vector<std::byte>& stored) {
    const std::size_t sliceSamples =
        static_cast<std::size_t>(volume_.dims.x) * static_cast<std::size_t>(volume_.dims.y);
    const bool verbatim = isVerbatim(type_, encoding_);
    const int slices = slicesOfChunk(nextSlice_);
    const std::size_t samples = sliceSamples * static_cast<std::size_t>(slices);
    const Stopwatch watch(uploadMs_);
    std::span<const std::byte> upload = stored;
    if (!verbatim) {
        texels_.resize(samples * texelFormatBytes(encoding_.format));
        encodeTexels(type_, encoding_, stored, texels_);
        upload = texels_;
    }
    if (host_) {
        host_->setSlices(nextSlice_, slices, upload);
    } else {
        texture->upload({0, 0, nextSlice_}, {volume_.dims.x, volume_.dims.y, slices}, GL_RED,
                        componentType(encoding_.format), upload);
    }
    nextSlice_ += slices;
}

} // namespace voxsheet
