#include "residency/volume_upload.h"

#include <algorithm>
#include <span>
#include <utility>

namespace voxsheet {

namespace {

/// Staging per chunk: one takes about a millisecond, so that uploads can stop for a frame; larger ones are
/// not faster.
constexpr std::size_t kChunkBytes = std::size_t{1} << 20;

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
                           FloatTexels floatTexels)
    : provider_(provider), key_(std::move(key)) {
    volume_.meta = provider.describe(key_.dataset);
    validateVolumeKey(*volume_.meta, key_);
    const FieldMeta& field = volume_.meta->fields[static_cast<std::size_t>(key_.field)];
    const ValueStatistics& values = field.steps[static_cast<std::size_t>(key_.step)].statistics;
    type_ = levelType(field.storedType, key_.level);

    // Statistics are in values; a negative slope swaps the ends.
    const double atMin = (values.min - field.valueOffset) / field.valueScale;
    const double atMax = (values.max - field.valueOffset) / field.valueScale;
    encoding_ = chooseTextureEncoding(type_, std::min(atMin, atMax), std::max(atMin, atMax), exactR8Filtering,
                                      floatTexels);
    volume_.valueScale = field.valueScale * encoding_.storedScale;
    volume_.valueOffset = field.valueScale * encoding_.storedOffset + field.valueOffset;
    volume_.field = key_.field;
    volume_.step = key_.step;
    volume_.level = key_.level;
    volume_.dims = levelDims(volume_.meta->grid.dims, key_.level);
}

std::uint64_t VolumeUpload::bytes() const {
    return static_cast<std::uint64_t>(sampleCount(volume_.dims)) * texelFormatBytes(encoding_.format);
}

bool VolumeUpload::exceedsDevice(const gpu::Context& context) const {
    return std::max({volume_.dims.x, volume_.dims.y, volume_.dims.z}) > context.limits().textureSize3d;
}

gpu::Texture VolumeUpload::createTexture(gpu::Context& context) const {
    gpu::Texture texture(context, GL_TEXTURE_3D, internalFormat(encoding_.format), volume_.dims);
    setVolumeSampling(texture, volume_.meta->grid);
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

bool VolumeUpload::advance(gpu::Texture& texture, Deadline deadline) {
    do {
        if (nextSlice_ == volume_.dims.z) {
            const Stopwatch watch(readMs_);
            volume_.minMax = std::make_shared<const MinMaxGrid>(provider_.readMinMax(key_));
            return true;
        }
        uploadChunk(texture);
    } while (std::chrono::steady_clock::now() < deadline);
    return false;
}

void VolumeUpload::uploadChunk(gpu::Texture& texture) {
    const std::size_t sliceSamples =
        static_cast<std::size_t>(volume_.dims.x) * static_cast<std::size_t>(volume_.dims.y);
    const bool verbatim = isVerbatim(type_, encoding_);
    const int slices = std::min(slicesPerChunk(), volume_.dims.z - nextSlice_);
    const std::size_t samples = sliceSamples * static_cast<std::size_t>(slices);
    stored_.resize(samples * scalarBytes(type_));
    {
        const Stopwatch watch(readMs_);
        provider_.readSlices(key_, nextSlice_, slices, stored_);
    }
    const Stopwatch watch(uploadMs_);
    std::span<const std::byte> upload = stored_;
    if (!verbatim) {
        texels_.resize(samples * texelFormatBytes(encoding_.format));
        encodeTexels(type_, encoding_, stored_, texels_);
        upload = texels_;
    }
    texture.upload({0, 0, nextSlice_}, {volume_.dims.x, volume_.dims.y, slices}, GL_RED,
                   componentType(encoding_.format), upload);
    nextSlice_ += slices;
}

} // namespace voxsheet
