#include "stages/empty_space.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace voxsheet {
namespace {

constexpr std::size_t kLeastMarkBytes = std::size_t(16) << 20; ///< of 64 volumes of 256^3
constexpr std::size_t kMostMarkBytes = std::size_t(96) << 20;
constexpr int kLongestChunk = 16;

template <typename T>
gpu::Texture cellTexture(gpu::Context& context, const glm::ivec3& dims, const std::vector<T>& cells,
                         GLenum internalFormat, GLenum format, GLenum type) {
    const auto size = CellLayout::of(dims).cells;
    gpu::Texture texture(context, GL_TEXTURE_3D, internalFormat, size);
    texture.upload(glm::ivec3(0), size, format, type, std::as_bytes(std::span(cells)));
    return texture;
}

std::vector<std::uint8_t> distancesOf(const std::vector<std::uint8_t>& marks, const ResidentVolume& volume) {
    return emptyDistances(marks, CellLayout::of(volume.dims).cells, volume.meta->grid.periodic);
}

bool hasAbsentSamples(const ResidentVolume& volume) {
    const auto& steps = volume.meta->fields.at(static_cast<std::size_t>(volume.field)).steps;
    const auto step = static_cast<std::size_t>(volume.step);
    return step >= steps.size() || steps[step].statistics.nanCount > 0;
}

std::vector<std::uint8_t> occupiedDistances(const TransferTable& table, const ResidentVolume& volume,
                                            int reachSamples) {
    return distancesOf(
        occupiedCells(*volume.minMax, volume.dims, volume.meta->grid.periodic, table, reachSamples), volume);
}

/// Of volumes with absent samples every stride is 1, for ranges do not tell where they are.
std::vector<std::uint8_t> occupiedMarks(const TransferTable& table, const ResidentVolume& volume,
                                        int reachSamples, const std::optional<StrideSettings>& strides) {
    if (!strides || hasAbsentSamples(volume)) return occupiedDistances(table, volume, reachSamples);
    // Of a brick that shows something how fine its samples are, from 1 on.
    constexpr int finest = 16;
    auto fineness = occupiedBricks(*volume.minMax, table);
    const auto exponents = strideExponents(*volume.minMax, table, *strides);
    for (std::size_t i = 0; i < fineness.size(); ++i)
        if (fineness[i] != 0) fineness[i] = static_cast<std::uint8_t>(finest - exponents[i]);
    fineness = largestOverBricks(std::move(fineness), *volume.minMax, volume.dims, volume.meta->grid.periodic,
                                 reachSamples);
    auto marks = distancesOf(fineness, volume);
    for (std::size_t i = 0; i < marks.size(); ++i)
        if (marks[i] == 0) marks[i] = static_cast<std::uint8_t>((finest - fineness[i]) << kStrideShift);
    return marks;
}

std::vector<std::uint8_t> crossedDistances(const std::vector<double>& values, const ResidentVolume& volume) {
    return distancesOf(crossedCells(*volume.minMax, volume.dims, volume.meta->grid.periodic, values,
                                    shortReach(volume.dims)),
                       volume);
}

/// In signed texels, as rays compare them; rounded up, so that each bound stays one.
std::vector<float> largestTexels(const ResidentVolume& volume) {
    const float sign = volume.valueScale < 0.0 ? -1.0F : 1.0F;
    auto largest = largestInCells(*volume.minMax, volume.dims, volume.meta->grid.periodic, sign, kLongReach);
    const double scale = std::abs(volume.valueScale);
    for (auto& value : largest) {
        const double texel = (double(value) - double(sign) * volume.valueOffset) / scale;
        value = std::nextafter(static_cast<float>(texel + 1e-6 * std::abs(texel)), HUGE_VALF);
    }
    return largest;
}

/// Marks are read four bytes at a time.
std::vector<std::uint8_t> readable(std::vector<std::uint8_t> marks) {
    marks.reserve(marks.size() + 3); // not twice as many, as resize() alone would
    marks.resize(marks.size() + 3);
    return marks;
}

} // namespace

int chunkSamples(double sampleDistanceVoxels, int reachSamples) {
    int samples = 1;
    while (samples < kLongestChunk && 2.0 * samples * sampleDistanceVoxels <= 2.0 * reachSamples)
        samples *= 2;
    return samples;
}

std::size_t markBytesFor(std::uint64_t textureBudgetBytes) {
    return static_cast<std::size_t>(
        std::clamp<std::uint64_t>(textureBudgetBytes / 8, kLeastMarkBytes, kMostMarkBytes));
}

EmptySpaceStage::EmptySpaceStage(gpu::Context& context)
    : context_(context), textures_(kMostMarkBytes), hostCells_(kMostMarkBytes) {}

void EmptySpaceStage::keepAtMost(std::size_t markBytes) {
    textures_.setCapacity(markBytes);
    hostCells_.setCapacity(markBytes);
}

