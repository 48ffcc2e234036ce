#include "stages/empty_space.h"

#include <cmath>
#include <span>
#include <utility>

namespace voxsheet {
namespace {

constexpr std::size_t kCachedVolumes = 128;
constexpr int kLongestChunk = 16;

template <typename T>
gpu::Texture cellTexture(gpu::Context& context, const glm::ivec3& dims, const std::vector<T>& cells,
                         GLenum internalFormat, GLenum format, GLenum type) {
    const auto size = CellLayout::of(dims).cells;
    gpu::Texture texture(context, GL_TEXTURE_3D, internalFormat, size);
    texture.upload(glm::ivec3(0), size, format, type, std::as_bytes(std::span(cells)));
    return texture;
}

} // namespace

int chunkSamples(double sampleDistanceVoxels, int reachSamples) {
    int samples = 1;
    while (samples < kLongestChunk && 2.0 * samples * sampleDistanceVoxels <= 2.0 * reachSamples)
        samples *= 2;
    return samples;
}

EmptySpaceStage::EmptySpaceStage(gpu::Context& context) : context_(context), textures_(kCachedVolumes) {}

const gpu::Texture& EmptySpaceStage::occupied(const std::shared_ptr<const TransferTable>& table,
                                              const ResidentVolume& volume, int reachSamples) {
    const auto* cells = textures_.find([&](const Key& key) {
        return key.minMax == volume.minMax && key.table && (key.table == table || *key.table == *table) &&
               key.reachSamples == reachSamples;
    });
    if (cells != nullptr) return *cells;
    const auto marks =
        occupiedCells(*volume.minMax, volume.dims, volume.meta->grid.periodic, *table, reachSamples);
    return insertDistances({volume.minMax, table, {}, reachSamples}, volume, marks);
}

void EmptySpaceStage::bindOccupied(const gpu::Program& program,
                                   const std::shared_ptr<const TransferTable>& table,
                                   const ResidentVolume& volume, int reachSamples) {
    bind(program, volume, occupied(table, volume, reachSamples));
}

void EmptySpaceStage::bindCrossed(const gpu::Program& program, const std::vector<double>& values,
                                  const ResidentVolume& volume) {
    const auto* cells = textures_.find(
        [&](const Key& key) { return key.minMax == volume.minMax && !key.table && key.values == values; });
    if (cells == nullptr) {
        const auto marks =
            crossedCells(*volume.minMax, volume.dims, volume.meta->grid.periodic, values, kShortReach);
        cells = &insertDistances({volume.minMax, nullptr, values, kShortReach}, volume, marks);
    }
    bind(program, volume, *cells);
}

const gpu::Texture& EmptySpaceStage::insertDistances(Key key, const ResidentVolume& volume,
                                                     const std::vector<std::uint8_t>& marks) {
    const auto layout = CellLayout::of(volume.dims);
    const auto shortLast = glm::notEqual(layout.cells * layout.cellSamples, volume.dims);
    const auto distances = emptyDistances(marks, layout.cells, volume.meta->grid.periodic, shortLast);
    return textures_.insert(std::move(key), cellTexture(context_, volume.dims, distances, GL_R8UI,
                                                        GL_RED_INTEGER, GL_UNSIGNED_BYTE));
}

void EmptySpaceStage::bindLargest(const gpu::Program& program, const ResidentVolume& volume) {
    const auto* cells = textures_.find(
        [&](const Key& key) { return key.minMax == volume.minMax && !key.table && key.values.empty(); });
    if (cells == nullptr) {
        const float sign = volume.valueScale < 0.0 ? -1.0F : 1.0F;
        auto largest =
            largestInCells(*volume.minMax, volume.dims, volume.meta->grid.periodic, sign, kLongReach);
        // In signed texels, as the shader compares them; rounded up, so that the bound stays one.
        const double scale = std::abs(volume.valueScale);
        for (auto& value : largest) {
            const double texel = (double(value) - double(sign) * volume.valueOffset) / scale;
            value = std::nextafter(static_cast<float>(texel + 1e-6 * std::abs(texel)), HUGE_VALF);
        }
        cells = &textures_.insert({volume.minMax, nullptr, {}, kLongReach},
                                  cellTexture(context_, volume.dims, largest, GL_R32F, GL_RED, GL_FLOAT));
    }
    bind(program, volume, *cells);
}

void EmptySpaceStage::bind(const gpu::Program& program, const ResidentVolume& volume,
                           const gpu::Texture& cells) const {
    cells.bind(cellsUnit);
    const auto layout = CellLayout::of(volume.dims);
    program.set("cellsPerTexture", glm::vec3(volume.dims) / static_cast<float>(layout.cellSamples));
    program.set("cellSamples", layout.cellSamples);
    program.set("lastCell", layout.cells - 1);
    program.set("periodicAxes", glm::vec3(volume.meta->grid.periodic));
}

} // namespace voxsheet
