// An open entry of the volume store: reads levels, min-max grids and single values.
#pragma once

#include "store/entry_layout.h"
#include "store/file_handle.h"
#include "volume/volume_provider.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace voxsheet::store {

/// While it lives, no process removes the entry from the store. Immutable and thread-safe.
class StoreEntry {
public:
    /// Opens the entry in `folder` (whose name is the key), checks it (version, meta.json, the size of every
    /// array file) and marks it as used now. Returns null if there is none, if another process is removing
    /// it, or if it is incomplete or damaged; `damaged` tells the last case. Throws IoError if the system
    /// refuses (permission, too many open files): that is no fault of the entry.
    [[nodiscard]] static std::shared_ptr<const StoreEntry> open(const std::filesystem::path& folder,
                                                                bool& damaged);

    [[nodiscard]] const std::shared_ptr<const DatasetMeta>& meta() const { return meta_; }

    /// As VolumeProvider::readSlices. Throws IoError if the files are gone or became shorter.
    void readSlices(const VolumeKey& key, int zBegin, int zCount, std::span<std::byte> out) const;
    /// Likewise, past the operating system's cache where that can be (FileHandle::readPastCache).
    void readSlicesPastCache(const VolumeKey& key, int zBegin, int zCount, std::span<std::byte> out) const;
    [[nodiscard]] MinMaxGrid readMinMax(const VolumeKey& key) const;
    /// As VolumeProvider::dropPages.
    void dropPages(const VolumeKey& key, int zBegin, int zCount) const;

    /// Values (after slope and intercept) of the box of samples [low, low + size) of a level, x fastest.
    /// out.size() == size.x * size.y * size.z. Throws as readSlices.
    void readBox(const VolumeKey& key, const glm::ivec3& low, const glm::ivec3& size,
                 std::span<double> out) const;
    [[nodiscard]] double readValue(const VolumeKey& key, const glm::ivec3& sample) const;

private:
    friend class StoreWriter;
    StoreEntry(FileHandle folder, FileHandle lock, std::shared_ptr<const DatasetMeta> meta);
    /// As open, of an entry that does not bear its key's name yet.
    [[nodiscard]] static std::shared_ptr<const StoreEntry>
    openAs(const std::string& key, const std::filesystem::path& folder, bool& damaged);
    /// Where the slices are in the array's file. Throws as readSlices.
    [[nodiscard]] std::uint64_t offsetOf(const VolumeKey& key, int zBegin, int zCount,
                                         std::span<const std::byte> out) const;
    [[nodiscard]] FileHandle openArrayFile(const VolumeKey& key) const;

    FileHandle folder_; ///< open, because a writer may rename it
    FileHandle lock_;
    std::shared_ptr<const DatasetMeta> meta_;
};

} // namespace voxsheet::store