bool EmptySpaceStage::Key::matches(const Key& other) const {
    if (rangesHash != other.rangesHash || dims != other.dims || periodic != other.periodic) return false;
    if (valueFromTexel != other.valueFromTexel) return false;
    if (reachSamples != other.reachSamples || values != other.values) return false;
    return strides == other.strides;
}

template <typename Cache>
auto* EmptySpaceStage::madeFor(Cache& cache, Key& key, const std::shared_ptr<const TransferTable>& table) {
    auto* same = cache.find([&](const Key& other) {
        return key.matches(other) && (table ? other.table.isSame(table) : other.table.hash() == 0);
    });
    if (same != nullptr || !table) return same;
    key.table = TableKey(table);
    return cache.find(
        [&](const Key& other) { return key.matches(other) && other.table.hash() == key.table.hash(); });
}

EmptySpaceStage::Key EmptySpaceStage::keyOf(const ResidentVolume& volume, std::vector<double> values,
                                            int reachSamples, const std::optional<StrideSettings>& strides) {
    return {volume.rangesHash,
            volume.dims,
            volume.meta->grid.periodic,
            {volume.valueScale, volume.valueOffset},
            {},
            std::move(values),
            reachSamples,
            strides};
}

const gpu::Texture& EmptySpaceStage::occupied(const std::shared_ptr<const TransferTable>& table,
                                              const ResidentVolume& volume, int reachSamples,
                                              const std::optional<StrideSettings>& strides) {
    auto key = keyOf(volume, {}, reachSamples, strides);
    const auto* cells = madeFor(textures_, key, table);
    if (cells != nullptr) return *cells;
    return insertDistances(std::move(key), volume, occupiedMarks(*table, volume, reachSamples, strides));
}

void EmptySpaceStage::bindOccupied(const gpu::Program& program,
                                   const std::shared_ptr<const TransferTable>& table,
                                   const ResidentVolume& volume, int reachSamples,
                                   const std::optional<StrideSettings>& strides) {
    bind(program, volume, occupied(table, volume, reachSamples, strides));
}

void EmptySpaceStage::bindCrossed(const gpu::Program& program, const std::vector<double>& values,
                                  const ResidentVolume& volume) {
    auto key = keyOf(volume, values, shortReach(volume.dims));
    const auto* cells = madeFor(textures_, key, nullptr);
    if (cells == nullptr) cells = &insertDistances(std::move(key), volume, crossedDistances(values, volume));
    bind(program, volume, *cells);
}

const gpu::Texture& EmptySpaceStage::insertDistances(Key key, const ResidentVolume& volume,
                                                     const std::vector<std::uint8_t>& distances) {
    return textures_.insert(
        std::move(key),
        cellTexture(context_, volume.dims, distances, GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE),
        distances.size());
}

void EmptySpaceStage::bindLargest(const gpu::Program& program, const ResidentVolume& volume) {
    auto key = keyOf(volume, {}, kLongReach);
    const auto* cells = madeFor(textures_, key, nullptr);
    if (cells == nullptr) {
        const auto largest = largestTexels(volume);
        cells = &textures_.insert(std::move(key),
                                  cellTexture(context_, volume.dims, largest, GL_R32F, GL_RED, GL_FLOAT),
                                  largest.size() * sizeof(float));
    }
    bind(program, volume, *cells);
}

const EmptySpaceStage::HostCells&
EmptySpaceStage::occupiedOnHost(const std::shared_ptr<const TransferTable>& table,
                                const ResidentVolume& volume, int reachSamples,
                                const std::optional<StrideSettings>& strides) {
    auto key = keyOf(volume, {}, reachSamples, strides);
    const auto* cells = madeFor(hostCells_, key, table);
    if (cells != nullptr) return *cells;
    return insertOnHost(std::move(key), {readable(occupiedMarks(*table, volume, reachSamples, strides)), {}});
}

const EmptySpaceStage::HostCells& EmptySpaceStage::crossedOnHost(const std::vector<double>& values,
                                                                 const ResidentVolume& volume) {
    auto key = keyOf(volume, values, shortReach(volume.dims));
    const auto* cells = madeFor(hostCells_, key, nullptr);
    if (cells != nullptr) return *cells;
    return insertOnHost(std::move(key), {readable(crossedDistances(values, volume)), {}});
}

const EmptySpaceStage::HostCells& EmptySpaceStage::largestOnHost(const ResidentVolume& volume) {
    auto key = keyOf(volume, {}, kLongReach);
    const auto* cells = madeFor(hostCells_, key, nullptr);
    if (cells != nullptr) return *cells;
    return insertOnHost(std::move(key), {{}, largestTexels(volume)});
}

const EmptySpaceStage::HostCells& EmptySpaceStage::insertOnHost(Key key, HostCells cells) {
    const std::size_t bytes = cells.marks.size() + cells.largest.size() * sizeof(float);
    return hostCells_.insert(std::move(key), std::move(cells), bytes);
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
