// Where the renderer gets voxels from: the volume store (server), or memory (tests, benches).
#pragma once

#include "volume/dataset.h"
#include "volume/host_level.h"
#include "volume/min_max_grid.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace voxsheet {

/// One array of samples.
struct VolumeKey {
    std::string dataset; ///< DatasetMeta::key
    int field = 0;
    int step = 0;
    int level = 0;

    auto operator<=>(const VolumeKey&) const = default;
};

/// Bytes [offset, offset + count) of a level's array.
struct ByteRange {
    std::size_t offset = 0;
    std::size_t count = 0;
};

/// Throws NotFound if the dataset has no such field, step or level; the sentence names what there is.
void validateVolumeKey(const DatasetMeta& meta, const VolumeKey& key);
/// Where slices [zBegin, zBegin + zCount) are in the level's array. Throws NotFound as validateVolumeKey,
/// InvalidInput if the slices are not in the level.
[[nodiscard]] ByteRange sliceBytes(const DatasetMeta& meta, const VolumeKey& key, int zBegin, int zCount);

/// Thread-safe: called from the render thread and from upload workers.
class VolumeProvider {
public:
    virtual ~VolumeProvider() = default;

    /// Throws NotFound if there is no such dataset.
    [[nodiscard]] virtual std::shared_ptr<const DatasetMeta> describe(const std::string& dataset) const = 0;

    /// Reads slices [zBegin, zBegin + zCount) of the level, little-endian, x fastest, in
    /// levelType(storedType, level). out.size() == levelDims.x * levelDims.y * zCount * scalarBytes(type).
    /// Throws NotFound, IoError (short file, gone), InvalidInput (range outside the level).
    virtual void readSlices(const VolumeKey& key, int zBegin, int zCount, std::span<std::byte> out) const = 0;

    /// Throws as readSlices.
    [[nodiscard]] virtual MinMaxGrid readMinMax(const VolumeKey& key) const = 0;

    /// Tells the operating system that these slices will not be read soon again, so that it need not keep
    /// them in its page cache. For providers that read files; others do nothing. Throws as readSlices.
    virtual void dropPages(const VolumeKey& key, int zBegin, int zCount) const;

    /// Whether the whole level can be read without waiting for a disk, as far as the provider knows. Throws
    /// NotFound.
    [[nodiscard]] virtual bool isAtHand(const VolumeKey& key) const;

    /// Brings slices that will be read soon into the memory that the provider keeps, if it keeps any; with
    /// the level's last slice its min-max grid, too. For rays that the processor marches as part of a level
    /// with such texels (takeLevel, takeUnfinished), if the slices before them were read ahead likewise.
    /// Throws as readSlices.
    virtual void readAhead(const VolumeKey& key, int zBegin, int zCount,
                           std::optional<FloatTexels> forRays) const;

    /// Levels that are about to be read, in place of those named before: where memory is short, what is kept
    /// of others goes first, and nothing is read ahead in place of what is kept of these.
    virtual void setAwaited(const std::vector<VolumeKey>& levels) const;
    /// The level is being read: it is awaited no longer.
    virtual void endAwaited(const VolumeKey& level) const;

    // --- levels for rays, of providers that keep some in memory ---
    /// As readSlices, for one who will hold the level in host memory: its samples need not be kept as well,
    /// here or by the operating system.
    virtual void readSlicesOnce(const VolumeKey& key, int zBegin, int zCount, std::span<std::byte> out) const;
    /// Keeps a level that the one who held it has no more room for, if there is room here.
    virtual void keepLevel(const VolumeKey& key, const HostLevel& level) const;
    /// Hands a kept level back and keeps it no longer; nothing if it is not kept in this format.
    [[nodiscard]] virtual std::optional<HostLevel> takeLevel(const VolumeKey& key, TexelFormat format) const;
    /// Likewise what has been read ahead of a level so far.
    [[nodiscard]] virtual std::optional<UnfinishedLevel> takeUnfinished(const VolumeKey& key,
                                                                        TexelFormat format) const;
};

} // namespace voxsheet
