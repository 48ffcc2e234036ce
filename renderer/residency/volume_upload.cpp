#include "residency/volume_upload.h"

#include "gpu/context.h"

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

namespace voxsheet {

namespace {

/// Staging per chunk: large enough for full read and upload speed, small beside the volumes.
constexpr std::size_t kChunkBytes = std::size_t{16} << 20;

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

void VolumeUpload::fill(gpu::Texture& texture) {
    const std::size_t sliceSamples =
        static_cast<std::size_t>(volume_.dims.x) * static_cast<std::size_t>(volume_.dims.y);
    const int chunkSlices = slicesPerChunk();
    const bool verbatim = isVerbatim(type_, encoding_);
    const std::size_t chunkSamples = sliceSamples * static_cast<std::size_t>(chunkSlices);
    std::vector<std::byte> stored(chunkSamples * scalarBytes(type_));
    std::vector<std::byte> texels(verbatim ? 0 : chunkSamples * texelFormatBytes(encoding_.format));

    for (int z = 0; z < volume_.dims.z; z += chunkSlices) {
        const int slices = std::min(chunkSlices, volume_.dims.z - z);
        const std::size_t samples = sliceSamples * static_cast<std::size_t>(slices);
        const std::span<std::byte> source(stored.data(), samples * scalarBytes(type_));
        {
            const Stopwatch watch(readMs_);
            provider_.readSlices(key_, z, slices, source);
        }
        const Stopwatch watch(uploadMs_);
        std::span<const std::byte> upload = source;
        if (!verbatim) {
            const std::span<std::byte> converted(texels.data(), samples * texelFormatBytes(encoding_.format));
            encodeTexels(type_, encoding_, source, converted);
            upload = converted;
        }
        texture.upload({0, 0, z}, {volume_.dims.x, volume_.dims.y, slices}, GL_RED,
                       componentType(encoding_.format), upload);
    }
    const Stopwatch watch(readMs_);
    volume_.minMax = std::make_shared<const MinMaxGrid>(provider_.readMinMax(key_));
}

} // namespace voxsheet
